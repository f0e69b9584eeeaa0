// Files that a model names, such as the columns of a table: `file = "gas.csv"`. The kernel reads no files; it receives those that the page has.

/** The texts of files, under the names that the model uses for them. */
export type NamedFiles = Readonly<Record<string, string>>;

/** Those of the known files that a model's text names. */
export function filesNamedIn(text: string, known: NamedFiles): Record<string, string> {
  const files: Record<string, string> = {};
  for (const [, name] of text.matchAll(/\bfile["']?\s*[=:]\s*["']([^"'\n]+)["']/g)) {
    if (name !== undefined && Object.hasOwn(known, name)) files[name] = known[name]!;
  }
  return files;
}

/** Arguments of a call; if they contain a model's text, the known files that it names are added. */
export function withNamedFiles(args: unknown, known: NamedFiles): unknown {
  if (typeof args !== "object" || args === null || !("text" in args) || typeof args.text !== "string") return args;
  return { ...args, files: filesNamedIn(args.text, known) };
}

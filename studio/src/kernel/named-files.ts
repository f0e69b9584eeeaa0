// Files that a model names, such as the columns of a table: `file = "gas.csv"`. The kernel reads no files; it receives those that the page has.

const known = new Map<string, string>();

/** Stores a file in the page, under the name that models use for it. */
export function keepNamedFile(name: string, text: string): void {
  known.set(name, text);
}

/** The files that a model's text names and the page has. */
export function filesNamedIn(text: string): Record<string, string> {
  const files: Record<string, string> = {};
  for (const [, name] of text.matchAll(/\bfile["']?\s*[=:]\s*["']([^"'\n]+)["']/g)) {
    const file = name === undefined ? undefined : known.get(name);
    if (name !== undefined && file !== undefined) files[name] = file;
  }
  return files;
}

/** Arguments of a call; if they contain a model's text, the files that it names are added. */
export function withNamedFiles(args: unknown): unknown {
  if (typeof args !== "object" || args === null || !("text" in args) || typeof args.text !== "string") return args;
  return { ...args, files: filesNamedIn(args.text) };
}

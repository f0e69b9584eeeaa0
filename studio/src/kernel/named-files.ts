// Files that a model names, such as the columns of a table: `file = "gas.csv"`. The kernel reads no files; it is given those that the page has.

const known = new Map<string, string>();

/** The page has this file, under the name that models give it. */
export function keepNamedFile(name: string, text: string): void {
  known.set(name, text);
}

/** Those that a model's text names and the page has. */
export function filesNamedIn(text: string): Record<string, string> {
  const files: Record<string, string> = {};
  for (const [, name] of text.matchAll(/\bfile["']?\s*[=:]\s*["']([^"'\n]+)["']/g)) {
    const file = name === undefined ? undefined : known.get(name);
    if (name !== undefined && file !== undefined) files[name] = file;
  }
  return files;
}

/** Arguments of a call; those with a model's text get the files that it names. */
export function withNamedFiles(args: unknown): unknown {
  if (typeof args !== "object" || args === null || !("text" in args) || typeof args.text !== "string") return args;
  return { ...args, files: filesNamedIn(args.text) };
}

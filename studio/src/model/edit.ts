// Edits of a model's text that change only what they must: comments, order and layout are kept. A draft collects
// edits based on one reading of the text and applies them together, so that one user action is one undo step.
import { withRemark } from "./remarks";
import { type Document, type Span, type TableNode, nodeAt, parseToml, writeKey } from "./toml";

interface Replacement {
  from: number;
  to: number;
  text: string;
}

/** A TOML value: numbers are written short, texts in quotes. */
export type Literal = string | number | boolean | Literal[] | { [key: string]: Literal };

export function writeLiteral(value: Literal): string {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value === "number") return writeNumber(value);
  if (typeof value === "boolean") return String(value);
  if (Array.isArray(value)) return `[${value.map(writeLiteral).join(", ")}]`;
  return `{ ${Object.entries(value)
    .map(([key, inner]) => `${writeKey(key)} = ${writeLiteral(inner)}`)
    .join(", ")} }`;
}

/** At most 12 digits, so that 0.1 + 0.2 is written as 0.3. */
export function writeNumber(value: number): string {
  if (!Number.isFinite(value)) return "0";
  const text = String(Number(value.toPrecision(12)));
  return text.replace(/e\+?(-?\d+)$/, "e$1");
}

export class Draft {
  readonly document: Document;
  private readonly replacements: Replacement[] = [];
  private readonly fresh = new Map<string, { path: string[]; lines: Map<string, string> }>();
  private readonly removed: string[] = [];
  private readonly headers = new Map<string, string>();

  constructor(source: string | Document) {
    this.document = typeof source === "string" ? parseToml(source) : source;
  }

  /** Sets the value at `path`, whether or not it exists. */
  set(path: readonly string[], value: Literal, remark = ""): this {
    const literal = writeLiteral(value);
    const found = nodeAt(this.document.root, path);
    if (found?.kind === "table" && found.form !== "inline") {
      for (const [key, inner] of Object.entries(value as Record<string, Literal>)) this.set([...path, key], inner);
    } else if (found) {
      this.replace(found.from, found.to, literal);
      if (remark) this.remark(path, remark);
    } else {
      this.insert(path, literal, remark ? `  # ${remark}` : "");
    }
    return this;
  }

  /** The studio's comment after a value; empty: none. A value inside braces has no line of its own, and gets none. */
  remark(path: readonly string[], remark: string): this {
    const found = nodeAt(this.document.root, path);
    if (found?.statement) this.remarkBehind(found.statement.to, remark);
    return this;
  }

  /** The comment after a body's header that states its shape. */
  shape(body: string, words: string): this {
    const found = nodeAt(this.document.root, ["body", body]);
    if (found?.kind === "table" && found.form === "header") this.remarkBehind(found.to, words);
    else this.headers.set(`body\u0000${body}`, words);
    return this;
  }

  private remarkBehind(offset: number, remark: string): void {
    const end = withRemark(this.document, offset, remark);
    if (end) this.replace(end.from, end.to, end.text);
  }

  /** Removes a value, or a table with its content. */
  remove(path: readonly string[]): this {
    const { text, sections, root } = this.document;
    const found = nodeAt(root, path);
    if (!found) {
      this.fresh.delete(path.join("\u0000"));
      return this;
    }
    const key = path.join("\u0000");
    this.removed.push(key);
    for (const section of sections) {
      if (path.every((word, i) => section.path[i] === word)) this.cut(section.from, behindBlankLines(text, section.to));
    }
    if (found.statement) this.removeStatement(found.statement, path);
    else if (found.kind === "table") this.removeDotted(found, path);
    return this;
  }

  private removeDotted(table: TableNode, path: readonly string[]): void {
    for (const [key, inner] of table.entries) {
      if (inner.statement && !this.isCut(inner.statement.from)) this.removeStatement(inner.statement, [...path, key]);
      else if (inner.kind === "table") this.removeDotted(inner, [...path, key]);
    }
  }

  private removeStatement(statement: { from: number; to: number }, path: readonly string[]): void {
    const { text } = this.document;
    const parent = nodeAt(this.document.root, path.slice(0, -1));
    if (parent?.kind === "table" && parent.form === "inline") {
      const comma = /^\s*,\s*/.exec(text.slice(statement.to))?.[0].length;
      const before = /,\s*$/.exec(text.slice(0, statement.from))?.[0].length ?? 0;
      if (comma) this.cut(statement.from, statement.to + comma);
      else this.cut(statement.from - before, statement.to);
      return;
    }
    const start = text.lastIndexOf("\n", statement.from - 1) + 1;
    const end = text.indexOf("\n", statement.to);
    this.cut(start, end < 0 ? text.length : end + 1);
  }

  private isCut(at: number): boolean {
    return this.replacements.some((one) => one.text === "" && one.from <= at && at < one.to);
  }

  private cut(from: number, to: number): void {
    if (!this.isCut(from)) this.replacements.push({ from, to, text: "" });
  }

  /** Renames the last key of `path`, in headers and statements; references to it are left to the caller. */
  rename(path: readonly string[], to: string): this {
    const { text, sections, root } = this.document;
    for (const section of sections) {
      if (!path.every((word, i) => section.path[i] === word)) continue;
      const renamed = section.path.map((word, i) => (i === path.length - 1 ? to : word));
      this.replace(section.header.from, section.header.to, `[${renamed.map(writeKey).join(".")}]`);
    }
    const found = nodeAt(root, path);
    const from = path[path.length - 1]!;
    const statements = found?.statement ? [found.statement] : found?.kind === "table" && found.form === "dotted" ? [...found.entries.values()].map((e) => e.statement) : [];
    for (const statement of statements) {
      if (!statement) continue;
      const equals = text.indexOf("=", statement.from);
      const key = text.slice(statement.from, equals);
      const at = key.lastIndexOf(from);
      if (at >= 0) this.replace(statement.from + at, statement.from + at + from.length, writeKey(to));
    }
    return this;
  }

  private replace(from: number, to: number, text: string): void {
    const same = this.replacements.find((one) => one.from === from && one.to === to && to > from);
    if (same) same.text = text;
    else this.replacements.push({ from, to, text });
  }

  private insert(path: readonly string[], value: string, remark: string): void {
    const key = path[path.length - 1]!;
    let depth = path.length - 1;
    let home = nodeAt(this.document.root, path.slice(0, depth));
    while (depth > 0 && home?.kind !== "table") home = nodeAt(this.document.root, path.slice(0, --depth));
    const table = home as TableNode;
    const rest = path.slice(depth).map(writeKey).join(".");
    const literal = table.form === "inline" ? value : value + remark;
    const gone = this.removed.some((one) => path.slice(0, depth).join("\u0000").startsWith(one));
    if (gone || table.form === "implied" || (depth === 0 && path.length > 1) || (depth < path.length - 1 && depth < 2)) {
      this.addFresh(path.slice(0, -1), key, value + remark);
    } else if (table.form === "inline") {
      const comma = table.entries.size > 0 ? ", " : " ";
      const at = trimmedEnd(this.document.text, table.insertAt);
      this.replacements.push({ from: at, to: at, text: `${comma}${rest} = ${literal}` });
    } else {
      const at = table.insertAt;
      const newline = at > 0 && this.document.text[at - 1] !== "\n" ? "\n" : "";
      this.replacements.push({ from: at, to: at, text: `${newline}${table.prefix}${rest} = ${literal}\n` });
    }
  }

  private addFresh(path: readonly string[], key: string, literal: string): void {
    // The markers of a new body are in its own table: markers.A = [...]
    const dotted = path[0] === "body" && path.length === 3 && path[2] === "markers";
    const home = dotted ? path.slice(0, 2) : path;
    const name = home.join("\u0000");
    const entry = this.fresh.get(name) ?? { path: [...home], lines: new Map<string, string>() };
    entry.lines.set(dotted ? `markers.${writeKey(key)}` : writeKey(key), literal);
    this.fresh.set(name, entry);
  }

  /** The text with all edits applied. */
  apply(): string {
    let { text } = this.document;
    const ordered = this.replacements.map((one, order) => ({ ...one, order }));
    ordered.sort((a, b) => b.from - a.from || b.order - a.order);
    for (const one of ordered) text = text.slice(0, one.from) + one.text + text.slice(one.to);
    const fresh = [...this.fresh.values()].sort((a, b) => rank(a.path) - rank(b.path));
    for (const { path, lines } of fresh) text = addSection(text, path, lines, this.headers.get(path.join("\u0000")));
    return text;
  }
}

/** The text with the value at `path` moved out of its braces to a line of its own: `a = { b = 1 }` becomes `a.b = 1`. */
export function unfolded(text: string, path: readonly string[]): string {
  const { root } = parseToml(text);
  for (let depth = 1; depth < path.length; depth++) {
    const table = nodeAt(root, path.slice(0, depth));
    if (table?.kind !== "table" || table.form !== "inline" || !table.statement) continue;
    const key = text.slice(table.statement.from, text.lastIndexOf("=", table.from)).trim();
    const inner = text.slice(table.from + 1, table.to - 1);
    const starts = [...statementsIn(table)].map((one) => one.from - table.from - 1).sort((a, b) => a - b);
    const lines = starts.map((from, i) => `${key}.${inner.slice(from, starts[i + 1]).replace(/[\s,]+$/, "")}`);
    if (lines.length === 0) return text;
    return unfolded(text.slice(0, table.statement.from) + lines.join("\n") + text.slice(table.to), path);
  }
  return text;
}

// The statements of the table's entries; a table made by a.b = 1 has none of its own.
function* statementsIn(table: TableNode): Generator<Span> {
  for (const node of table.entries.values()) {
    if (node.statement) yield node.statement;
    else if (node.kind === "table") yield* statementsIn(node);
  }
}

const ORDER = ["parameters", "table", "simulate", "defaults", "ground", "body", "joint", "spring", "torsion_spring", "force", "motor", "variation"];

function rank(path: readonly string[]): number {
  const at = ORDER.indexOf(path[0] ?? "");
  return at < 0 ? ORDER.length : at;
}

// A new table is inserted after the last table whose kind does not come later than its own.
function addSection(text: string, path: readonly string[], lines: Map<string, string>, remark?: string): string {
  const body = [...lines].map(([key, value]) => `${key} = ${value}\n`).join("");
  const block = `[${path.map(writeKey).join(".")}]${remark ? `  # ${remark}` : ""}\n${body}`;
  const { sections } = parseToml(text);
  let before = sections.find((section) => rank(section.path) > rank(path));
  if (before && sections.some((section) => section.from > before!.from && rank(section.path) <= rank(path))) before = undefined;
  if (before) return text.slice(0, before.from) + block + "\n" + text.slice(before.from);
  const end = text.replace(/\s*$/, "");
  return (end ? end + "\n\n" : "") + block;
}

function behindBlankLines(text: string, at: number): number {
  const blank = /^(?:[ \t]*\r?\n)+/.exec(text.slice(at));
  return at + (blank?.[0].length ?? 0);
}

function trimmedEnd(text: string, at: number): number {
  let end = at;
  while (text[end - 1] === " ") end--;
  return end;
}

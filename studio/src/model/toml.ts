// TOML with positions: what a text says, and where it says it, so that an edit can change one value and leave the
// rest, including comments, as its author wrote it. It continues reading after a fault and returns what it understood.

export interface Span {
  from: number;
  to: number;
}

export interface TextFault extends Span {
  message: string;
}

interface Place extends Span {
  /** The whole statement `key = value`, if there is one. */
  statement?: Span;
}

export interface TextNode extends Place {
  kind: "text";
  value: string;
}
export interface NumberNode extends Place {
  kind: "number";
  value: number;
}
export interface TruthNode extends Place {
  kind: "truth";
  value: boolean;
}
export interface ListNode extends Place {
  kind: "list";
  items: Node[];
}
export interface TableNode extends Place {
  kind: "table";
  entries: Map<string, Node>;
  /** How the table was defined: `[header]`, `a.b = 1`, `{ }`, or as the parent of one of these. */
  form: "header" | "dotted" | "inline" | "implied";
  /** Where a new line of this table is inserted; for dotted tables, after the last line with this prefix. */
  insertAt: number;
  /** The prefix of keys in lines of this table: "markers." for a dotted one. */
  prefix: string;
}
export type Node = TextNode | NumberNode | TruthNode | ListNode | TableNode;

/** `[header]` with the statements under it. */
export interface Section {
  path: string[];
  /** Start of the comment lines right above the header, or of the header. */
  from: number;
  header: Span;
  /** After the last statement's line. */
  to: number;
}

export interface Document {
  text: string;
  root: TableNode;
  sections: Section[];
  faults: TextFault[];
}

const BARE = /[A-Za-z0-9_-]/;

export function parseToml(text: string): Document {
  return new Reader(text).read();
}

export function lineColumn(text: string, offset: number): { line: number; column: number } {
  const before = text.slice(0, offset);
  const line = before.split("\n").length;
  return { line, column: offset - before.lastIndexOf("\n") };
}

class Fault extends Error {
  constructor(
    readonly from: number,
    readonly to: number,
    message: string,
  ) {
    super(message);
  }
}

class Reader {
  private at = 0;
  private readonly faults: TextFault[] = [];
  private readonly sections: Section[] = [];
  private readonly root: TableNode;

  constructor(private readonly text: string) {
    this.root = newTable("header", 0, 0);
  }

  read(): Document {
    let here: TableNode | null = this.root;
    let section: Section | null = null;
    let comments = -1; // start of a block of comment lines right above
    for (;;) {
      this.skipBlanks();
      if (this.at >= this.text.length) break;
      const start = this.at;
      const char = this.text[this.at];
      try {
        if (char === "\n" || char === "\r") {
          if (this.at === this.lineStart()) comments = -1;
          this.at++;
          continue;
        }
        if (char === "#") {
          if (comments < 0) comments = start;
          this.skipLine();
          continue;
        }
        if (char === "[") {
          const made = this.readHeader(comments < 0 ? start : comments);
          here = made.table;
          section = made.section;
        } else {
          this.readStatement(here ?? newTable("header", start, start));
          this.endOfStatement();
          if (section) section.to = this.at;
          if (here) here.insertAt = this.at;
        }
      } catch (fault) {
        if (!(fault instanceof Fault)) throw fault;
        this.faults.push({ from: fault.from, to: Math.max(fault.to, fault.from + 1), message: fault.message });
        if (char === "[") here = null;
        this.at = Math.max(this.at, start);
        this.skipLine();
      }
      comments = -1;
    }
    return { text: this.text, root: this.root, sections: this.sections, faults: this.faults };
  }

  private lineStart(): number {
    return this.text.lastIndexOf("\n", this.at - 1) + 1;
  }

  private skipBlanks(): void {
    while (this.text[this.at] === " " || this.text[this.at] === "\t") this.at++;
  }

  private skipLine(): void {
    const end = this.text.indexOf("\n", this.at);
    this.at = end < 0 ? this.text.length : end + 1;
  }

  private skipSpace(): void {
    for (;;) {
      const char = this.text[this.at];
      if (char === "#") this.skipLine();
      else if (char === " " || char === "\t" || char === "\n" || char === "\r") this.at++;
      else return;
    }
  }

  // Only a comment may follow on the line; moves `at` past the end of the line.
  private endOfStatement(): void {
    this.skipBlanks();
    const char = this.text[this.at];
    if (char !== undefined && char !== "\n" && char !== "\r" && char !== "#") {
      throw new Fault(this.at, this.at + 1, "unexpected text after the value: only one key per line");
    }
    this.skipLine();
  }

  private readHeader(from: number): { table: TableNode; section: Section } {
    const start = this.at;
    this.at++;
    if (this.text[this.at] === "[") throw new Fault(start, start + 2, "lists of tables are not allowed in a model");
    this.skipBlanks();
    const path = this.readKeys();
    if (this.text[this.at] !== "]") throw new Fault(start, this.at + 1, 'a header ends in "]"');
    this.at++;
    const header = { from: start, to: this.at };
    this.endOfStatement();
    let table = this.root;
    path.forEach((key, i) => {
      const last = i === path.length - 1;
      const found = table.entries.get(key);
      if (found && found.kind !== "table") throw new Fault(header.from, header.to, `"${key}" is a value, not a table`);
      if (found && last && found.form !== "implied") {
        throw new Fault(header.from, header.to, `the table [${path.join(".")}] is defined twice`);
      }
      const next = found ?? newTable(last ? "header" : "implied", header.from, header.to);
      if (!found) table.entries.set(key, next);
      table = next as TableNode;
    });
    Object.assign(table, { form: "header", from: header.from, to: header.to, insertAt: this.at });
    const section = { path, from, header, to: this.at };
    this.sections.push(section);
    return { table, section };
  }

  private readKeys(): string[] {
    const keys = [this.readKey()];
    for (;;) {
      this.skipBlanks();
      if (this.text[this.at] !== ".") return keys;
      this.at++;
      this.skipBlanks();
      keys.push(this.readKey());
    }
  }

  private readKey(): string {
    const start = this.at;
    const char = this.text[this.at];
    if (char === '"' || char === "'") return this.readText().value;
    while (this.at < this.text.length && BARE.test(this.text[this.at]!)) this.at++;
    if (this.at === start) throw new Fault(start, start + 1, "a key was expected here");
    return this.text.slice(start, this.at);
  }

  private readStatement(home: TableNode): void {
    const start = this.at;
    const keys = this.readKeys();
    if (this.text[this.at] !== "=") throw new Fault(start, Math.max(this.at, start + 1), `"=" and a value must follow ${keys.join(".")}`);
    this.at++;
    this.skipBlanks();
    const value = this.readValue();
    value.statement = { from: start, to: this.at };
    let table = home;
    let prefix = home.form === "inline" ? "" : home.prefix;
    const lineEnd = this.text.indexOf("\n", this.at);
    for (const key of keys.slice(0, -1)) {
      const found = table.entries.get(key);
      if (found && found.kind !== "table") throw new Fault(start, this.at, `"${key}" is a value, not a table`);
      const next = found ?? newTable("dotted", start, this.at);
      prefix += writeKey(key) + ".";
      if (next.kind !== "table") return;
      if (!found) table.entries.set(key, next);
      if (next.form === "dotted") Object.assign(next, { prefix, insertAt: lineEnd < 0 ? this.text.length : lineEnd + 1, to: this.at });
      table = next;
    }
    const last = keys[keys.length - 1]!;
    if (table.entries.has(last)) throw new Fault(start, this.at, `${keys.join(".")} is defined twice`);
    table.entries.set(last, value);
  }

  private readValue(): Node {
    const start = this.at;
    const char = this.text[this.at];
    if (char === '"' || char === "'") return this.readText();
    if (char === "[") return this.readList();
    if (char === "{") return this.readInline();
    const word = /^[^\s,\]}#]+/.exec(this.text.slice(start, start + 80))?.[0] ?? "";
    if (word === "true" || word === "false") {
      this.at += word.length;
      return { kind: "truth", value: word === "true", from: start, to: this.at };
    }
    if (/^[+-]?(\d[\d_]*)(\.\d[\d_]*)?([eE][+-]?\d+)?$/.test(word) || /^[+-]?(inf|nan)$/.test(word)) {
      this.at += word.length;
      return { kind: "number", value: Number(word.replace(/_/g, "").replace("inf", "Infinity")), from: start, to: this.at };
    }
    this.at += word.length;
    throw new Fault(start, Math.max(this.at, start + 1), word ? `"${word}" is not a number; expressions need quotes: "${word}"` : "a value is missing here");
  }

  private readText(): TextNode {
    const start = this.at;
    const quote = this.text[this.at]!;
    const triple = this.text.startsWith(quote.repeat(3), this.at);
    const ending = triple ? quote.repeat(3) : quote;
    this.at += ending.length;
    if (triple && this.text[this.at] === "\n") this.at++;
    let value = "";
    while (!this.text.startsWith(ending, this.at)) {
      const char = this.text[this.at];
      if (char === undefined || (!triple && char === "\n")) {
        throw new Fault(start, this.at, `a string that begins with ${ending} is not closed`);
      }
      if (char === "\\" && quote === '"') value += this.readEscape();
      else {
        value += char;
        this.at++;
      }
    }
    this.at += ending.length;
    return { kind: "text", value, from: start, to: this.at };
  }

  private readEscape(): string {
    const char = this.text[this.at + 1] ?? "";
    const simple: Record<string, string> = { n: "\n", t: "\t", r: "\r", b: "\b", f: "\f", '"': '"', "\\": "\\" };
    if (char in simple) {
      this.at += 2;
      return simple[char]!;
    }
    const digits = char === "u" ? 4 : char === "U" ? 8 : 0;
    const code = this.text.slice(this.at + 2, this.at + 2 + digits);
    if (!digits || !/^[0-9a-fA-F]+$/.test(code) || Number.parseInt(code, 16) > 0x10ffff) {
      throw new Fault(this.at, this.at + 2, `"\\${char}" is not a TOML escape`);
    }
    this.at += 2 + digits;
    return String.fromCodePoint(Number.parseInt(code, 16));
  }

  private readList(): ListNode {
    const start = this.at++;
    const items: Node[] = [];
    for (;;) {
      this.skipSpace();
      if (this.text[this.at] === "]") break;
      if (this.at >= this.text.length) throw new Fault(start, this.at, 'this list is not closed: "]" is missing');
      items.push(this.readValue());
      this.skipSpace();
      if (this.text[this.at] === ",") this.at++;
      else if (this.text[this.at] !== "]") throw new Fault(this.at, this.at + 1, 'a comma or "]" was expected in this list');
    }
    this.at++;
    return { kind: "list", items, from: start, to: this.at };
  }

  private readInline(): TableNode {
    const start = this.at++;
    const table = newTable("inline", start, start);
    for (;;) {
      this.skipBlanks();
      if (this.text[this.at] === "}") break;
      this.readStatement(table);
      this.skipBlanks();
      if (this.text[this.at] === ",") this.at++;
      else if (this.text[this.at] !== "}") throw new Fault(this.at, this.at + 1, 'a comma or "}" was expected');
    }
    table.insertAt = this.at;
    this.at++;
    table.to = this.at;
    return table;
  }
}

function newTable(form: TableNode["form"], from: number, to: number): TableNode {
  return { kind: "table", entries: new Map(), form, from, to, insertAt: to, prefix: "" };
}

export function writeKey(key: string): string {
  return /^[A-Za-z0-9_-]+$/.test(key) ? key : JSON.stringify(key);
}

export function nodeAt(root: TableNode, path: readonly string[]): Node | undefined {
  let node: Node | undefined = root;
  for (const key of path) {
    if (node?.kind !== "table") return undefined;
    node = node.entries.get(key);
  }
  return node;
}

export type Plain = string | number | boolean | Plain[] | { [key: string]: Plain };

export function plain(node: Node): Plain {
  if (node.kind === "table") return Object.fromEntries([...node.entries].map(([key, value]) => [key, plain(value)]));
  if (node.kind === "list") return node.items.map(plain);
  return node.value;
}

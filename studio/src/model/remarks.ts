// Comments for facts that the format cannot express. They follow a value or a header, after the author's own comment if
// there is one; any comment that is not exactly one of these belongs to the author and stays.
import { FROM_SHAPE, isShape } from "./shape";
import type { Document, Node, Span } from "./toml";

/** After a marker: its path is to be drawn. */
export const TRACE = "trace";

const isOwn = (words: string): boolean => words === TRACE || words === FROM_SHAPE || isShape(words);

// The rest of a line, if it contains nothing but a comment.
function comment(text: string, from: number): { span: Span; words: string } {
  const end = /\r?$/m.exec(text.slice(from))!.index + from;
  const words = text.slice(from, end);
  return { span: { from, to: end }, words: /^\s*(#|$)/.test(words) ? words : "" };
}

/** The studio's remark at the end of the line that contains `offset`; empty if there is none. */
export function remarkAt({ text }: Document, offset: number): string {
  const words = comment(text, offset).words.split("#").slice(1);
  return words.map((one) => one.trim()).find(isOwn) ?? "";
}

export function remarkOf(document: Document, node: Node | undefined): string {
  return node?.statement ? remarkAt(document, node.statement.to) : "";
}

/** The end of a line with this remark, or without any if it is empty; null if the line continues and cannot have a comment. */
export function withRemark({ text }: Document, offset: number, remark: string): (Span & { text: string }) | null {
  const { span, words } = comment(text, offset);
  if (words === "" && span.to > span.from) return null;
  const kept = words.split(/(?=#)/).filter((one) => !one.startsWith("#") || !isOwn(one.slice(1).trim()));
  const rest = kept.join("").trimEnd();
  return { ...span, text: remark ? `${rest}  # ${remark}` : rest };
}

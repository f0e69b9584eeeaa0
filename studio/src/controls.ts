// The keys that a focused control needs for itself; all others belong to the page, whatever has the focus.

const TEXT_INPUTS = /^(text|search|number|url|email|tel|password|date|time)?$/;

/** Whether the target is for typing text: then it needs every key. */
export function isTyping(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.isContentEditable || target.tagName === "TEXTAREA") return true;
  return target.tagName === "INPUT" && TEXT_INPUTS.test((target as HTMLInputElement).type);
}

const PRESSED = "button, a, summary, select, input[type=checkbox], input[type=radio], [role=tab], [role=slider]";
const MOVED = "[role=tablist], [role=slider], [role=menu], .plot, table, input, select";

/** Whether the key operates the control or moves within it. */
export function ownsKey(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof Element)) return false;
  if (key === " " || key === "Enter") return target.closest(PRESSED) !== null;
  return /^Arrow/.test(key) && target.closest(MOVED) !== null;
}

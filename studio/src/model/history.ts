// Unlimited undo: each step stores only what it changed, so that a thousand edits of a large model take little memory.

interface Change {
  at: number;
  removed: string;
  inserted: string;
  /** Description of the step for the menu: "Add link". */
  label: string;
  /** Consecutive steps with the same key are merged: typing, dragging. */
  key: string;
}

export interface History {
  readonly text: string;
  readonly past: readonly Change[];
  readonly future: readonly Change[];
  /** The last step has been undone and redone: the next change is a new step. */
  readonly closed?: boolean;
}

export function newHistory(text: string): History {
  return { text, past: [], future: [] };
}

function difference(before: string, after: string, label: string, key: string): Change {
  let start = 0;
  const shorter = Math.min(before.length, after.length);
  while (start < shorter && before.charCodeAt(start) === after.charCodeAt(start)) start++;
  let end = 0;
  while (end < shorter - start && before.charCodeAt(before.length - 1 - end) === after.charCodeAt(after.length - 1 - end)) end++;
  return { at: start, removed: before.slice(start, before.length - end), inserted: after.slice(start, after.length - end), label, key };
}

/** Adds a step. If the last step has the same key, both are merged. */
export function change(history: History, text: string, label: string, key = ""): History {
  if (text === history.text) return history;
  const last = history.past[history.past.length - 1];
  if (key && last?.key === key && !history.closed && history.future.length === 0) {
    const before = back(history.text, last);
    const past = history.past.slice(0, -1);
    return { text, past: before === text ? past : [...past, difference(before, text, label, key)], future: [] };
  }
  return step(history, text, label, key);
}

/** Adds a step even if it leaves the text as it is: another file with the same text. */
export function step(history: History, text: string, label: string, key: string): History {
  return { text, past: [...history.past, difference(history.text, text, label, key)], future: [] };
}

function back(text: string, step: Change): string {
  return text.slice(0, step.at) + step.removed + text.slice(step.at + step.inserted.length);
}

function forth(text: string, step: Change): string {
  return text.slice(0, step.at) + step.inserted + text.slice(step.at + step.removed.length);
}

export function undo(history: History): History {
  const step = history.past[history.past.length - 1];
  if (!step) return history;
  return { text: back(history.text, step), past: history.past.slice(0, -1), future: [step, ...history.future] };
}

export function redo(history: History): History {
  const [step, ...rest] = history.future;
  if (!step) return history;
  return { text: forth(history.text, step), past: [...history.past, step], future: rest, closed: true };
}

import { describe, expect, it } from "vitest";
import { change, newHistory, redo, undo } from "./history";
import { Typing } from "./strokes";

it("undoes and redoes any number of steps exactly", () => {
  let history = newHistory("start");
  const texts = ["start"];
  let seed = 7;
  for (let i = 0; i < 300; i++) {
    seed = (seed * 48271) % 2147483647;
    const now = texts[texts.length - 1]!;
    const at = seed % (now.length + 1);
    const next = now.slice(0, at) + "abcdefgh".slice(0, (seed % 7) + 1) + now.slice(at + (seed % 4));
    if (next === now) continue; // no step
    texts.push(next);
    history = change(history, texts[texts.length - 1]!, "step");
  }
  for (let i = texts.length - 2; i >= 0; i--) expect((history = undo(history)).text).toBe(texts[i]);
  expect(undo(history)).toBe(history);
  for (let i = 1; i < texts.length; i++) expect((history = redo(history)).text).toBe(texts[i]);
});

it("joins steps with one key, and a new step ends redo", () => {
  let history = change(newHistory("a"), "ab", "type", "k");
  history = change(history, "abc", "type", "k");
  expect(history.past).toHaveLength(1);
  history = undo(history);
  expect(history.text).toBe("a");
  history = change(history, "x", "other");
  expect(redo(history).text).toBe("x");
});

describe("typing", () => {
  const steps = (strokes: [now: number, from: number, to: number, inserted: string][]) => {
    const typing = new Typing();
    return strokes.map(([now, from, to, inserted]) => typing.key(now, [{ from, to, inserted }]));
  };
  it("in one place is one step, with what is taken back at once", () => {
    expect(new Set(steps([[0, 5, 5, "a"], [200, 6, 6, "b"], [400, 6, 7, ""], [600, 6, 6, "c"]])).size).toBe(1);
  });
  it("is another step behind a pause, a jump, a new line", () => {
    expect(new Set(steps([[0, 5, 5, "a"], [2000, 6, 6, "b"]])).size).toBe(2);
    expect(new Set(steps([[0, 5, 5, "a"], [200, 90, 90, "b"]])).size).toBe(2);
    const [a, line, b] = steps([[0, 5, 5, "a"], [200, 6, 6, "\n  "], [400, 9, 9, "b"]]);
    expect([a === line, line === b]).toEqual([true, false]);
  });
});

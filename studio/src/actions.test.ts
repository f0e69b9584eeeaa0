import "../tests/page";
import { expect, it } from "vitest";
import { edit, editText, openText, removeSelection, undo } from "./actions";
import { EMPTY_MODEL, addBar } from "./model/operations";
import { readModel } from "./model/model";
import { studio } from "./state";

const bar = addBar(readModel(EMPTY_MODEL), { at: [0, 0], end: null, body: null }, { at: [0.1, 0], end: null, body: null }).text;

it("keeps what was typed while the text cannot be read", () => {
  openText(bar, "a.toml");
  const typed = `${bar}\n[spring.s\n`;
  editText(typed, "Edit the text", "typing");
  studio.set({ selection: [{ kind: "body", name: "link1" }], toasts: [] });
  removeSelection();
  expect(edit(bar, "Move")).toBe(false);
  expect(studio.get().history.text).toBe(typed);
  const [toast, ...more] = studio.get().toasts;
  expect(more).toEqual([]);
  expect(toast?.text).toContain(`line ${typed.split("\n").indexOf("[spring.s") + 1}`);
  undo();
  removeSelection();
  expect(studio.get().model.bodies).toEqual([]);
});

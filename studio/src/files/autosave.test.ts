import { local, page, session } from "../../tests/page";
import { beforeEach, describe, expect, it, vi } from "vitest";
import { claimDraft, listDrafts, readDraft, writeDraft } from "./drafts";
import { EMPTY_MODEL } from "../model/operations";

const storage = local as unknown as Storage;
const tab = session as unknown as Storage;
const draft = (text: string, more = {}) => ({ text, fileName: "a.toml", savedText: "", home: null, files: {}, before: [], opened: [], time: Date.now(), closed: false, ...more });

/** Reloads the page's modules, as in a new tab. */
async function visit() {
  vi.resetModules();
  const autosave = await import("./autosave");
  const { studio } = await import("../state");
  const { editText, openText, undo, redo } = await import("../actions");
  autosave.restore();
  autosave.startAutosave();
  return { ...autosave, studio, editText, openText, undo, redo };
}
const model = (name: string) => `${EMPTY_MODEL}# ${name}\n`;

describe("drafts", () => {
  beforeEach(() => {
    vi.useFakeTimers();
    local.entries.clear();
    local.room = Number.POSITIVE_INFINITY;
    session.entries.clear();
    vi.stubGlobal("window", Object.assign(new EventTarget(), Object.fromEntries(Object.entries(page))));
  });

  it("of two tabs are two, and each comes back in its own", async () => {
    const one = await visit();
    one.editText(model("one"), "Edit");
    vi.advanceTimersByTime(200);
    const mine = new Map(session.entries);
    session.entries.clear();
    const two = await visit();
    two.editText(model("two"), "Edit");
    vi.advanceTimersByTime(200);
    expect(listDrafts(storage).map((one) => one.text).sort()).toEqual([model("one"), model("two")]);
    expect(two.otherDrafts().map((one) => one.text)).toEqual([model("one")]);
    session.entries.clear();
    for (const [key, value] of mine) session.setItem(key, value);
    const again = await visit();
    expect(again.studio.get().history.text).toBe(model("one"));
    again.openDraft(again.otherDrafts()[0]!.id);
    expect(again.studio.get().history.text).toBe(model("two"));
  });

  it("leads back by undo to the file and the tables of the text before", async () => {
    const home = (path: string) => ({ kind: "folder" as const, folder: "models", path, hash: path });
    const one = await visit();
    const tables = (of: string) => ({ "mine.csv": of });
    one.openText(model("a"), "a.toml", { home: home("a.toml"), files: tables("a") });
    one.editText(model("a1"), "Edit");
    one.openText(model("b"), "b.toml", { home: home("b.toml"), files: tables("b") });
    one.editText(model("b1"), "Edit");
    vi.advanceTimersByTime(200);
    const again = await visit();
    const seen = () => [again.studio.get().history.text, again.studio.get().home, again.studio.get().files] as const;
    expect(seen()).toEqual([model("b1"), home("b.toml"), tables("b")]);
    again.undo();
    again.undo();
    expect(seen()).toEqual([model("a1"), home("a.toml"), tables("a")]);
    again.undo();
    again.undo();
    expect(seen()).toEqual([EMPTY_MODEL, null, {}]);
    for (let i = 0; i < 4; i++) again.redo();
    expect(seen()).toEqual([model("b1"), home("b.toml"), tables("b")]);
  });

  it("keeps the text where there is no room for its tables", () => {
    local.room = 2000;
    expect(writeDraft(storage, "large", draft(model("a"), { files: { "mine.csv": "0,1\n".repeat(1000) } }))).toBe(true);
    expect(readDraft(storage, "large")).toMatchObject({ text: model("a"), files: {} });
  });

  it("goes on in a new tab where the last one was closed, but not where one is open", async () => {
    writeDraft(storage, "open", draft(model("open"), { time: 3 }));
    writeDraft(storage, "left", draft(model("left"), { time: 2, closed: true }));
    expect(claimDraft(storage, tab).draft?.id).toBe("left");
    expect(claimDraft(storage, tab).id).toBe("left");
  });

  it("gives a doubled tab a name of its own", () => {
    const { id } = claimDraft(storage, tab);
    writeDraft(storage, id, draft(model("a")));
    const doubled = claimDraft(storage, tab);
    expect(doubled.draft?.text).toBe(model("a"));
    expect(doubled.id).not.toBe(id);
  });

  it("takes over the one draft of before", () => {
    storage.setItem("pintle-studio", JSON.stringify({ text: model("old"), fileName: "o.toml", savedText: "", before: [] }));
    expect(claimDraft(storage, tab).draft?.text).toBe(model("old"));
  });

  it("is marked closed when the page is left", async () => {
    const { editText } = await visit();
    editText(model("a"), "Edit");
    window.dispatchEvent(new Event("pagehide"));
    expect(listDrafts(storage)).toMatchObject([{ text: model("a"), closed: true }]);
  });

  it("says once that the store refuses", async () => {
    const { editText, studio } = await visit();
    local.room = 0;
    for (const name of ["a", "b", "c"]) {
      editText(model(name), "Edit");
      vi.advanceTimersByTime(200);
    }
    expect(studio.get().toasts.filter((toast) => /cannot store/.test(toast.text))).toHaveLength(1);
  });

  it("keeps the newest dozen, unsaved ones before saved ones", () => {
    for (let i = 0; i < 14; i++) writeDraft(storage, `d${i}`, draft(model(String(i)), { time: i, closed: true, savedText: i === 5 || i === 7 ? model(String(i)) : "" }));
    expect(listDrafts(storage)).toHaveLength(12);
    expect(readDraft(storage, "d5")).toBeNull();
    expect(readDraft(storage, "d0")).not.toBeNull();
  });
});

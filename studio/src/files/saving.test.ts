import { local, session } from "../../tests/page";
import { beforeEach, describe, expect, it, vi } from "vitest";
import { edit, openText, redo, undo } from "../actions";
import { KernelFault } from "../kernel/fault";
import { newHistory } from "../model/history";
import { EMPTY_MODEL } from "../model/operations";
import { studio } from "../state";
import { saveFile, saveUnder, take } from "./disk";
import { openFromFolder, startFolder } from "./folder";

/** The folder of a server, in which a text serves as its own hash. */
const files = new Map<string, string>();
/** What its tables contain, by the path of the model that names them. */
const tables = new Map<string, Record<string, string>>();
const server = {
  version: "0",
  folder: "models",
  model: null as string | null,
  list: async () => [],
  open: async (path: string) => ({ path, text: files.get(path)!, hash: files.get(path)!, files: tables.get(path) ?? {} }),
  save: async (path: string, text: string, expected: string | null) => {
    await new Promise((resolve) => setTimeout(resolve, 5));
    const now = files.get(path) ?? null;
    if (now !== expected) return { conflict: { text: now, hash: now } };
    files.set(path, text);
    return { hash: text };
  },
};
vi.mock("../play/kernel-session", () => ({ kernel: { native: async () => server, write: async () => ({ text: "# from JSON\n" }) } }));

const model = (name: string) => `${EMPTY_MODEL}# ${name}\n`;
const now = () => studio.get();
const said = () => now().toasts.at(-1);

describe("saving in the folder of pintle studio", () => {
  beforeEach(async () => {
    files.clear();
    tables.clear();
    local.entries.clear();
    await startFolder();
    studio.set({ dialog: null, toasts: [] });
  });

  it("asks a new drawing its name, and never takes another file's", async () => {
    openText(model("one"), "untitled.toml");
    await saveFile();
    expect(now().dialog).toBe("save");
    await saveUnder("one");
    expect(files.get("one.toml")).toBe(model("one"));
    studio.set({ dialog: null });
    openText(model("two"), "one.toml");
    await saveFile();
    expect(now().dialog).toBe("save");
    await saveUnder("one.toml");
    expect(files.get("one.toml")).toBe(model("one"));
    expect(said()?.text).toMatch(/already exists/);
    said()!.action!.run();
    await vi.waitFor(() => expect(files.get("one.toml")).toBe(model("two")));
  });

  it("gives each text its own file again on undo and redo", async () => {
    files.set("A/x.toml", model("a")).set("B/x.toml", model("b"));
    await openFromFolder("A/x.toml");
    await openFromFolder("B/x.toml");
    edit(model("b, changed"), "Edit");
    await saveFile();
    undo();
    undo();
    expect(now().fileName).toBe("A/x.toml");
    edit(model("a, changed"), "Edit");
    await saveFile();
    expect([...files]).toEqual([["A/x.toml", model("a, changed")], ["B/x.toml", model("b, changed")]]);
    undo();
    redo();
    expect(now().home).toMatchObject({ path: "A/x.toml", hash: model("a, changed") });
    expect(now().savedText).toBe(model("a, changed"));
  });

  it("gives each text its own tables again on undo and redo, though they have the same name", async () => {
    files.set("A/x.toml", model("a")).set("B/x.toml", model("b"));
    tables.set("A/x.toml", { "mine.csv": "a" }).set("B/x.toml", { "mine.csv": "b" });
    await openFromFolder("A/x.toml");
    await openFromFolder("B/x.toml");
    expect(now().files).toEqual({ "mine.csv": "b" });
    undo();
    expect(now().files).toEqual({ "mine.csv": "a" });
    redo();
    expect(now().files).toEqual({ "mine.csv": "b" });
  });

  it("leads back by undo to another file with the same text, but has no step for the same file again", async () => {
    files.set("A/x.toml", model("same")).set("B/x.toml", model("same"));
    tables.set("A/x.toml", { "mine.csv": "a" }).set("B/x.toml", { "mine.csv": "b" });
    await openFromFolder("A/x.toml");
    const steps = now().history.past.length;
    await openFromFolder("A/x.toml");
    expect(now().history.past.length).toBe(steps);
    await openFromFolder("B/x.toml");
    expect([now().fileName, now().files]).toEqual(["B/x.toml", { "mine.csv": "b" }]);
    undo();
    expect([now().fileName, now().files]).toEqual(["A/x.toml", { "mine.csv": "a" }]);
  });

  it("saves twice in a row without a conflict with itself", async () => {
    files.set("a.toml", model("a"));
    await openFromFolder("a.toml");
    edit(model("a1"), "Edit");
    const first = saveFile();
    edit(model("a2"), "Edit");
    await Promise.all([first, saveFile()]);
    expect(files.get("a.toml")).toBe(model("a2"));
    expect(now().toasts.filter((toast) => toast.action)).toEqual([]);
  });

  it("does not write over what another program wrote, nor another model by a late answer", async () => {
    files.set("a.toml", model("a"));
    await openFromFolder("a.toml");
    files.set("a.toml", model("theirs"));
    edit(model("mine"), "Edit");
    await saveFile();
    expect(said()?.text).toMatch(/changed by another program/);
    const { run } = said()!.action!;
    openText(model("quite another"), "b.toml");
    run();
    await new Promise((resolve) => setTimeout(resolve, 20));
    expect(files.get("a.toml")).toBe(model("theirs"));
  });

  it("says what is wrong with a folder or a name, and what to try", async () => {
    vi.spyOn(server, "save").mockRejectedValueOnce(new KernelFault({ message: "There is no such folder.", hint: "Make the folder first." }));
    openText(model("one"), "untitled.toml");
    await saveUnder("nowhere/one");
    expect(said()?.text).toBe("There is no such folder. Make the folder first.");
    vi.spyOn(server, "open").mockRejectedValueOnce(new KernelFault({ message: "There is no such model file.", hint: "" }));
    await openFromFolder("gone.toml");
    expect(said()?.text).toBe("There is no such model file.");
  });

  it("opens JSON as a new TOML file", async () => {
    files.set("m/a.json", "{}");
    await openFromFolder("m/a.json");
    expect([now().history.text, now().fileName, now().home]).toEqual(["# from JSON\n", "m/a.toml", null]);
    await saveFile();
    expect(now().dialog).toBe("save");
  });
});

describe("the model that pintle studio was started with", () => {
  const mine = { document: 900, files: {} as Record<string, string>, fileName: "a.toml", home: { kind: "folder" as const, folder: "models", path: "a.toml", hash: model("disk") }, savedText: model("disk") };
  const begin = async (token: string, text: string, mayOpen = true) => {
    session.setItem("pintle.token", token);
    studio.set({ ...mine, history: newHistory(text), toasts: [] });
    await startFolder(mayOpen);
    return now().history.text;
  };
  beforeEach(() => {
    session.entries.clear();
    files.clear();
    tables.clear();
    files.set("a.toml", model("disk"));
    server.model = "a.toml";
  });

  it("is opened once, and a reload keeps what was done since", async () => {
    studio.set({ home: null });
    expect(await begin("1", EMPTY_MODEL)).toBe(EMPTY_MODEL);
    expect(said()?.text).toMatch(/unsaved work/);
    said()!.action!.run();
    await vi.waitFor(() => expect(now().history.text).toBe(model("disk")));
    expect(await begin("1", model("mine"))).toBe(model("mine"));
    expect(said()).toBeUndefined();
  });

  it("comes after a link's, and a restart of the program asks before it replaces work on it", async () => {
    expect(await begin("1", model("link"), false)).toBe(model("link"));
    expect(now().folder?.name).toBe("models");
    expect(await begin("2", model("mine"))).toBe(model("mine"));
    expect(said()?.action?.label).toBe("Open the file");
    expect(await begin("3", model("disk"))).toBe(model("disk"));
    tables.set("a.toml", { "mine.csv": "1" });
    expect(await begin("3", model("disk"))).toBe(model("disk"));
    expect(now().files).toEqual({ "mine.csv": "1" });
    files.set("a.toml", model("theirs"));
    expect(await begin("3", model("disk"))).toBe(model("theirs"));
  });
});

it("reads the tables of unsaved work again after a reload, and keeps those that only its text names", async () => {
  server.model = null;
  files.set("a.toml", model("disk"));
  tables.set("a.toml", { "mine.csv": "new" });
  const home = { kind: "folder" as const, folder: "models", path: "a.toml", hash: model("disk") };
  studio.set({ home, savedText: model("disk"), history: newHistory(model("mine")), files: { "mine.csv": "old", "other.csv": "kept" } });
  await startFolder();
  expect(now().history.text).toBe(model("mine"));
  expect(now().files).toEqual({ "mine.csv": "new", "other.csv": "kept" });
});

it("says that a dropped folder cannot be read", async () => {
  await take({ name: "stuff", size: 4096, text: () => Promise.reject(new Error("NotReadableError")) } as unknown as File);
  expect(said()?.text).toMatch(/stuff cannot be read/);
});

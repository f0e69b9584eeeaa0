// The folder of `pintle studio`, if that program serves the page: models are opened from it and saved into it.
import { noteSaved, openText, say, sayFault, showFaults } from "../actions";
import { type NativeServer, sessionToken } from "../kernel/native";
import { kernel } from "../play/kernel-session";
import { studio } from "../state";
import { asModel, tomlName } from "./models";
import { inTurn } from "./turns";

let server: NativeServer | null = null;

export const inFolder = (): boolean => server !== null;

const BEGUN = "pintle-studio:begun";

/** Looks for the program that serves the page, and opens the model it was started with: once per tab, not at each reload. */
export async function startFolder(mayOpen = true): Promise<void> {
  server = await kernel.native().catch(() => null);
  if (!server) return;
  studio.set({ folder: { name: server.folder, models: [] } });
  const { model } = server;
  const { home, history, savedText, document } = studio.get();
  const path = home?.kind === "folder" && home.folder === server.folder ? home.path : null;
  const unsaved = history.text !== savedText;
  const start = `${sessionToken()} ${model}`;
  if (!model || !mayOpen || kept(BEGUN) === start) {
    keep(BEGUN, start);
    if (mayOpen && path) await refresh(path);
    return;
  }
  keep(BEGUN, start);
  if (path !== model || !unsaved) return openFromFolder(model);
  const open = () => (studio.get().document === document ? void openFromFolder(model) : undefined);
  say(`This is your unsaved work on ${model}.`, { label: "Open the file", run: open });
  await refresh(model);
}

// Another program may have written the file or its tables since. Unsaved work keeps its text.
async function refresh(path: string): Promise<void> {
  const { document } = studio.get();
  const read = await server?.open(path).catch(() => null);
  const { history, savedText, files, document: openNow } = studio.get();
  if (!read || openNow !== document) return;
  if (read.text !== history.text && history.text === savedText) return openFromFolder(path);
  if (Object.entries(read.files).some(([name, table]) => files[name] !== table)) studio.set({ files: { ...files, ...read.files } });
}

// For the lifetime of the tab.
function kept(key: string): string | null {
  try {
    return sessionStorage.getItem(key);
  } catch {
    return null;
  }
}

function keep(key: string, value: string): void {
  try {
    sessionStorage.setItem(key, value);
  } catch {
    // The model is opened again at the next reload; undo leads back.
  }
}

export async function showFolder(): Promise<void> {
  if (!server) return;
  try {
    studio.set({ folder: { name: server.folder, models: await server.list() }, dialog: "folder" });
  } catch (error) {
    sayFault(error);
  }
}

export async function openFromFolder(path: string): Promise<void> {
  if (!server) return;
  try {
    const { text, hash, files } = await server.open(path);
    const model = await asModel(path, text);
    openText(model.text, model.fileName, { files, ...(model.converted ? { savedText: "" } : { home: { kind: "folder", folder: server.folder, path, hash } }) });
    showFaults();
    studio.set({ dialog: null });
  } catch (error) {
    sayFault(error);
  }
}

/** Saves to where the text came from; asks for a name if it is new. */
export async function saveToFolder(): Promise<void> {
  const { home } = studio.get();
  if (home?.kind !== "folder" || home.folder !== server?.folder) return studio.set({ dialog: "save" });
  await write(home.path, home.hash);
}

/** Saves under a name. A file of that name other than the open one is not overwritten without asking. */
export async function saveInFolderAs(name: string): Promise<void> {
  const path = tomlName(name);
  const { home } = studio.get();
  await write(path, home?.kind === "folder" && home.folder === server?.folder && home.path === path ? home.hash : null);
}

async function write(path: string, expected: string | null): Promise<void> {
  if (!server) return;
  const { document, history } = studio.get();
  try {
    const saved = await server.save(path, history.text, expected);
    if ("hash" in saved) {
      noteSaved(document, { fileName: path, home: { kind: "folder", folder: server.folder, path, hash: saved.hash }, savedText: history.text });
      return say(`Saved ${path} in ${server.folder}.`);
    }
    const { hash } = saved.conflict;
    const why = hash === null ? "no longer exists" : expected === null ? "already exists" : "was changed by another program";
    const again = () => (studio.get().document === document ? void inTurn(() => write(path, hash)) : say("Another model is open now: nothing was written."));
    say(`${path} ${why}.`, { label: hash === null ? "Write it again" : "Overwrite it", run: again });
  } catch (error) {
    sayFault(error);
  }
}

// Opening, saving and dropping files. Saving writes in place if the browser can do that, else it downloads.
import { noteSaved, openText, say, showFaults } from "../actions";
import { type WritableHandle, studio } from "../state";
import { inFolder, saveInFolderAs, saveToFolder, showFolder } from "./folder";
import { asModel, tomlName } from "./models";
import { inTurn } from "./turns";

interface PickerWindow {
  showOpenFilePicker?: (options: object) => Promise<WritableHandle[]>;
  showSaveFilePicker?: (options: object) => Promise<WritableHandle>;
}

const TYPES = [{ description: "Pintle model", accept: { "text/plain": [".toml"], "application/json": [".json"] } }];
const LARGEST = 20e6;
const pickers = window as unknown as PickerWindow;

export async function openFile(): Promise<void> {
  return inFolder() ? showFolder() : pickFile();
}

/** Opens a file from the user's computer. */
export async function pickFile(): Promise<void> {
  if (pickers.showOpenFilePicker) {
    const picked = await pickers.showOpenFilePicker({ types: TYPES }).catch(() => null);
    const first = picked?.[0];
    return first && take(await first.getFile(), first);
  }
  const input = document.createElement("input");
  input.type = "file";
  input.accept = ".toml,.json,text/plain";
  input.onchange = () => input.files?.[0] && void take(input.files[0]);
  input.click();
}

/** Opens a file that was chosen or dropped; a faulty one opens as text, with its complaints. */
export async function take(file: File, handle: WritableHandle | null = null): Promise<void> {
  if (file.size > LARGEST) return say(`${file.name} has ${Math.round(file.size / 1e6)} MB, too large for a model.`);
  let text: string;
  try {
    text = await file.text();
  } catch {
    return say(`${file.name} cannot be read: it is a folder or has been moved.`);
  }
  if (text.includes("\u0000")) return say(`${file.name} is not a text file.`);
  const model = await asModel(file.name, text);
  openText(model.text, model.fileName, model.converted ? { savedText: "" } : { home: handle && { kind: "handle", handle } });
  showFaults();
  say(`Opened ${file.name}. Undo returns to the previous model.`);
}

/** Saves to the file that the text came from, or asks for a new file. */
export function saveFile(): Promise<void> {
  return inTurn(async () => {
    const { home } = studio.get();
    if (home?.kind === "handle") return writeTo(home.handle);
    if (inFolder()) return saveToFolder();
    return pickers.showSaveFilePicker ? saveToPicked() : downloadModel(studio.get().fileName);
  });
}

/** Asks for a name in any case. */
export async function saveFileAs(): Promise<void> {
  if (inFolder() || !pickers.showSaveFilePicker) studio.set({ dialog: "save" });
  else await inTurn(saveToPicked);
}

/** Saves under a typed name: in the folder, or as a download. */
export function saveUnder(name: string): Promise<void> {
  return inTurn(async () => (inFolder() ? saveInFolderAs(name) : downloadModel(tomlName(name))));
}

async function saveToPicked(): Promise<void> {
  const { fileName } = studio.get();
  try {
    const handle = await pickers.showSaveFilePicker?.({ suggestedName: fileName.replace(/^.*\//, ""), types: TYPES });
    if (handle) await writeTo(handle);
  } catch (error) {
    if (!(error instanceof DOMException && error.name === "AbortError")) downloadModel(fileName);
  }
}

async function writeTo(handle: WritableHandle): Promise<void> {
  const { document, history } = studio.get();
  try {
    const stream = await handle.createWritable();
    await stream.write(history.text);
    await stream.close();
  } catch {
    return say(`${handle.name} cannot be written.`, { label: "Save elsewhere", run: () => void saveFileAs() });
  }
  noteSaved(document, { fileName: handle.name, home: { kind: "handle", handle }, savedText: history.text });
  say(`Saved ${handle.name}.`);
}

// The browser gives a download another name if its name is taken.
function downloadModel(fileName: string): void {
  const { document, history } = studio.get();
  download(new Blob([history.text], { type: "application/toml" }), fileName.replace(/^.*\//, ""));
  noteSaved(document, { fileName, home: null, savedText: history.text });
}

export function download(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Files dropped anywhere on the page. */
export function listenToDrops(): () => void {
  const over = (event: DragEvent) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    document.body.classList.toggle("dropping", event.type === "dragover");
  };
  const drop = (event: DragEvent) => {
    const file = event.dataTransfer?.files[0];
    document.body.classList.remove("dropping");
    if (!file) return;
    event.preventDefault();
    void take(file);
  };
  window.addEventListener("dragover", over);
  window.addEventListener("dragleave", over);
  window.addEventListener("drop", drop);
  return () => {
    window.removeEventListener("dragover", over);
    window.removeEventListener("dragleave", over);
    window.removeEventListener("drop", drop);
  };
}

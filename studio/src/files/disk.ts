// Opening, saving and dropping of files. Where the browser can write a file in place, saving does; else it downloads.
import { openText, say } from "../actions";
import { readModel } from "../model/model";
import { kernel } from "../play/desk";
import { studio } from "../state";
import { inFolder, saveToFolder, showFolder } from "./folder";

interface WritableHandle {
  name: string;
  getFile(): Promise<File>;
  createWritable(): Promise<{ write(text: string): Promise<void>; close(): Promise<void> }>;
}
interface PickerWindow {
  showOpenFilePicker?: (options: object) => Promise<WritableHandle[]>;
  showSaveFilePicker?: (options: object) => Promise<WritableHandle>;
}

const TYPES = [{ description: "Pintle model", accept: { "text/plain": [".toml"], "application/json": [".json"] } }];
const LARGEST = 20e6;
let handle: WritableHandle | null = null;

const pickers = window as unknown as PickerWindow;

export async function openFile(): Promise<void> {
  return inFolder() ? showFolder() : pickFile();
}

/** A file of the visitor's computer. */
export async function pickFile(): Promise<void> {
  if (pickers.showOpenFilePicker) {
    const picked = await pickers.showOpenFilePicker({ types: TYPES }).catch(() => null);
    const first = picked?.[0];
    if (!first) return;
    handle = first;
    return take(await first.getFile(), true);
  }
  const input = document.createElement("input");
  input.type = "file";
  input.accept = ".toml,.json,text/plain";
  input.onchange = () => input.files?.[0] && void take(input.files[0]);
  input.click();
}

/** A file that was chosen or dropped; a broken one opens as text, with what is wrong with it. */
export async function take(file: File, keepHandle = false): Promise<void> {
  if (!keepHandle) handle = null;
  if (file.size > LARGEST) return say(`${file.name} has ${Math.round(file.size / 1e6)} MB: that is no model.`);
  const text = await file.text();
  if (text.includes("\u0000")) return say(`${file.name} is not a text.`);
  const toml = file.name.endsWith(".json") ? await fromJson(text) : text;
  openText(toml, file.name.replace(/\.json$/, ".toml"));
  if (readModel(toml).document.faults.length > 0) studio.set({ side: "text", dock: "problems" });
  say(`Opened ${file.name}. Undo leads back to the model before.`);
}

async function fromJson(text: string): Promise<string> {
  try {
    const answer = await kernel.write(JSON.parse(text));
    return answer.text ?? text;
  } catch {
    return text;
  }
}

export async function saveFile(): Promise<void> {
  if (inFolder()) return saveToFolder();
  const { history, fileName } = studio.get();
  try {
    if (pickers.showSaveFilePicker) {
      if (handle?.name !== fileName) handle = null;
      handle ??= await pickers.showSaveFilePicker({ suggestedName: fileName, types: TYPES });
      const stream = await handle.createWritable();
      await stream.write(history.text);
      await stream.close();
      studio.set({ fileName: handle.name, savedText: history.text });
      return say(`Saved ${handle.name}.`);
    }
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") return;
    handle = null;
  }
  download(new Blob([history.text], { type: "application/toml" }), fileName);
  studio.set({ savedText: history.text });
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

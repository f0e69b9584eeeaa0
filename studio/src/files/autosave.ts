// Nothing is lost: the text, its undo steps and the page's settings are kept in the browser after every change.
import { readModel } from "../model/model";
import { change, newHistory } from "../model/history";
import { studio } from "../state";

const KEY = "pintle-studio";
const SETTINGS = "pintle-studio-settings";

interface Kept {
  text: string;
  fileName: string;
  savedText: string;
  /** Texts before, the newest last; as many as there is room for. */
  before: string[];
}

const SETTING_KEYS = ["theme", "show", "dock", "side", "snapping", "loop"] as const;

function remember(storage: Storage | null): void {
  if (!storage) return;
  const { history, fileName, savedText } = studio.get();
  const before: string[] = [];
  let text = history.text;
  for (let i = history.past.length - 1, room = 400_000; i >= 0 && before.length < 100; i--) {
    const step = history.past[i]!;
    text = text.slice(0, step.at) + step.removed + text.slice(step.at + step.inserted.length);
    room -= text.length;
    if (room < 0) break;
    before.unshift(text);
  }
  const kept: Kept = { text: history.text, fileName, savedText, before };
  try {
    storage.setItem(KEY, JSON.stringify(kept));
  } catch {
    try {
      storage.setItem(KEY, JSON.stringify({ ...kept, before: [] }));
    } catch {
      // A full or forbidden store: the file can still be saved by hand.
    }
  }
}

function storageOf(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}

/** Brings back what was there before the page was closed. */
export function restore(): boolean {
  const storage = storageOf();
  restoreSettings(storage);
  const raw = storage?.getItem(KEY);
  if (!raw) return false;
  try {
    const kept = JSON.parse(raw) as Partial<Kept>;
    if (typeof kept.text !== "string") return false;
    const before = (kept.before ?? []).filter((one) => typeof one === "string");
    let history = newHistory(before[0] ?? kept.text);
    for (const text of [...before.slice(1), kept.text]) history = change(history, text, "Edit");
    const model = readModel(kept.text);
    studio.set({
      history,
      fileName: kept.fileName ?? "untitled.toml",
      savedText: kept.savedText ?? "",
      model,
      stale: model.document.faults.length > 0,
    });
    return true;
  } catch {
    return false;
  }
}

function restoreSettings(storage: Storage | null): void {
  const prefersDark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  studio.set({ theme: prefersDark ? "dark" : "light" });
  try {
    const kept = JSON.parse(storage?.getItem(SETTINGS) ?? "{}") as Record<string, unknown>;
    const known = Object.fromEntries(SETTING_KEYS.filter((key) => key in kept).map((key) => [key, kept[key]]));
    studio.set(known);
  } catch {
    // Settings of another version: the defaults are good.
  }
}

export function startAutosave(): void {
  const storage = storageOf();
  let timer: ReturnType<typeof setTimeout> | undefined;
  let text = studio.get().history;
  let settings = "";
  studio.subscribe(() => {
    const now = studio.get();
    if (now.history !== text) {
      text = now.history;
      clearTimeout(timer);
      timer = setTimeout(() => remember(storage), 150);
    }
    const mine = JSON.stringify(Object.fromEntries(SETTING_KEYS.map((key) => [key, now[key]])));
    if (mine === settings) return;
    settings = mine;
    try {
      storage?.setItem(SETTINGS, mine);
    } catch {
      // As above.
    }
  });
  window.addEventListener("pagehide", () => remember(storage));
}

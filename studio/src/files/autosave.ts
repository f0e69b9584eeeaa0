// Nothing is lost: the text, the previous texts (to which undo leads back, in fewer or coarser steps) and the page's settings are
// stored in the browser after every change.
import { newDocument, openText, openingKey, originBefore, say } from "../actions";
import { type History, change, newHistory, step } from "../model/history";
import { readModel } from "../model/model";
import { EMPTY_MODEL } from "../model/operations";
import { type Home, type Origin, studio } from "../state";
import { type Draft, type KeptDraft, claimDraft, listDrafts, readDraft, removeDraft, writeDraft } from "./drafts";

const SETTINGS = "pintle-studio-settings";
const SETTING_KEYS = ["theme", "show", "dock", "side", "snapping", "loop"] as const;

let storage: Storage | null = null;
let own = "";
let from: KeptDraft | null = null;
let written = false;
let refused = false;

function draftNow(closed: boolean): Draft {
  const { history, fileName, savedText, home, files } = studio.get();
  const before: string[] = [];
  const opened: Draft["opened"] = [];
  let text = history.text;
  for (let i = history.past.length - 1, room = 400_000; i >= 0 && before.length < 100; i--) {
    const step = history.past[i]!;
    text = text.slice(0, step.at) + step.removed + text.slice(step.at + step.inserted.length);
    const origin = originBefore(step.key);
    room -= text.length + (origin ? JSON.stringify(origin.files).length : 0);
    if (room < 0) break;
    before.unshift(text);
    if (origin) opened.unshift({ behind: before.length, fileName: origin.fileName, home: folderOnly(origin.home), files: origin.files });
  }
  return { text: history.text, fileName, savedText, home: folderOnly(home), files, before, opened, time: Date.now(), closed };
}

const folderOnly = (home: Home | null): Draft["home"] => (home?.kind === "folder" ? home : null);

// Steps that opened another text also lead back to its file.
function historyOf(draft: Draft): { history: History; origin: Origin } {
  const { before, text, opened, fileName, home, savedText, files } = draft;
  const origin: Origin = { document: newDocument(), fileName, home, savedText, files };
  const origins = [...opened.map((one): Origin => ({ document: newDocument(), fileName: one.fileName, home: one.home, savedText: "", files: one.files })), origin];
  let history = newHistory(before[0] ?? text);
  [...before.slice(1), text].forEach((next, i) => {
    const at = opened.findIndex((one) => one.behind === before.length - i);
    history = at < 0 ? change(history, next, "Edit") : step(history, next, `Open ${origins[at + 1]!.fileName}`, openingKey(origins[at]!, origins[at + 1]!));
  });
  return { history, origin };
}

function remember(closed = false): void {
  written = true;
  if (!storage || writeDraft(storage, own, draftNow(closed)) || refused) return;
  refused = true;
  say("The browser cannot store this page's data: storage is full or disabled. Save your work as a file.");
}

function storeOf(name: "localStorage" | "sessionStorage"): Storage | null {
  try {
    return window[name];
  } catch {
    return null;
  }
}

/** Restores the state from before the page was closed. */
export function restore(): boolean {
  storage = storeOf("localStorage");
  restoreSettings();
  if (!storage) return false;
  const { id, draft } = claimDraft(storage, storeOf("sessionStorage"));
  own = id;
  from = draft;
  if (!draft) return false;
  const { history, origin } = historyOf(draft);
  const model = readModel(draft.text);
  studio.set({ history, ...origin, model, stale: model.document.faults.length > 0 });
  return true;
}

/** Unsaved work of other tabs, whether closed, still open or crashed. */
export function otherDrafts(): KeptDraft[] {
  const { text } = studio.get().history;
  return storage ? listDrafts(storage).filter((one) => one.id !== own && one.text !== one.savedText && one.text !== EMPTY_MODEL && one.text !== text) : [];
}

/** Opens another tab's draft here. It becomes this tab's draft, unless the other tab is still open. */
export function openDraft(id: string): void {
  const draft = storage && readDraft(storage, id);
  if (!storage || !draft) return;
  openText(draft.text, draft.fileName, { home: draft.home, savedText: draft.savedText, files: draft.files });
  remember();
  if (draft.closed) removeDraft(storage, id);
}

export function forgetDraft(id: string): void {
  if (storage) removeDraft(storage, id);
}

function restoreSettings(): void {
  const prefersDark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  studio.set({ theme: prefersDark ? "dark" : "light" });
  try {
    const kept = JSON.parse(storage?.getItem(SETTINGS) ?? "{}") as Record<string, unknown>;
    const known = Object.fromEntries(SETTING_KEYS.filter((key) => key in kept).map((key) => [key, kept[key]]));
    studio.set(known);
  } catch {
    // Settings of another version are ignored: the defaults apply.
  }
}

export function startAutosave(): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let seen = studio.get();
  let settings = "";
  studio.subscribe(() => {
    const now = studio.get();
    if (now.history !== seen.history || now.savedText !== seen.savedText || now.home !== seen.home || now.files !== seen.files) {
      clearTimeout(timer);
      timer = setTimeout(() => remember(), 150);
    }
    seen = now;
    const mine = JSON.stringify(Object.fromEntries(SETTING_KEYS.map((key) => [key, now[key]])));
    if (mine === settings) return;
    settings = mine;
    try {
      storage?.setItem(SETTINGS, mine);
    } catch {
      // Losing the settings does no harm.
    }
  });
  if (from) remember();
  window.addEventListener("pagehide", () => {
    clearTimeout(timer);
    if (written || studio.get().history.past.length > 0) remember(true);
  });
  // A page restored from the browser's memory is open again.
  window.addEventListener("pageshow", (event) => (event as PageTransitionEvent).persisted && written && remember());
  void tellOfLost();
}

const LOCK = "pintle-studio:";

// A tab holds a lock while it is open: a draft that is neither closed nor locked belongs to a crashed tab.
async function tellOfLost(): Promise<void> {
  const locks = window.navigator?.locks;
  if (!locks || !storage) return;
  void locks.request(LOCK + own, () => new Promise(() => undefined));
  const held = new Set((await locks.query()).held?.map((one) => one.name));
  if (from && from.id !== own && !held.has(LOCK + from.id)) removeDraft(storage, from.id); // its work continues in this tab
  const lost = otherDrafts().filter((one) => !one.closed && !held.has(LOCK + one.id)).length;
  if (lost > 0) say(`Unsaved work of ${lost === 1 ? "a crashed tab" : `${lost} crashed tabs`} is available.`, { label: "Show it", run: () => studio.set({ dialog: "drafts" }) });
}

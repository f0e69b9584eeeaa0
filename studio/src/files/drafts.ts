// What the browser stores of each tab's work: one entry per tab, so that no tab overwrites another's.
import type { NamedFiles } from "../kernel/named-files";
import { readModel } from "../model/model";
import type { Home } from "../state";

export interface Draft {
  text: string;
  fileName: string;
  savedText: string;
  /** The file in the folder of `pintle studio` to which it is saved; file handles cannot be stored. */
  home: Extract<Home, { kind: "folder" }> | null;
  /** Files that the text names. */
  files: NamedFiles;
  /** Previous texts, newest last; as many as there is room for. */
  before: string[];
  /** Previous texts that came from elsewhere; `behind`: place in `before`, counted from the newest, of the text that a step replaced by another. */
  opened: { behind: number; fileName: string; home: Draft["home"]; files: NamedFiles }[];
  /** Time of writing [ms]. */
  time: number;
  /** The tab has been closed. */
  closed: boolean;
}

export interface KeptDraft extends Draft {
  id: string;
}

const PREFIX = "pintle-studio:draft:";
/** Former location of the single draft of all tabs. */
const BEFORE_TABS = "pintle-studio";
const TAB = "pintle-studio:tab";
/** Number of drafts kept; beyond it, the oldest of the closed ones are removed. */
const MOST = 12;

export function readDraft(storage: Storage, id: string): KeptDraft | null {
  try {
    const kept = JSON.parse(storage.getItem(PREFIX + id) ?? "null") as Partial<Draft> | null;
    if (typeof kept?.text !== "string") return null;
    const before = (kept.before ?? []).filter((one) => typeof one === "string");
    return { id, text: kept.text, fileName: kept.fileName ?? "untitled.toml", savedText: kept.savedText ?? "", home: kept.home ?? null, files: kept.files ?? {}, before, opened: (kept.opened ?? []).map((one) => ({ ...one, files: one.files ?? {} })), time: kept.time ?? 0, closed: kept.closed ?? true };
  } catch {
    return null;
  }
}

const keysOf = (storage: Storage) => Array.from({ length: storage.length }, (_, i) => storage.key(i) ?? "").filter((key) => key.startsWith(PREFIX));

/** Newest first. */
export function listDrafts(storage: Storage): KeptDraft[] {
  const drafts = keysOf(storage).map((key) => readDraft(storage, key.slice(PREFIX.length))).filter((one) => one !== null);
  return drafts.sort((a, b) => b.time - a.time);
}

/** False if the browser refuses because its storage is full or forbidden. */
export function writeDraft(storage: Storage, id: string, draft: Draft): boolean {
  const attempts = [() => undefined, () => (draft = { ...draft, before: [], opened: [] }), () => (draft = { ...draft, files: {} }), () => dropOldest(storage, id)];
  for (const prepare of attempts) {
    prepare();
    try {
      storage.setItem(PREFIX + id, JSON.stringify(draft));
      if (keysOf(storage).length > MOST) dropOldest(storage, id);
      return true;
    } catch {
      // The next attempt needs less space.
    }
  }
  return false;
}

export function removeDraft(storage: Storage, id: string): void {
  storage.removeItem(PREFIX + id);
}

// First those whose text is also in a file.
function dropOldest(storage: Storage, own: string): void {
  const left = listDrafts(storage).filter((one) => one.closed && one.id !== own);
  const gone = left.reverse().find((one) => one.text === one.savedText) ?? left[0];
  if (gone) removeDraft(storage, gone.id);
}

const freshId = () => Math.random().toString(36).slice(2, 10);

/** This tab's name in the storage, and the draft that it continues. */
export function claimDraft(storage: Storage, tab: Storage | null): { id: string; draft: KeptDraft | null } {
  moveOldDraft(storage);
  const mine = tab?.getItem(TAB);
  const own = mine ? readDraft(storage, mine) : null;
  // A duplicated tab has the name of the original, which is still open. A new tab continues where the last one was closed.
  const draft = own ?? (mine ? null : (listDrafts(storage).find((one) => one.closed) ?? null));
  const id = draft && draft.closed ? draft.id : mine && !own ? mine : freshId();
  try {
    tab?.setItem(TAB, id);
  } catch {
    // The draft is stored anyway, and can be found among the closed ones.
  }
  return { id, draft };
}

function moveOldDraft(storage: Storage): void {
  const old = storage.getItem(BEFORE_TABS);
  if (old === null) return;
  storage.removeItem(BEFORE_TABS);
  storage.setItem(`${PREFIX}old`, old);
}

/** "Four-bar, four_bar.toml" */
export function draftName({ text, fileName }: Draft): string {
  const { name } = readModel(text);
  return name ? `${name}, ${fileName}` : fileName;
}

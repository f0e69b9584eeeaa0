// What a user can do to the whole: edit, undo, select, open. Every change of the text goes through `edit`.
import { type Complaint, type Fault } from "./kernel/protocol";
import { type History, change, redo as redoStep, undo as undoStep } from "./model/history";
import { type Model, type Poses, readModel } from "./model/model";
import { EMPTY_MODEL, type Made, type Thing } from "./model/operations";
import { copyThings, pasteThings, removeThings } from "./model/removal";
import { type Document, lineColumn } from "./model/toml";
import { NO_RUN, type StudioState, type ToolName, studio } from "./state";

/** Faults of the text's form, found at once; the kernel finds the rest. */
export function localComplaints(document: Document): Complaint[] {
  return document.faults.map((fault) => ({
    severity: "error",
    ...lineColumn(document.text, fault.from),
    length: Math.max(1, fault.to - fault.from),
    key: "",
    message: fault.message,
    hint: "",
  }));
}

function follow(text: string): Partial<StudioState> {
  const read = readModel(text);
  const faulty = read.document.faults.length > 0;
  const before = studio.get();
  if (faulty) return { stale: true, run: { ...before.run, status: "none", progress: null }, complaints: localComplaints(read.document) };
  // The run is of the text before, until there is another.
  const run = { ...before.run, status: read.bodies.length > 0 && before.kernelState !== "missing" ? ("running" as const) : ("none" as const), progress: null, fault: null };
  return { model: read, stale: false, run, poses: followPoses(before.model, read, before.poses), selection: before.selection.filter((thing) => exists(read, thing)) };
}

// Assembled poses stay until the kernel has new ones, but for bodies that the text has moved.
function followPoses(before: Model, after: Model, poses: Poses | null): Poses | null {
  if (!poses) return null;
  const kept = new Map(poses);
  for (const body of after.bodies) {
    const old = before.body.get(body.name)?.pose;
    if (body.stated && (!old || old.x !== body.pose.x || old.y !== body.pose.y || old.angle !== body.pose.angle)) kept.set(body.name, body.pose);
  }
  return kept;
}

export function exists(model: Model, { kind, name }: Thing): boolean {
  switch (kind) {
    case "body":
      return model.body.has(name);
    case "joint":
      return model.joints.some((one) => one.name === name);
    case "spring":
    case "torsion_spring":
      return model.springs.some((one) => one.name === name && one.torsion === (kind === "torsion_spring"));
    case "force":
      return model.loads.some((one) => one.name === name);
    case "motor":
      return model.motors.some((one) => one.name === name);
    case "marker": {
      const [body = "", marker = ""] = name.split(".");
      return (body === "ground" ? model.ground : (model.body.get(body)?.markers ?? [])).some((one) => one.name === marker);
    }
    case "ground":
      return true;
  }
}

export function edit(text: string, label: string, key = ""): void {
  const history = change(studio.get().history, text, label, key);
  if (history !== studio.get().history) studio.set({ history, ...follow(text) });
}

/** A drawing step: the text, and what it made becomes the selection. */
export function drawn(made: Made, label: string): void {
  edit(made.text, label);
  if (made.made.length > 0) studio.set({ selection: made.made });
}

export function undo(): void {
  const { history } = studio.get();
  goTo(undoStep(history), history.past[history.past.length - 1]?.key ?? "", 0);
}

export function redo(): void {
  const { history } = studio.get();
  goTo(redoStep(history), history.future[0]?.key ?? "", 1);
}

// A step that opened another file has both names in its key: the text and its name go together.
function goTo(history: History, key: string, side: 0 | 1): void {
  if (history === studio.get().history) return;
  const names = key.startsWith(OPENED) ? key.slice(OPENED.length).split("\u0000") : null;
  studio.set({ history, ...(names ? { ...NOTHING_OPEN, fileName: names[side] ?? "" } : {}), ...follow(history.text) });
  if (names) for (const listener of openedListeners) listener();
}

const OPENED = "open:";

export function select(things: Thing[]): void {
  studio.set({ selection: things });
}

export function chooseTool(tool: ToolName): void {
  studio.set(tool === "select" ? { tool } : { tool, mode: "edit", playing: false });
}

/** What belongs to one model only. */
const NOTHING_OPEN: Partial<StudioState> = { poses: null, obstacle: null, report: null, selection: [], kept: null, mode: "edit", playing: false, plotted: null, tool: "select" };

/** Another model in place of this one, which undo brings back. */
export function openText(text: string, fileName: string): void {
  const read = readModel(text);
  const faulty = read.document.faults.length > 0;
  const before = studio.get();
  studio.set({
    ...NOTHING_OPEN,
    history: change(before.history, text, `Open ${fileName}`, `${OPENED}${before.fileName}\u0000${fileName}`),
    fileName,
    model: faulty && read.bodies.length === 0 ? readModel(EMPTY_MODEL) : read,
    stale: faulty,
    complaints: localComplaints(read.document),
    run: { ...NO_RUN, serial: before.run.serial + 1 },
    ghost: { ...before.ghost, answer: null },
    savedText: text,
  });
  for (const listener of openedListeners) listener();
}

const openedListeners = new Set<() => void>();

/** Told when another model has been opened: the view fits it. */
export function onOpened(listener: () => void): () => void {
  openedListeners.add(listener);
  return () => openedListeners.delete(listener);
}

export function removeSelection(): void {
  const { model, selection } = studio.get();
  if (selection.length > 0) edit(removeThings(model, selection), selection.length === 1 ? `Delete ${selection[0]!.name}` : `Delete ${selection.length} things`);
}

let clipboard = "";

export function copySelection(): string {
  const { model, selection, poses } = studio.get();
  if (!selection.some((thing) => thing.kind === "body")) {
    say("Select a link to copy it.");
    return "";
  }
  clipboard = copyThings(model, selection, poses ?? undefined);
  void navigator.clipboard?.writeText(clipboard).catch(() => undefined);
  return clipboard;
}

export function paste(copied = clipboard): void {
  if (!copied.includes("[body.")) return say("There is nothing to paste: copy a link first.");
  const { model } = studio.get();
  const step = model.bodies.length > 0 ? 0.15 * Math.max(0.05, ...model.bodies.flatMap((body) => body.markers.map((m) => Math.hypot(...m.at)))) * 2 : 0;
  drawn(pasteThings(model, copied, [step, -step]), "Paste");
}

export function selectAll(): void {
  select(studio.get().model.bodies.map((body) => ({ kind: "body", name: body.name })));
}

let nextToast = 1;

export function say(text: string, action?: { label: string; run: () => void }): void {
  const id = nextToast++;
  studio.set((now) => ({ toasts: [...now.toasts.slice(-2), { id, text, action }] }));
  setTimeout(() => dismiss(id), action ? 9000 : 5000);
}

export function dismiss(id: number): void {
  studio.set((now) => ({ toasts: now.toasts.filter((toast) => toast.id !== id) }));
}

export function asFault(error: unknown): Fault {
  if (error && typeof error === "object" && "fault" in error) return (error as { fault: Fault }).fault;
  return { message: error instanceof Error ? error.message : String(error), hint: "" };
}

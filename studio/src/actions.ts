// User actions on the whole page: edit, undo, select, open. Every change of the text goes through `edit`.
import type { NamedFiles } from "./kernel/named-files";
import { type Complaint, type Fault } from "./kernel/protocol";
import { type History, change, redo as redoStep, step, undo as undoStep } from "./model/history";
import { type Model, type Poses, readModel } from "./model/model";
import { EMPTY_MODEL, type Made, type Thing, addMesh, meshFault } from "./model/operations";
import { overwritten } from "./model/placing";
import { removeThings } from "./model/removal";
import { type Document, lineColumn } from "./model/toml";
import { type Home, NO_RUN, type Origin, type StudioState, type ToolName, studio } from "./state";

/** Faults in the form of the text, found at once; the kernel finds the rest. */
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
  // The run belongs to the previous text until there is a new one.
  const run = { ...before.run, status: read.bodies.length > 0 && before.kernelState !== "missing" ? ("running" as const) : ("none" as const), progress: null, fault: null };
  return { model: read, stale: false, run, poses: followPoses(before.model, read, before.poses), selection: before.selection.filter((thing) => exists(read, thing)) };
}

// Assembled poses are kept until the kernel has new ones, except for bodies that the text has moved.
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

/** A step made from the current text: typing in the editor, or replacing a word. */
export function editText(text: string, label: string, key = ""): void {
  const history = change(studio.get().history, text, label, key);
  if (history !== studio.get().history) studio.set({ history, ...follow(text) });
}

/** A step made from the model. While the text cannot be read, the model is an older one and the step would discard what was typed. */
export function edit(text: string, label: string, key = ""): boolean {
  const { stale, complaints, toasts } = studio.get();
  if (!stale) {
    editText(text, label, key);
    return true;
  }
  const first = complaints.find((one) => one.line > 0);
  const refusal = `Fix the text first${first ? `, line ${first.line}: ${first.message}` : ""}.`;
  if (!toasts.some((toast) => toast.text === refusal)) say(refusal, { label: "Show the text", run: () => studio.set({ side: "text", dock: "problems" }) });
  return false;
}

/** A step that writes positions. If it would replace expressions with parameters, it asks first. */
export function place(text: string, label: string, key = ""): void {
  const { model, history } = studio.get();
  const gone = overwritten(model, text);
  if (gone.length === 0 || studio.get().stale) return void edit(text, label, key);
  const run = () => (studio.get().history.text === history.text ? void edit(text, label) : say("The model has changed in the meantime: nothing was written."));
  say(`${gone.slice(0, 2).join(", ")}${gone.length > 2 ? ", …" : ""}: defined by parameters. Replace them with numbers?`, { label: "Replace", run });
}

/** A drawing step: the text changes, and the new things become the selection. */
export function drawn(made: Made, label: string): void {
  if (edit(made.text, label) && made.made.length > 0) studio.set({ selection: made.made });
}

export function undo(): void {
  const { history } = studio.get();
  goTo(undoStep(history), history.past[history.past.length - 1]?.key ?? "", 0);
}

export function redo(): void {
  const { history } = studio.get();
  goTo(redoStep(history), history.future[0]?.key ?? "", 1);
}

// A step that opened another text also changes the origin; the origin being left may have been saved since.
function goTo(history: History, key: string, side: 0 | 1): void {
  if (history === studio.get().history) return;
  const origins = opened.get(key);
  if (origins) origins[1 - side] = originNow();
  studio.set({ history, ...(origins ? { ...NOTHING_OPEN, ...origins[side] } : {}), ...follow(history.text) });
  if (origins) for (const listener of openedListeners) listener();
}

/** Origins before and after a step that opened another text, by the step's key. */
const opened = new Map<string, [Origin, Origin]>();
let lastDocument = 0;

export const newDocument = (): number => ++lastDocument;

/** The key of a step that replaces one text by another. */
export function openingKey(before: Origin, after: Origin): string {
  const key = `open${opened.size + 1}`;
  opened.set(key, [before, after]);
  return key;
}

/** The last step opened the text: it has not been edited since. */
export function isJustOpened({ past }: History): boolean {
  const last = past[past.length - 1];
  return last === undefined || opened.has(last.key);
}

/** The origin of the text before a step, if the step opened another text. */
export const originBefore = (key: string): Origin | undefined => opened.get(key)?.[0];

function originNow(): Origin {
  const { document, fileName, home, savedText, files } = studio.get();
  return { document, fileName, home, savedText, files };
}

/** Records that a text has been saved; another one may be open by now. */
export function noteSaved(document: number, change: Omit<Origin, "document" | "files">): void {
  for (const origins of opened.values()) for (const origin of origins) if (origin.document === document) Object.assign(origin, change);
  if (studio.get().document === document) studio.set(change);
}

export function select(things: Thing[]): void {
  studio.set({ selection: things });
}

export function chooseTool(tool: ToolName): void {
  studio.set(tool === "select" ? { tool } : { tool, mode: "edit", playing: false });
}

/** State that belongs to a single model. */
const NOTHING_OPEN: Partial<StudioState> = { poses: null, obstacle: null, report: null, selection: [], kept: null, mode: "edit", playing: false, plotted: null, tool: "select" };

function isSameFile(a: Origin, b: Origin): boolean {
  const identity = ({ fileName, home, files }: Origin) => JSON.stringify([fileName, home?.kind === "folder" ? [home.folder, home.path] : home?.kind, files]);
  return identity(a) === identity(b);
}

/** Opens another model instead of this one; undo brings this one back. Without a home it is a new file: saving asks for its name. */
export function openText(text: string, fileName: string, { home = null, savedText = text, files = {} }: { home?: Home | null; savedText?: string; files?: NamedFiles } = {}): void {
  const read = readModel(text);
  const faulty = read.document.faults.length > 0;
  const before = studio.get();
  const origin: Origin = { document: newDocument(), fileName, home, savedText, files };
  const history = text === before.history.text && isSameFile(before, origin) ? before.history : step(before.history, text, `Open ${fileName}`, openingKey(originNow(), origin));
  studio.set({
    ...NOTHING_OPEN,
    ...origin,
    history,
    model: faulty && read.bodies.length === 0 ? readModel(EMPTY_MODEL) : read,
    stale: faulty,
    complaints: localComplaints(read.document),
    run: { ...NO_RUN, serial: before.run.serial + 1 },
    ghost: { ...before.ghost, answer: null },
  });
  for (const listener of openedListeners) listener();
}

/** A faulty file opens as text, with its complaints. */
export function showFaults(): void {
  if (studio.get().stale) studio.set({ side: "text", dock: "problems" });
}

const openedListeners = new Set<() => void>();

/** Calls the listener when another model has been opened, so that the view can fit it. */
export function onOpened(listener: () => void): () => void {
  openedListeners.add(listener);
  return () => openedListeners.delete(listener);
}

export function removeSelection(): void {
  const { model, selection } = studio.get();
  if (selection.length > 0) edit(removeThings(model, selection), selection.length === 1 ? `Delete ${selection[0]!.name}` : `Delete ${selection.length} things`);
}

export function meshSelection(): void {
  const { model, selection, poses } = studio.get();
  const [a, b, more] = selection.map((thing) => (thing.kind === "body" ? model.body.get(thing.name) : undefined));
  if (!a || !b || more) return say("Select two gears to mesh them.");
  const fault = meshFault(model, a, b, poses ?? undefined);
  if (fault) return say(fault);
  drawn(addMesh(model, a, b, poses ?? undefined), "Mesh");
}

export function selectAll(): void {
  select(studio.get().model.bodies.map((body) => ({ kind: "body", name: body.name })));
}

let nextToast = 1;

export function say(text: string, action?: { label: string; run: () => void }): void {
  const id = nextToast++;
  studio.set((now) => ({ toasts: [...now.toasts.filter((toast) => toast.text !== text).slice(-2), { id, text, action }] }));
  setTimeout(() => dismiss(id), action ? 9000 : 5000);
}

export function dismiss(id: number): void {
  studio.set((now) => ({ toasts: now.toasts.filter((toast) => toast.id !== id) }));
}

export function asFault(error: unknown): Fault {
  if (error && typeof error === "object" && "fault" in error) return (error as { fault: Fault }).fault;
  return { message: error instanceof Error ? error.message : String(error), hint: "" };
}

/** Says what went wrong, and what to try. */
export function sayFault(error: unknown): void {
  const { message, hint } = asFault(error);
  say(hint ? `${message} ${hint}` : message);
}

// The whole state of the page, in one place. The text is the model; everything else about the mechanism follows from it.
import type { CheckReport, Complaint, Fault, RunAnswer, RunProgress } from "./kernel/protocol";
import type { NamedFiles } from "./kernel/named-files";
import { type History, newHistory } from "./model/history";
import { type Model, type Poses, readModel } from "./model/model";
import { EMPTY_MODEL, type Thing } from "./model/operations";
import { createStore, useStore } from "./store";

export const TOOLS = [
  "select", "link", "plate", "pin", "ground", "slider", "slot", "weld", "disc", "spring", "damper", "torsion", "rod", "rope", "motor", "force", "torque", "trace",
] as const;
export type ToolName = (typeof TOOLS)[number];

export type Dialog = "gallery" | "palette" | "help" | "folder" | "save" | "drafts" | null;
export type DockTab = "plots" | "forces" | "energy" | "problems";
export type SideTab = "properties" | "model" | "text";

export interface RunState {
  status: "none" | "running" | "done" | "failed";
  answer: RunAnswer | null;
  progress: RunProgress | null;
  fault: Fault | null;
  /** Counts answers, so that code that draws one can detect a new one. */
  serial: number;
}

/** The answer belongs to an older text than the present one. A run that stopped early has one of its own. */
export function isOutdated({ status, answer }: RunState): boolean {
  return answer !== null && status !== "done" && !(status === "failed" && answer.outcome === "failed");
}

export interface Toast {
  id: number;
  text: string;
  action?: { label: string; run: () => void };
}

export interface WritableHandle {
  name: string;
  getFile(): Promise<File>;
  createWritable(): Promise<{ write(text: string): Promise<void>; close(): Promise<void> }>;
}

/** The file to which the text is saved without asking: one on this computer, or one in the folder of `pintle studio`. */
export type Home =
  | { kind: "handle"; handle: WritableHandle }
  /** `hash` is that of the file's content when it was last read or written. */
  | { kind: "folder"; folder: string; path: string; hash: string };

/** Belongs to an opened text, and is restored with it when a step leads back to it. */
export interface Origin {
  /** A different number for each opened text. */
  document: number;
  fileName: string;
  home: Home | null;
  savedText: string;
  /** Files that the text names: columns of tables. */
  files: NamedFiles;
}

export interface StudioState extends Origin {
  history: History;
  model: Model;
  /** The text has faults; the drawing shows the last readable model. */
  stale: boolean;
  /** Assembled poses at the start, for the bodies of the text. */
  poses: Poses | null;
  complaints: Complaint[];
  /** Why the model could not be assembled or run. */
  obstacle: Fault | null;
  report: CheckReport | null;
  kernelState: "starting" | "ready" | "missing";
  selection: Thing[];
  hover: Thing | null;
  tool: ToolName;
  run: RunState;
  ghost: { on: boolean; answer: RunAnswer | null };
  kept: { answer: RunAnswer; label: string } | null;
  mode: "edit" | "replay" | "live";
  playing: boolean;
  speed: number;
  loop: boolean;
  dialog: Dialog;
  dock: DockTab | null;
  side: SideTab | null;
  theme: "light" | "dark";
  show: { labels: boolean; forces: boolean; grid: boolean; traces: boolean; centres: boolean };
  snapping: boolean;
  /** Names of plotted columns; null until the user chooses some. */
  plotted: string[] | null;
  toasts: Toast[];
  /** The folder of `pintle studio`, if it serves the page. */
  folder: { name: string; models: { path: string; size: number }[] } | null;
}

const model = readModel(EMPTY_MODEL);

export const NO_RUN: RunState = { status: "none", answer: null, progress: null, fault: null, serial: 0 };

export const studio = createStore<StudioState>({
  history: newHistory(EMPTY_MODEL),
  document: 0,
  fileName: "untitled.toml",
  home: null,
  model,
  stale: false,
  poses: null,
  complaints: [],
  obstacle: null,
  report: null,
  kernelState: "starting",
  selection: [],
  hover: null,
  tool: "select",
  run: NO_RUN,
  ghost: { on: false, answer: null },
  kept: null,
  mode: "edit",
  playing: false,
  speed: 1,
  loop: true,
  dialog: null,
  dock: "plots",
  side: "properties",
  theme: "light",
  show: { labels: true, forces: true, grid: true, traces: true, centres: false },
  snapping: true,
  plotted: null,
  toasts: [],
  savedText: EMPTY_MODEL,
  files: {},
  folder: null,
});

export function useStudio<P>(part: (now: StudioState) => P): P {
  return useStore(studio, part);
}

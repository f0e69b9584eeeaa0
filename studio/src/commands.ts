// All commands with their names and keys: the palette, the shortcuts and the help sheet are generated from this.
import { chooseTool, meshSelection, openText, place, redo, removeSelection, say, select, selectAll, undo } from "./actions";
import { copySelection, duplicate, paste } from "./clipboard";
import { isTyping, ownsKey } from "./controls";
import { theView } from "./drawing/canvas";
import { TOOL_LIST } from "./drawing/tools";
import { openFile, saveFile, saveFileAs } from "./files/disk";
import { shareLink } from "./files/share";
import { EMPTY_MODEL } from "./model/operations";
import { shiftThings } from "./model/reshape";
import { Strokes } from "./model/strokes";
import { setGhost } from "./play/kernel-session";
import { player } from "./play/player";
import { type DockTab, type SideTab, studio } from "./state";

export interface Command {
  id: string;
  label: string;
  /** "mod" is Ctrl, or ⌘ on a Mac. */
  keys: string[];
  group: "File" | "Edit" | "Draw" | "Play" | "View" | "Help";
  run: () => void;
}

const toggleShow = (key: "labels" | "forces" | "grid" | "traces" | "centres") => () =>
  studio.set((now) => ({ show: { ...now.show, [key]: !now.show[key] } }));
const dock = (tab: DockTab) => () => studio.set((now) => ({ dock: now.dock === tab ? null : tab }));
const side = (tab: SideTab) => () => studio.set((now) => ({ side: now.side === tab ? null : tab }));
const exporting = (word: "csv" | "svg" | "gif" | "report") => () => void import("./files/exports").then((module) => module.exportAs(word));

const nudges = new Strokes("nudge");
let nudged: unknown = null;

function nudge(x: number, y: number): void {
  const { selection, model, poses, mode } = studio.get();
  const view = theView();
  const bodies = selection.filter((one) => one.kind === "body").map((one) => one.name);
  const markers = selection.flatMap((one) => {
    if (one.kind === "marker" && one.name.startsWith("ground.")) return [one.name.slice(7)];
    const joint = one.kind === "joint" ? model.joints.find((j) => j.name === one.name) : undefined;
    return joint?.first.body === "ground" ? [joint.first.marker] : [];
  });
  if (!view || mode !== "edit" || bodies.length + markers.length === 0) return;
  const step = view.metres(4);
  const nice = 10 ** Math.round(Math.log10(step));
  place(shiftThings(model, bodies, markers, [x * nice, y * nice], poses ?? undefined), "Nudge", nudges.key(performance.now(), selection === nudged));
  nudged = studio.get().selection;
}

export const COMMANDS: readonly Command[] = [
  { id: "new", label: "New drawing", keys: ["alt+N"], group: "File", run: () => openText(EMPTY_MODEL, "untitled.toml") },
  { id: "gallery", label: "Templates", keys: ["mod+shift+O"], group: "File", run: () => studio.set({ dialog: "gallery" }) },
  { id: "open", label: "Open a file", keys: ["mod+O"], group: "File", run: () => void openFile() },
  { id: "drafts", label: "Unsaved work of other tabs", keys: [], group: "File", run: () => studio.set({ dialog: "drafts" }) },
  { id: "save", label: "Save the model as a file", keys: ["mod+S"], group: "File", run: () => void saveFile() },
  { id: "save-as", label: "Save as", keys: ["mod+shift+S"], group: "File", run: () => void saveFileAs() },
  { id: "share", label: "Copy a link with the model in it", keys: ["mod+shift+L"], group: "File", run: () => void shareLink() },
  { id: "export-csv", label: "Export the run as CSV", keys: [], group: "File", run: exporting("csv") },
  { id: "export-svg", label: "Export the drawing as SVG", keys: [], group: "File", run: exporting("svg") },
  { id: "export-gif", label: "Export the motion as GIF", keys: [], group: "File", run: exporting("gif") },
  { id: "export-report", label: "Export a report", keys: [], group: "File", run: exporting("report") },
  { id: "undo", label: "Undo", keys: ["mod+Z"], group: "Edit", run: undo },
  { id: "redo", label: "Redo", keys: ["mod+shift+Z", "mod+Y"], group: "Edit", run: redo },
  { id: "copy", label: "Copy the selected links", keys: ["mod+C"], group: "Edit", run: () => void copySelection() },
  { id: "paste", label: "Paste", keys: ["mod+V"], group: "Edit", run: () => void paste() },
  { id: "duplicate", label: "Duplicate", keys: ["mod+D"], group: "Edit", run: duplicate },
  { id: "delete", label: "Delete the selection", keys: ["Delete", "Backspace"], group: "Edit", run: removeSelection },
  { id: "all", label: "Select all links", keys: ["mod+A"], group: "Edit", run: selectAll },
  { id: "left", label: "Nudge left", keys: ["ArrowLeft"], group: "Edit", run: () => arrow(-1, 0) },
  { id: "right", label: "Nudge right", keys: ["ArrowRight"], group: "Edit", run: () => arrow(1, 0) },
  { id: "up", label: "Nudge up", keys: ["ArrowUp"], group: "Edit", run: () => nudge(0, 1) },
  { id: "down", label: "Nudge down", keys: ["ArrowDown"], group: "Edit", run: () => nudge(0, -1) },
  { id: "next", label: "Select the next item", keys: ["]"], group: "Edit", run: () => cycle(1) },
  { id: "previous", label: "Select the previous item", keys: ["["], group: "Edit", run: () => cycle(-1) },
  ...TOOL_LIST.map((tool): Command => ({ id: `tool-${tool.name}`, label: tool.name === "select" ? "Select and move" : `Draw: ${tool.label}`, keys: [tool.key], group: "Draw", run: () => chooseTool(tool.name) })),
  { id: "mesh", label: "Mesh the two selected gears", keys: [], group: "Draw", run: meshSelection },
  { id: "snap", label: "Snap to the grid", keys: ["N"], group: "Draw", run: () => studio.set((now) => ({ snapping: !now.snapping })) },
  { id: "play", label: "Play or pause", keys: ["Space"], group: "Play", run: () => player.toggle() },
  { id: "stop", label: "Stop and return to drawing", keys: ["Escape"], group: "Play", run: escape },
  { id: "live", label: "Live motion: runs on, links can be dragged", keys: ["shift+Space"], group: "Play", run: () => void player.goLive() },
  { id: "step-on", label: "One frame forward", keys: ["."], group: "Play", run: () => player.step(1) },
  { id: "step-back", label: "One frame back", keys: [","], group: "Play", run: () => player.step(-1) },
  { id: "slower", label: "Slower", keys: ["-"], group: "Play", run: () => faster(0.5) },
  { id: "faster", label: "Faster", keys: ["+", "="], group: "Play", run: () => faster(2) },
  { id: "ghost", label: "Overlay the motion with ideal joints", keys: ["H"], group: "Play", run: () => setGhost(!studio.get().ghost.on) },
  { id: "keep", label: "Pin this run for comparison", keys: ["B"], group: "Play", run: keepRun },
  { id: "fit", label: "Fit the drawing to the window", keys: ["0"], group: "View", run: () => theView()?.fit() },
  { id: "zoom-in", label: "Zoom in", keys: ["mod+="], group: "View", run: () => theView()?.zoom(1.25) },
  { id: "zoom-out", label: "Zoom out", keys: ["mod+-"], group: "View", run: () => theView()?.zoom(0.8) },
  { id: "plots", label: "Plots", keys: ["1"], group: "View", run: dock("plots") },
  { id: "forces", label: "Peak forces", keys: ["2"], group: "View", run: dock("forces") },
  { id: "energy", label: "Energy account", keys: ["3"], group: "View", run: dock("energy") },
  { id: "problems", label: "Problems", keys: ["4"], group: "View", run: dock("problems") },
  { id: "properties", label: "Properties", keys: ["5"], group: "View", run: side("properties") },
  { id: "model", label: "Model and simulation", keys: ["6"], group: "View", run: side("model") },
  { id: "text", label: "Text of the model", keys: ["7"], group: "View", run: side("text") },
  { id: "show-labels", label: "Names of joints on the drawing", keys: ["shift+N"], group: "View", run: toggleShow("labels") },
  { id: "show-forces", label: "Joint-force arrows", keys: ["shift+F"], group: "View", run: toggleShow("forces") },
  { id: "show-grid", label: "Grid", keys: ["shift+G"], group: "View", run: toggleShow("grid") },
  { id: "show-traces", label: "Traced curves", keys: ["shift+T"], group: "View", run: toggleShow("traces") },
  { id: "show-centres", label: "Centres of mass", keys: ["shift+C"], group: "View", run: toggleShow("centres") },
  { id: "theme", label: "Dark or light", keys: ["shift+D"], group: "View", run: () => studio.set((now) => ({ theme: now.theme === "dark" ? "light" : "dark" })) },
  { id: "palette", label: "Find a command", keys: ["mod+K"], group: "Help", run: () => studio.set({ dialog: "palette" }) },
  { id: "help", label: "Help and keys", keys: ["?"], group: "Help", run: () => studio.set({ dialog: "help" }) },
];

export function runCommand(id: string): void {
  COMMANDS.find((command) => command.id === id)?.run();
}

function arrow(x: number, y: number): void {
  if (studio.get().mode === "edit") nudge(x, y);
  else player.step(x * 5);
}

function faster(factor: number): void {
  studio.set((now) => ({ speed: Math.min(Math.max(now.speed * factor, 1 / 1024), 8) }));
}

function keepRun(): void {
  const { run, kept, model } = studio.get();
  if (kept) return studio.set({ kept: null });
  if (!run.answer) return say("There is no run to pin yet.");
  studio.set({ kept: { answer: run.answer, label: model.name || "pinned run" } });
  say("This run is pinned and shown dashed in the plots. Change something and compare.");
}

function escape(): void {
  const now = studio.get();
  if (now.mode !== "edit" || player.opening) return player.stop();
  if (now.tool !== "select") return chooseTool("select");
  select([]);
}

// Cycles through all things in the order of the text, so that each can be reached from the keyboard.
function cycle(direction: number): void {
  const { model, selection } = studio.get();
  const all = [
    ...model.bodies.map((one) => ({ kind: "body" as const, name: one.name })),
    ...model.joints.map((one) => ({ kind: "joint" as const, name: one.name })),
    ...model.springs.map((one) => ({ kind: one.torsion ? ("torsion_spring" as const) : ("spring" as const), name: one.name })),
    ...model.loads.map((one) => ({ kind: "force" as const, name: one.name })),
    ...model.motors.map((one) => ({ kind: "motor" as const, name: one.name })),
  ];
  if (all.length === 0) return;
  const here = all.findIndex((one) => one.kind === selection[0]?.kind && one.name === selection[0]?.name);
  const next = all[(here + direction + all.length + (here < 0 && direction < 0 ? 1 : 0)) % all.length]!;
  studio.set({ selection: [next], side: "properties" });
}

/** The key chord of an event, such as "mod+shift+Z", as the commands write it. */
export function chordOf(event: KeyboardEvent): string {
  const parts: string[] = [];
  if (event.ctrlKey || event.metaKey) parts.push("mod");
  if (event.altKey) parts.push("alt");
  const key = event.key === " " ? "Space" : event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const letter = /^[A-Z]$/.test(key) || key === "Space";
  if (event.shiftKey && letter) parts.push("shift");
  return [...parts, key].join("+");
}

const byChord = new Map(COMMANDS.flatMap((command) => command.keys.map((chord) => [chord.length === 1 ? chord.toUpperCase() : chord, command] as const)));

export function listenToKeys(): () => void {
  const listen = (event: KeyboardEvent) => {
    if (event.defaultPrevented) return;
    const chord = chordOf(event);
    const command = byChord.get(chord);
    if (!command) return;
    const { dialog } = studio.get();
    if (dialog && command.id !== "palette") return;
    if (isTyping(event.target) && !/^(save|save-as|open|palette|share)$/.test(command.id)) return;
    if (ownsKey(event.target, event.key)) return;
    if (/^mod\+[CVA]$/.test(chord) && (window.getSelection()?.toString() ?? "") !== "") return;
    event.preventDefault();
    command.run();
  };
  window.addEventListener("keydown", listen);
  return () => window.removeEventListener("keydown", listen);
}

/** The chord as printed on keys: "Ctrl Z". */
export function printChord(chord: string): string {
  if (chord === "+") return chord;
  const mac = /Mac/.test(navigator.platform);
  return chord
    .split("+")
    .map((part) => ({ mod: mac ? "⌘" : "Ctrl", shift: "⇧", alt: mac ? "⌥" : "Alt", ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Delete: "Del", Escape: "Esc" })[part] ?? part)
    .join(" ");
}

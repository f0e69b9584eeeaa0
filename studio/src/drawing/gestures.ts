// Pointer and keys on the canvas: panning, selecting, dragging, and placing the points of the tools.
import { drawn, edit, place, say, select, undo } from "../actions";
import { isTyping, ownsKey } from "../controls";
import { type Point, type Pose, along, direction, distance, toBody, toWorld } from "../model/geometry";
import { type End, GROUND, type Poses, poseOf } from "../model/model";
import type { Target, Thing } from "../model/operations";
import { overwritten } from "../model/placing";
import { keepPoses, movePoint } from "../model/reshape";
import { KinematicDrag } from "../play/kernel-session";
import { player } from "../play/player";
import { studio } from "../state";
import { createStore } from "../store";
import { gridStep } from "./camera";
import { type Hit, hitTest, nearestMarker, snap } from "./hit";
import { ARROWS, nextPoint, placeInWords, pointsOf } from "./key-cursor";
import { type Asks, finish, toolOf } from "./tools";
import type { View } from "./view";

/** The fields next to the pointer while a tool draws: typed values are exact. */
export interface Entry {
  open: boolean;
  x: number;
  y: number;
  length: number;
  angle: number;
  radius: boolean;
  typed: { length: string; angle: string };
  field: "length" | "angle";
  /** Where the keys have moved the tool's point, in words for those who cannot see it. */
  said: string;
}

const CLOSED: Entry = { open: false, x: 0, y: 0, length: 0, angle: 0, radius: false, typed: { length: "", angle: "" }, field: "length", said: "" };
export const entry = createStore<Entry>(CLOSED);

type Gesture =
  | { kind: "pan"; from: Point; camera: Point; moved: boolean }
  | { kind: "box"; from: Point }
  /** `asks`: the move to this point would replace names of parameters; it is shown but not yet written. */
  | { kind: "reshape"; end: End; label: string; moved: boolean; key: string; asks: Point | null }
  | { kind: "drag"; drag: KinematicDrag; moved: boolean; before: Poses | null; at: Point }
  | { kind: "pull"; body: string; point: [number, number] }
  /** `first`: this press set the first point. */
  | { kind: "tool"; pressed: Point; first: boolean };

/** A click without keys held. */
const PLAIN = { altKey: false, shiftKey: false };
/** Distance in pixels that the keys' point keeps from the edge. */
const EDGE = 24;

export class Gestures {
  private gesture: Gesture | null = null;
  private targets: Target[] = [];
  private pointer: Point = [0, 0];
  private count = 0;
  /** The keys moved the pointer last, not the mouse. */
  private keyed = false;
  private readonly abort = new AbortController();

  constructor(private readonly view: View) {
    const { svg } = view;
    const options = { signal: this.abort.signal };
    svg.addEventListener("pointerdown", (event) => this.down(event), options);
    svg.addEventListener("pointermove", (event) => this.move(event), options);
    svg.addEventListener("pointerup", (event) => this.up(event), options);
    svg.addEventListener("pointercancel", () => this.cancel(), options);
    svg.addEventListener("dblclick", (event) => this.doubleClick(event), options);
    svg.addEventListener("pointerleave", () => this.gesture || studio.set({ hover: null }), options);
    svg.addEventListener("wheel", (event) => this.wheel(event), { ...options, passive: false });
    window.addEventListener("keydown", (event) => this.key(event), options);
    let tool = studio.get().tool;
    let mode = studio.get().mode;
    const end = studio.subscribe(() => {
      const now = studio.get();
      // Pulling during a run turns it into a live motion, and the pull continues in it.
      const pulls = now.mode === "live" && this.gesture?.kind === "pull";
      const other = now.tool !== tool || (now.mode !== mode && now.mode !== "edit" && !pulls);
      // Set first: cancelling changes the store, which calls this again.
      tool = now.tool;
      mode = now.mode;
      if (svg.dataset["tool"] !== tool && document.activeElement?.closest(".tools")) (svg as SVGSVGElement & HTMLElement).focus();
      svg.dataset["tool"] = tool;
      if (other) this.cancel();
    });
    svg.dataset["tool"] = tool;
    this.abort.signal.addEventListener("abort", end);
  }

  close(): void {
    this.abort.abort();
  }

  private local(event: MouseEvent): Point {
    const box = this.view.svg.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** Poses currently on the screen. */
  private poses(): Poses {
    const { model } = studio.get();
    const frame = player.frame();
    return new Map(model.bodies.map((body): [string, Pose] => [body.name, frame.pose(body.name)]));
  }

  private hit(at: Point): Hit | null {
    return hitTest(studio.get().model, this.view.looks, this.view.toWorld(at), this.view.metres(10), this.poses());
  }

  private target(at: Point, event: { altKey: boolean; shiftKey: boolean }): Target {
    const { model, snapping } = studio.get();
    const from = this.targets[this.targets.length - 1];
    let world = this.view.toWorld(at);
    if (event.shiftKey && from) world = along(from.at, distance(from.at, world), Math.round(direction(from.at, world) / (Math.PI / 12)) * (Math.PI / 12));
    const reach = this.view.metres(11);
    return snap(model, this.view.looks, world, reach, gridStep(this.view.camera), this.poses(), event.altKey || !snapping || (event.shiftKey && !!from));
  }

  private down(event: PointerEvent): void {
    (this.view.svg as SVGSVGElement & HTMLElement).focus?.();
    const at = this.local(event);
    this.pointer = at;
    this.keyed = false;
    this.view.svg.setPointerCapture(event.pointerId);
    if (event.button === 1 || event.button === 2) return this.startPan(at);
    if (event.button !== 0) return;
    const { tool } = studio.get();
    if (tool !== "select") return this.toolDown(at, event);
    const hit = this.hit(at);
    if (!hit) {
      if (event.shiftKey) this.gesture = { kind: "box", from: this.view.toWorld(at) };
      else this.startPan(at);
      return;
    }
    this.pick(hit.thing, event.shiftKey || event.ctrlKey || event.metaKey);
    this.startDrag(hit, at);
  }

  private startPan(at: Point): void {
    this.gesture = { kind: "pan", from: at, camera: [this.view.camera.x, this.view.camera.y], moved: false };
    this.view.svg.classList.add("panning");
  }

  private pick(thing: Thing, more: boolean): void {
    const { selection } = studio.get();
    const there = selection.some((one) => one.kind === thing.kind && one.name === thing.name);
    if (!more) {
      if (!there) select([thing]);
    } else select(there ? selection.filter((one) => one.kind !== thing.kind || one.name !== thing.name) : [...selection, thing]);
    if (studio.get().side === null) studio.set({ side: "properties" });
  }

  private startDrag(hit: Hit, at: Point): void {
    const { mode, poses, model } = studio.get();
    const world = this.view.toWorld(at);
    if (mode !== "edit") {
      if (hit.body && hit.body !== GROUND) this.startPull(hit.body, world);
      return;
    }
    if (hit.end) {
      this.gesture = { kind: "reshape", end: hit.end, label: `Move point ${hit.end.marker}`, moved: false, key: `reshape${++this.count}`, asks: null };
      return;
    }
    if (!hit.body || hit.thing.kind !== "body") return;
    const point = toBody(poseOf(model, hit.body, poses ?? undefined), world);
    this.gesture = { kind: "drag", drag: new KinematicDrag(hit.body, [...point]), moved: false, before: poses, at };
  }

  private startPull(body: string, world: Point): void {
    const point = toBody(player.frame().pose(body), world);
    this.gesture = { kind: "pull", body, point: [...point] };
    player.setPull({ body, point: [...point], target: [...world] });
  }

  private move(event: PointerEvent): void {
    const at = this.local(event);
    this.pointer = at;
    this.keyed = false;
    const { gesture } = this;
    if (!gesture || gesture.kind === "tool") {
      if (studio.get().tool === "select") return this.hover(at);
      return this.previewTool(at, event);
    }
    if (gesture.kind === "pan") {
      gesture.moved ||= distance(at, gesture.from) > 3;
      return this.view.setCamera({ ...this.view.camera, x: gesture.camera[0] + at[0] - gesture.from[0], y: gesture.camera[1] + at[1] - gesture.from[1] });
    }
    if (gesture.kind === "box") return this.view.show({ lines: [], box: [gesture.from, this.view.toWorld(at)] });
    const world = this.view.toWorld(at);
    if (gesture.kind === "pull") {
      // The motion has ended during the pull: moving on must not start another one.
      if (!player.pulling) return this.reset();
      return player.setPull({ body: gesture.body, point: gesture.point, target: [...world] });
    }
    if (gesture.kind === "reshape") return this.reshape(gesture, at, event);
    if (!gesture.moved && distance(at, gesture.at) < 4) return;
    gesture.moved = true;
    gesture.drag.to([...world]);
  }

  private reshape(gesture: Extract<Gesture, { kind: "reshape" }>, at: Point, event: PointerEvent): void {
    const { model, poses, snapping } = studio.get();
    const world = this.view.toWorld(at);
    const step = gridStep(this.view.camera);
    if (!gesture.moved && distance(at, this.view.toScreen(this.worldOf(gesture.end))) < 4) return;
    gesture.moved = true;
    const to: Point = event.altKey || !snapping ? world : [Math.round(world[0] / step) * step, Math.round(world[1] / step) * step];
    const text = movePoint(model, gesture.end, to, poses ?? undefined);
    if (gesture.asks || overwritten(model, text).length > 0) {
      if (!gesture.asks) this.takeBack(gesture);
      gesture.asks = to;
      return this.view.show({ lines: [[this.worldOf(gesture.end), to]], snap: { at: to, joins: false } });
    }
    edit(text, gesture.label, gesture.key);
    player.touch();
  }

  private takeBack(gesture: Extract<Gesture, { kind: "reshape" }>): void {
    const { past } = studio.get().history;
    if (past[past.length - 1]?.key === gesture.key) undo();
  }

  private worldOf(end: End): Point {
    const { model } = studio.get();
    const list = end.body === GROUND ? model.ground : (model.body.get(end.body)?.markers ?? []);
    return toWorld(end.body === GROUND ? { x: 0, y: 0, angle: 0 } : player.frame().pose(end.body), list.find((one) => one.name === end.marker)?.at ?? [0, 0]);
  }

  private hover(at: Point): void {
    const hit = this.hit(at);
    const { hover, mode } = studio.get();
    const cursor = !hit ? "" : mode !== "edit" ? "grab" : hit.end ? "move" : hit.thing.kind === "body" ? "grab" : "pointer";
    this.view.svg.style.cursor = cursor;
    if (hover?.kind !== hit?.thing.kind || hover?.name !== hit?.thing.name) studio.set({ hover: hit?.thing ?? null });
  }

  private up(event: PointerEvent): void {
    const { gesture } = this;
    const at = this.local(event);
    this.gesture = null;
    this.view.svg.classList.remove("panning");
    if (!gesture) return;
    if (gesture.kind === "tool") return this.toolUp(gesture, at, event);
    this.view.show(null);
    if (gesture.kind === "pan" && !gesture.moved && event.button === 0 && !event.shiftKey) select([]);
    if (gesture.kind === "pull") player.setPull(null);
    if (gesture.kind === "box") this.selectIn(gesture.from, this.view.toWorld(at));
    if (gesture.kind === "drag" && gesture.moved) this.endDrag(gesture);
    if (gesture.kind === "reshape" && gesture.asks) {
      const { model, poses } = studio.get();
      place(movePoint(model, gesture.end, gesture.asks, poses ?? undefined), gesture.label);
    }
  }

  // A start pose that is written with parameters is not overwritten without asking.
  private endDrag(gesture: Extract<Gesture, { kind: "drag" }>): void {
    const { model } = studio.get();
    const { poses } = gesture.drag;
    if (!poses) return;
    const keep = () => void edit(keepPoses(studio.get().model, poses), "Move start position");
    if (!model.bodies.some((body) => body.parametric)) return keep();
    say("The start position is defined by parameters. Keep this one instead?", { label: "Keep", run: keep });
    setTimeout(() => {
      if (studio.get().poses === poses && studio.get().model === model) studio.set({ poses: gesture.before });
    }, 6000);
  }

  private selectIn(a: Point, b: Point): void {
    const { model } = studio.get();
    const inside = ({ x, y }: Pose) => x >= Math.min(a[0], b[0]) && x <= Math.max(a[0], b[0]) && y >= Math.min(a[1], b[1]) && y <= Math.max(a[1], b[1]);
    const frame = player.frame();
    select(model.bodies.filter((body) => inside(frame.pose(body.name))).map((body) => ({ kind: "body", name: body.name })));
  }

  // ---- tools

  private toolDown(at: Point, event: PointerEvent): void {
    const tool = toolOf(studio.get().tool);
    const first = this.targets.length === 0;
    if (this.takePoint(tool.asks, this.target(at, event))) return;
    this.gesture = { kind: "tool", pressed: at, first };
    this.previewTool(at, event);
  }

  /** True if the tool has all the points that it needs. */
  private takePoint(asks: Asks, target: Target): boolean {
    const closes = asks === "many" && this.targets.length > 2 && distance(this.targets[0]!.at, target.at) < this.view.metres(8);
    if (asks === "point" || closes) {
      this.finish(closes ? this.targets : [target]);
      return true;
    }
    if (this.targets.length === 0 || asks === "many") this.targets.push(target);
    return false;
  }

  private toolUp({ pressed, first }: { pressed: Point; first: boolean }, at: Point, event: PointerEvent): void {
    const { asks } = toolOf(studio.get().tool);
    if (asks === "many") return;
    const dragged = distance(pressed, at) > 6;
    const from = this.targets[0];
    if (!from) return;
    if (asks === "ray") this.finish([from, this.target(at, event)]);
    else if (dragged || !first) this.finish([from, this.exact(this.target(at, event))]);
  }

  // Typed length and angle take precedence over the pointer's.
  private exact(target: Target): Target {
    const { typed } = entry.get();
    const from = this.targets[0];
    const length = readTyped(typed.length, 1e-3);
    const angle = readTyped(typed.angle, Math.PI / 180);
    if (!from || (length === null && angle === null)) return target;
    const at = along(from.at, length ?? distance(from.at, target.at), angle ?? direction(from.at, target.at));
    const end = nearestMarker(studio.get().model, at, this.view.metres(2), this.poses());
    return { at, end, body: end?.body ?? null };
  }

  private previewTool(at: Point, event: { altKey: boolean; shiftKey: boolean }): void {
    const tool = toolOf(studio.get().tool);
    const target = this.exact(this.target(at, event));
    const joins = target.end !== null || target.body !== null;
    const from = this.targets[0];
    if (!from) return this.view.show({ lines: [], snap: { at: target.at, joins, keyed: this.keyed } });
    const radius = tool.asks === "radius";
    const lines = radius ? [[from.at, target.at]] : [[...this.targets.map((one) => one.at), target.at]];
    this.view.show({ lines, snap: { at: target.at, joins, keyed: this.keyed }, circle: radius ? { centre: from.at, radius: distance(from.at, target.at) } : undefined });
    const [x, y] = this.view.toScreen(target.at);
    entry.set({ open: tool.asks === "two" || radius, x, y, length: distance(from.at, target.at), angle: direction(from.at, target.at), radius });
  }

  private finish(targets: readonly Target[]): void {
    const { tool, model } = studio.get();
    const context = { model, looks: this.view.looks, poses: this.poses(), reach: this.view.metres(10) };
    const made = finish(tool, targets, context);
    this.reset();
    if (typeof made === "string") {
      if (made) say(made);
      return;
    }
    drawn(made, toolOf(tool).label);
    entry.set({ said: `${toolOf(tool).label}: ${made.made.map((one) => one.name).join(", ")}` });
    if (tool === "motor" || tool === "force" || tool === "torque" || tool === "torsion") studio.set({ side: "properties" });
  }

  private reset(): void {
    this.targets = [];
    this.gesture = null;
    entry.set(CLOSED);
    this.view.show(null);
  }

  cancel(): void {
    const { gesture } = this;
    this.reset();
    if (gesture?.kind === "pull") player.setPull(null);
    if (gesture?.kind === "reshape" && gesture.moved) this.takeBack(gesture);
  }

  get drawing(): boolean {
    return this.targets.length > 0;
  }

  private doubleClick(event: MouseEvent): void {
    if (toolOf(studio.get().tool).asks === "many" && this.targets.length > 2) return this.finish(this.targets.slice(0, distance(this.targets[this.targets.length - 1]!.at, this.targets[this.targets.length - 2]!.at) < this.view.metres(4) ? -1 : undefined));
    if (studio.get().tool === "select" && !this.hit(this.local(event))) this.view.fit();
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const size = event.deltaMode === 1 ? 30 : 1;
    if (event.shiftKey) return this.view.setCamera({ ...this.view.camera, x: this.view.camera.x - event.deltaY * size });
    this.view.zoom(Math.exp(-event.deltaY * size * (event.ctrlKey ? 0.01 : 0.0015)), this.local(event));
  }

  private drawByKey(event: KeyboardEvent): boolean {
    const { tool, dialog } = studio.get();
    const { asks } = toolOf(tool);
    if (asks === "nothing" || dialog || event.ctrlKey || event.metaKey || event.altKey || ownsKey(event.target, event.key)) return false;
    const arrow = ARROWS[event.key];
    if (arrow) {
      this.moveByKey(arrow, event.shiftKey ? 5 : 1);
      return true;
    }
    if (event.key !== "Enter") return false;
    this.bringIntoView();
    const target = this.target(this.pointer, PLAIN);
    const last = this.targets[this.targets.length - 1];
    // With the mouse, Enter ends a drawing; with the keys, Enter sets corners and ends the drawing when the point has not moved.
    if (last && !(asks === "many" && this.keyed && distance(last.at, target.at) > this.view.metres(1))) return false;
    if (this.takePoint(asks, target)) return true;
    this.previewTool(this.pointer, PLAIN);
    entry.set({ said: `Point ${this.targets.length}: ${placeInWords(target)}` });
    return true;
  }

  private moveByKey(arrow: Point, steps: number): void {
    this.bringIntoView();
    const { model } = studio.get();
    // Long steps follow the grid only.
    const points = steps === 1 ? pointsOf(model, this.poses()) : [];
    this.pointer = this.view.toScreen(nextPoint(this.view.toWorld(this.pointer), arrow, steps * gridStep(this.view.camera), points));
    this.keyed = true;
    this.follow();
    this.previewTool(this.pointer, PLAIN);
    entry.set({ said: placeInWords(this.exact(this.target(this.pointer, PLAIN))) });
  }

  // If the pointer never entered the canvas, or a zoom left it outside, the keys start in the middle.
  private bringIntoView(): void {
    const { width, height } = this.view.size;
    const [x, y] = this.pointer;
    if (x <= 0 || y <= 0 || x >= width || y >= height) this.pointer = [width / 2, height / 2];
  }

  /** Pans when the keys move the point over the edge. */
  private follow(): void {
    const { width, height } = this.view.size;
    const [x, y] = this.pointer;
    const inside: Point = [Math.min(Math.max(x, EDGE), width - EDGE), Math.min(Math.max(y, EDGE), height - EDGE)];
    if (inside[0] === x && inside[1] === y) return;
    const { camera } = this.view;
    this.view.setCamera({ ...camera, x: camera.x + inside[0] - x, y: camera.y + inside[1] - y });
    this.pointer = inside;
  }

  /** Numbers typed while a tool draws go to its fields; Enter accepts them. */
  private key(event: KeyboardEvent): void {
    if (isTyping(event.target)) return;
    if (this.drawByKey(event)) return event.preventDefault();
    if (!this.drawing) return;
    const now = entry.get();
    if (event.key === "Escape") {
      event.stopImmediatePropagation();
      return this.cancel();
    }
    if (event.key === "Enter") {
      event.preventDefault();
      const { asks } = toolOf(studio.get().tool);
      if (asks === "many") return this.finish(this.targets);
      return this.finish([this.targets[0]!, this.exact(this.target(this.pointer, event))]);
    }
    if (!now.open || event.ctrlKey || event.metaKey) return;
    const typed = now.typed[now.field];
    if (event.key === "Tab") entry.set({ field: now.field === "length" && !now.radius ? "angle" : "length" });
    else if (event.key === "Backspace") entry.set({ typed: { ...now.typed, [now.field]: typed.slice(0, -1) } });
    else if (/^[-\d.,a-z° ]$/.test(event.key) && (typed !== "" || /[-\d.]/.test(event.key))) entry.set({ typed: { ...now.typed, [now.field]: typed + event.key.replace(",", ".") } });
    else return;
    event.preventDefault();
    event.stopImmediatePropagation();
    this.previewTool(this.pointer, event);
  }
}

/** "200", "200 mm", "0.2 m", "30°"; a bare number is in the unit of the field. */
export function readTyped(text: string, unit: number): number | null {
  const found = /^\s*(-?\d*\.?\d+)\s*(mm|cm|m|in|deg|°|rad)?\s*$/.exec(text);
  if (!found) return null;
  const factors: Record<string, number> = { mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254, deg: Math.PI / 180, "°": Math.PI / 180, rad: 1 };
  return Number(found[1]) * (found[2] ? factors[found[2]]! : unit);
}

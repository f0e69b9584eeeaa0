// The drawing tools: the points that each asks for, and what it creates from them.
import { type Point, direction, distance } from "../model/geometry";
import { GROUND, type Model, type Poses, extent } from "../model/model";
import {
  type Made, type Target, addBar, addConnector, addDisc, addForce, addGroundPin, addMotor, addPin, addPlate, addSlider, addSlot, addTorsionSpring, toggleTrace,
} from "../model/operations";
import type { ToolName } from "../state";
import { bodiesAt } from "./hit";
import type { Looks } from "./looks";

export type Asks =
  | "nothing"
  /** One click. */
  | "point"
  /** Two points: by dragging, or click and click. */
  | "two"
  /** Points up to Enter or a double click. */
  | "many"
  /** A point, and a direction by dragging. */
  | "ray"
  /** A centre and a radius. */
  | "radius";

export interface Tool {
  name: ToolName;
  label: string;
  key: string;
  asks: Asks;
  hint: string;
  group: "select" | "bodies" | "joints" | "loads";
}

export const TOOL_LIST: readonly Tool[] = [
  { name: "select", label: "Select", key: "V", asks: "nothing", group: "select", hint: "Drag a link to move the mechanism, a point to reshape it. Shift-drag on the background selects." },
  { name: "link", label: "Link", key: "L", asks: "two", group: "bodies", hint: "Drag from one end to the other. An end placed on a point or a bar is pinned there. Type a number for an exact length." },
  { name: "plate", label: "Plate", key: "K", asks: "many", group: "bodies", hint: "Click three or more corners; Enter or a double-click finishes." },
  { name: "disc", label: "Gear", key: "D", asks: "radius", group: "bodies", hint: "Drag from the centre to the rim. A rim that touches another gear meshes with it." },
  { name: "ground", label: "Ground pin", key: "G", asks: "point", group: "joints", hint: "Click a point to pin it to the ground." },
  { name: "pin", label: "Pin", key: "P", asks: "point", group: "joints", hint: "Click where two links cross to pin them together." },
  { name: "slider", label: "Slider", key: "S", asks: "ray", group: "joints", hint: "Click a point to put a sliding block there; drag to turn its guide." },
  { name: "slot", label: "Slot", key: "O", asks: "ray", group: "joints", hint: "Click a point to guide it in a slot in the ground; drag to turn the slot. On two links, the slot is in the lower one." },
  { name: "weld", label: "Weld", key: "W", asks: "point", group: "joints", hint: "Click where two links overlap, or a point to fix it to the ground." },
  { name: "spring", label: "Spring", key: "Q", asks: "two", group: "loads", hint: "Drag from one point to another." },
  { name: "damper", label: "Damper", key: "E", asks: "two", group: "loads", hint: "Drag from one point to another." },
  { name: "torsion", label: "Torsion spring", key: "U", asks: "point", group: "loads", hint: "Click a pin." },
  { name: "rod", label: "Rod", key: "I", asks: "two", group: "loads", hint: "Drag from one point to another: a massless rod keeps their distance." },
  { name: "rope", label: "Rope", key: "J", asks: "two", group: "loads", hint: "Drag from one point to another: a rope limits their distance." },
  { name: "motor", label: "Motor", key: "M", asks: "point", group: "loads", hint: "Click a pin or a slider to drive it." },
  { name: "force", label: "Force", key: "F", asks: "ray", group: "loads", hint: "Press on a link and drag: ten pixels per newton; type the exact value afterwards." },
  { name: "torque", label: "Torque", key: "T", asks: "point", group: "loads", hint: "Click a link." },
  { name: "trace", label: "Trace", key: "R", asks: "point", group: "loads", hint: "Click a point of a link to trace its path." },
];

export const toolOf = (name: ToolName): Tool => TOOL_LIST.find((tool) => tool.name === name) ?? TOOL_LIST[0]!;

export interface Context {
  model: Model;
  looks: Looks;
  poses?: Poses;
  /** Ten pixels [m]. */
  reach: number;
}

/** What the tool creates, or why it cannot. */
export function finish(tool: ToolName, targets: readonly Target[], context: Context): Made | string {
  const { model, poses, looks, reach } = context;
  const first = targets[0]!;
  const last = targets[targets.length - 1]!;
  const tooShort = targets.length > 1 && distance(first.at, last.at) < reach / 2;
  switch (tool) {
    case "link":
      return tooShort ? "" : addBar(model, first, last, poses);
    case "plate":
      return targets.length < 3 ? "A plate needs three corners." : addPlate(model, targets, poses);
    case "disc":
      return tooShort ? "" : makeDisc(model, looks, first, distance(first.at, last.at), reach, poses);
    case "ground":
      return first.body === null || first.body === GROUND ? "There is no link at this point." : addGroundPin(model, first, "revolute", poses);
    case "pin":
    case "weld":
      return join(tool, first, context);
    case "slider":
      return addSlider(model, first, rayAngle(first, last, tooShort), GROUND, extent(model, poses).size, poses);
    case "slot":
      return makeSlot(first, rayAngle(first, last, tooShort), context);
    case "spring":
    case "damper":
    case "rod":
    case "rope":
      if (tooShort) return "";
      return first.body === last.body ? "Both ends are on the same body." : addConnector(model, tool, first, last, poses);
    case "motor":
    case "torsion":
      return onJoint(tool, first, context);
    case "force": {
      if (first.body === null || first.body === GROUND) return "A force acts on a link.";
      const push: Point = tooShort || targets.length < 2 ? [0, -10] : [last.at[0] - first.at[0], last.at[1] - first.at[1]];
      const size = tooShort || targets.length < 2 ? 1 : 1 / reach;
      return addForce(model, first, [Math.round(push[0] * size), Math.round(push[1] * size)], 0, poses);
    }
    case "torque":
      return first.body === null || first.body === GROUND ? "A torque acts on a link." : addForce(model, first, null, 1, poses);
    case "trace":
      return first.body === null || first.body === GROUND ? "Click a point of a link." : toggleTrace(model, first, poses);
    case "select":
      return "";
  }
}

function rayAngle(first: Target, last: Target, tooShort: boolean): number {
  return tooShort ? 0 : (Math.round((direction(first.at, last.at) * 180) / Math.PI) * Math.PI) / 180;
}

function makeDisc(model: Model, looks: Looks, centre: Target, radius: number, reach: number, poses?: Poses): Made {
  for (const body of model.bodies) {
    const look = looks.bodies.get(body.name);
    if (look?.kind !== "disc" || body.name === centre.body) continue;
    const pose = poses?.get(body.name) ?? body.pose;
    const gap = distance(centre.at, [pose.x, pose.y]) - look.radius;
    if (Math.abs(gap - radius) < 1.5 * reach && gap > 0) return addDisc(model, centre, gap, body.name, poses);
  }
  return addDisc(model, centre, radius, null, poses);
}

function under(target: Target, { model, looks, reach, poses }: Context): string[] {
  const names = bodiesAt(model, looks, target.at, reach * 0.7, poses);
  const own = target.end?.body;
  return own && own !== GROUND && !names.includes(own) ? [own, ...names] : names;
}

// The two topmost bodies; a single body is joined to the ground.
function join(tool: "pin" | "weld", first: Target, context: Context): Made | string {
  const { model, poses } = context;
  const type = tool === "pin" ? "revolute" : "fixed";
  const bodies = under(first, context);
  if (bodies.length === 0) return "There is no link at this point.";
  if (bodies.length === 1) return addGroundPin(model, first.body === GROUND ? { ...first, end: null, body: bodies[0]! } : first, type, poses);
  const [top, below] = bodies as [string, string];
  const endOn = (body: string): Target => ({ at: first.at, end: first.end?.body === body ? first.end : markerOn(context, body, first.at), body });
  return addPin(model, endOn(below), endOn(top), type, poses);
}

function markerOn({ model, poses, reach }: Context, name: string, at: Point): Target["end"] {
  const body = model.body.get(name);
  const pose = poses?.get(name) ?? body?.pose;
  if (!body || !pose) return null;
  const c = Math.cos(pose.angle);
  const s = Math.sin(pose.angle);
  const found = body.markers.find((m) => distance(at, [pose.x + c * m.at[0] - s * m.at[1], pose.y + s * m.at[0] + c * m.at[1]]) < reach * 0.5);
  return found ? { body: name, marker: found.name } : null;
}

function makeSlot(first: Target, angle: number, context: Context): Made | string {
  const { model, poses } = context;
  const bodies = under(first, context);
  if (bodies.length === 0) return "Click a point of a link.";
  if (bodies.length === 1) return addSlot(model, { ...first, body: bodies[0]! }, angle, GROUND, poses);
  const pin = first.end && bodies.includes(first.end.body) ? first.end.body : bodies[0]!;
  const carrier = bodies.find((name) => name !== pin)!;
  const pose = poses?.get(carrier) ?? model.body.get(carrier)?.pose;
  const points = model.body.get(carrier)?.markers ?? [];
  const along = points.length > 1 ? direction(points[0]!.at, points[1]!.at) : 0;
  return addSlot(model, { at: first.at, end: first.end?.body === pin ? first.end : null, body: pin }, (pose?.angle ?? 0) + along, carrier, poses);
}

function onJoint(tool: "motor" | "torsion", first: Target, context: Context): Made | string {
  const joint = jointAt(first, context, tool === "motor" ? ["revolute", "prismatic", "slot"] : ["revolute"]);
  if (joint === null) return tool === "motor" ? "A motor needs a pin or a slider: click one." : "A torsion spring needs a pin: click one.";
  if (tool === "torsion") return addTorsionSpring(context.model, joint);
  if (context.model.motors.some((motor) => motor.joint === joint)) return `Joint ${joint} already has a motor.`;
  return addMotor(context.model, joint);
}

// Pins on the ground take precedence, since they are usually the driven ones.
function jointAt(target: Target, { model, poses, reach }: Context, types: readonly string[]): string | null {
  let best: { name: string; score: number } | null = null;
  for (const joint of model.joints) {
    if (!types.includes(joint.type)) continue;
    for (const end of [joint.first, joint.second]) {
      const pose = end.body === GROUND ? { x: 0, y: 0, angle: 0 } : (poses?.get(end.body) ?? model.body.get(end.body)?.pose);
      const list = end.body === GROUND ? model.ground : model.body.get(end.body)?.markers;
      const marker = list?.find((one) => one.name === end.marker);
      if (!pose || !marker || (end.body === GROUND && joint.type !== "revolute")) continue;
      const c = Math.cos(pose.angle);
      const s = Math.sin(pose.angle);
      const gap = distance(target.at, [pose.x + c * marker.at[0] - s * marker.at[1], pose.y + s * marker.at[0] + c * marker.at[1]]);
      if (gap > 1.6 * reach) continue;
      const score = gap + (joint.first.body === GROUND || joint.second.body === GROUND ? 0 : reach) + (joint.type === "revolute" ? reach : 0);
      if (!best || score < best.score) best = { name: joint.name, score };
    }
  }
  return best?.name ?? null;
}

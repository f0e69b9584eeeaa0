// Positions as written into a model: what has not moved stays as its author wrote it.
import type { Draft, Literal } from "./edit";
import { type Point, type Pose, distance } from "./geometry";
import type { Body, Model, Poses } from "./model";
import { TRACE } from "./remarks";
import { namesIn } from "./expression";
import { type Node, nodeAt, parseToml, plain } from "./toml";
import { writeAngle, writeLengths } from "./units";

/** A change below this fraction of a body's size, or of a radian, is no movement. */
const NOTHING = 1e-9;

/** A marker as written: its axis is included only if it has one. */
export function markerLiteral(at: Point, axis: number): Literal[] {
  const xy = writeLengths(at);
  return axis ? [...xy, writeAngle(axis)] : xy;
}

export interface Placed {
  at: Point;
  axis: number;
  traced: boolean;
}

/** Writes a marker at `path`; `before` is its previous position, null for a new one. */
export function writeMarker(draft: Draft, path: readonly string[], now: Placed, before: Placed | null): void {
  const node = nodeAt(draft.document.root, path);
  const size = Math.max(...now.at.map(Math.abs), ...(before?.at ?? []).map(Math.abs));
  const same = [0, 1].map((i) => before !== null && Math.abs(now.at[i]! - before.at[i]!) <= NOTHING * size);
  same.push(before !== null && Math.abs(now.axis - before.axis) <= NOTHING);
  if (node && same.every(Boolean)) return;
  const literal = markerLiteral(now.at, now.axis);
  if (node?.kind === "table" && (node.form !== "inline" || node.entries.has("x") || node.entries.has("y"))) {
    const turned = !same[2] || node.entries.has("r");
    for (const [i, key] of ["x", "y"].entries()) if (!same[i] || node.entries.has("r")) draft.set([...path, key], literal[i]!);
    for (const key of ["r", "xi"]) if (node.entries.has(key)) draft.remove([...path, key]);
    if (turned && now.axis) draft.set([...path, "axis"], writeAngle(now.axis));
    return;
  }
  if (node?.kind === "list") node.items.forEach((item, i) => same[i] && (literal[i] = plain(item)));
  draft.set(path, literal, now.traced ? TRACE : "");
}

/** Writes the pose of a body; `before` is its previous pose, null if that is unknown. */
export function writePose(draft: Draft, name: string, now: Pose, before: Pose | null = null, size = 0): void {
  if (!before || distance([now.x, now.y], [before.x, before.y]) > NOTHING * size) {
    const path = ["body", name, "position"];
    const literal: Literal[] = writeLengths([now.x, now.y]);
    const node = nodeAt(draft.document.root, path);
    const same = [before?.x === now.x, before?.y === now.y];
    if (node?.kind === "list") node.items.forEach((item, i) => same[i] && (literal[i] = plain(item)));
    draft.set(path, literal);
  }
  if (!before || Math.abs(now.angle - before.angle) > NOTHING) draft.set(["body", name, "angle"], writeAngle(now.angle));
}

/** The larger of a body's size and its distance from the origin. */
export function sizeOf(body: Body, pose: Pose): number {
  return Math.max(Math.hypot(pose.x, pose.y), ...body.markers.map((marker) => Math.hypot(...marker.at)), 1e-12);
}

/** Writes the poses of all bodies that differ from the text, for example after dragging the mechanism. */
export function writePoses(draft: Draft, model: Model, poses: Poses): void {
  for (const body of model.bodies) {
    const pose = poses.get(body.name);
    if (pose) writePose(draft, body.name, pose, body.stated ? body.pose : null, sizeOf(body, pose));
  }
}

/** Values of a model that contain names of its parameters and that `text` no longer has: "body.lever.markers.A". */
export function overwritten(model: Model, text: string): string[] {
  const known = new Set(model.parameters.keys());
  if (known.size === 0) return [];
  const gone: string[] = [];
  const compare = (before: Node, after: Node | undefined, path: string) => {
    if (before.kind === "table") {
      for (const [key, inner] of before.entries) compare(inner, after?.kind === "table" ? after.entries.get(key) : undefined, path ? `${path}.${key}` : key);
    } else if (before.kind === "list") {
      before.items.forEach((item, i) => compare(item, after?.kind === "list" ? after.items[i] : undefined, path));
    } else if (before.kind === "text" && namesIn(before.value, known).length > 0 && (after?.kind !== "text" || after.value !== before.value) && !gone.includes(path)) gone.push(path);
  };
  const after = parseToml(text).root;
  for (const key of ["ground", "body"]) {
    const before = model.document.root.entries.get(key);
    if (before) compare(before, after.entries.get(key), key);
  }
  return gone;
}

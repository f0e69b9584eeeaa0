// How each body and joint of a model is drawn, as in a textbook: bars with rounded ends, plates, discs, blocks on guides.
// Decided once per model; in metres and body axes, so that drawing and picking agree.
import { type Point, distance } from "../model/geometry";
import { type Body, type End, GROUND, type Joint, type Marker, type Model, type Poses, markerOf, worldPoint } from "../model/model";

export type BodyLook =
  /** The rounded hull of these points. */
  | { kind: "bar"; points: Point[] }
  | { kind: "disc"; radius: number; spokes: boolean }
  /** A slider block; its size is fixed on the screen or given by its shape. */
  | { kind: "block"; axis: number; at: Point; width: number | null; height: number | null }
  | { kind: "mass" };

export interface GearLook {
  joint: string;
  body: string;
  at: Point;
  radius: number;
  internal: boolean;
}

export interface GuideLook {
  joint: string;
  /** The body that carries the guide. */
  on: string;
  at: Point;
  axis: number;
  slot: boolean;
  /** Half its length [m]. */
  reach: number;
}

export interface Looks {
  bodies: Map<string, BodyLook>;
  gears: GearLook[];
  guides: GuideLook[];
}

/** For a sliding joint: the end that carries the guide, and the end that moves along it. */
export function guideEnds(joint: Joint): { guide: End; runner: End } {
  // A slot always belongs to the first marker; a prismatic pair looks best with its guide on the ground.
  if (joint.type === "prismatic" && joint.second.body === GROUND) return { guide: joint.second, runner: joint.first };
  return { guide: joint.first, runner: joint.second };
}

// A guide on the ground is drawn at its runner, since its marker may be far away on the same line.
function alongAxis([x, y]: Point, axis: number, [u, v]: Point): Point {
  const c = Math.cos(axis);
  const s = Math.sin(axis);
  const slide = (u - x) * c + (v - y) * s;
  return [x + slide * c, y + slide * s];
}

export function looksOf(model: Model, size: number, poses?: Poses): Looks {
  const gears = gearsOf(model);
  const guides: GuideLook[] = [];
  for (const joint of model.joints) {
    if (joint.type !== "prismatic" && joint.type !== "slot") continue;
    const { guide, runner } = guideEnds(joint);
    const marker = markerOf(model, guide);
    const carrier = model.body.get(guide.body);
    const own = carrier ? Math.max(...carrier.markers.map((m) => distance(m.at, marker?.at ?? [0, 0])), 0) : 0;
    const at = carrier ? (marker?.at ?? [0, 0]) : alongAxis(marker?.at ?? [0, 0], marker?.axis ?? 0, worldPoint(model, runner, poses));
    guides.push({ joint: joint.name, on: guide.body, at, axis: marker?.axis ?? 0, slot: joint.type === "slot", reach: own || size * 0.3 });
  }
  const bodies = new Map(model.bodies.map((body) => [body.name, lookOf(model, body, gears, guides, size)]));
  return { bodies, gears, guides };
}

function gearsOf(model: Model): GearLook[] {
  const gears: GearLook[] = [];
  for (const joint of model.joints) {
    const add = (end: End, radius: number | null | undefined, internal = false) => {
      const at = markerOf(model, end)?.at;
      if (!radius || !at || gears.some((g) => g.body === end.body && Math.abs(g.radius - radius) < 1e-9)) return;
      gears.push({ joint: joint.name, body: end.body, at, radius, internal });
    };
    if (joint.type === "gear") {
      add(joint.first, joint.radii?.[0], joint.internal && (joint.radii?.[0] ?? 0) > (joint.radii?.[1] ?? 0));
      add(joint.second, joint.radii?.[1], joint.internal && (joint.radii?.[1] ?? 0) > (joint.radii?.[0] ?? 0));
    } else if (joint.type === "rack") add(joint.first, joint.radius);
    else if (joint.type === "belt") [joint.first, joint.second].forEach((end, i) => add(end, Math.abs(joint.discs[i] ?? 0)));
  }
  return gears;
}

// A body with slots extends from end to end of each.
function slotEnds(body: Body, guides: readonly GuideLook[]): Point[] {
  return guides
    .filter((guide) => guide.slot && guide.on === body.name)
    .flatMap(({ at, axis, reach }): Point[] => [1, -1].map((side) => [at[0] + side * reach * Math.cos(axis), at[1] + side * reach * Math.sin(axis)]));
}

function lookOf(model: Model, body: Body, gears: readonly GearLook[], guides: readonly GuideLook[], size: number): BodyLook {
  const { shape } = body;
  if (shape?.kind === "disc") return { kind: "disc", radius: shape.width / 2, spokes: true };
  const points = distinct([...body.markers.map((marker) => marker.at), ...slotEnds(body, guides)], size);
  const runner = runnerOf(model, body);
  if (points.length <= 1) {
    const at = points[0] ?? [0, 0];
    if (shape?.kind === "block") return { kind: "block", axis: runner?.axis ?? 0, at, width: shape.width, height: shape.height };
    if (runner && Math.hypot(...at) < 0.02 * size) return { kind: "block", axis: runner.axis, at, width: null, height: null };
    if (Math.hypot(...at) > 0.01 * size) return { kind: "bar", points: [at, [0, 0]] };
    return gears.some((gear) => gear.body === body.name) ? { kind: "disc", radius: 0, spokes: false } : { kind: "mass" };
  }
  return { kind: "bar", points };
}

function runnerOf(model: Model, body: Body): Marker | null {
  for (const joint of model.joints) {
    if (joint.type !== "prismatic") continue;
    const { runner } = guideEnds(joint);
    if (runner.body === body.name) return markerOf(model, runner);
  }
  return null;
}

function distinct(points: readonly Point[], size: number): Point[] {
  const kept: Point[] = [];
  for (const p of points) if (!kept.some((q) => distance(p, q) < 1e-4 * size)) kept.push(p);
  return kept;
}

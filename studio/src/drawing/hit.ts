// What is under the pointer: points take precedence over joint symbols, symbols over bars, and the topmost over those below.
import { type Point, distance, hull, nearestOnSegment, toWorld } from "../model/geometry";
import { type End, GROUND, type Model, type Poses, poseOf, worldPoint } from "../model/model";
import type { Target, Thing } from "../model/operations";
import { type Looks, guideEnds } from "./looks";

export interface Hit {
  thing: Thing;
  /** The point that was hit, if any. */
  end: End | null;
  body: string | null;
}

/** `reach` is ten pixels at the current zoom, in metres. */
export function hitTest(model: Model, looks: Looks, at: Point, reach: number, poses?: Poses): Hit | null {
  const end = nearestMarker(model, at, reach, poses);
  if (end) {
    const joint = [...model.joints].reverse().find((one) => isAt(one.first, end) || isAt(one.second, end) || sharesPlace(model, one.first, one.second, end, poses, reach));
    const thing: Thing = joint && joint.type !== "gear" && joint.type !== "rack" ? { kind: "joint", name: joint.name } : { kind: "marker", name: `${end.body}.${end.marker}` };
    return { thing, end, body: end.body };
  }
  return hitConnector(model, at, reach, poses) ?? hitLoad(model, at, reach, poses) ?? hitBody(model, looks, at, reach, poses) ?? hitGuide(model, looks, at, reach, poses);
}

function isAt(end: End, other: End): boolean {
  return end.body === other.body && end.marker === other.marker;
}

function sharesPlace(model: Model, first: End, second: End, end: End, poses: Poses | undefined, reach: number): boolean {
  if (first.body !== end.body && second.body !== end.body && first.body !== GROUND) return false;
  return distance(worldPoint(model, second, poses), worldPoint(model, end, poses)) < reach / 4;
}

export function nearestMarker(model: Model, at: Point, reach: number, poses?: Poses, not?: string): End | null {
  let best: End | null = null;
  let least = reach;
  const consider = (body: string, marker: string, p: Point) => {
    const gap = distance(p, at);
    // Bodies are drawn over the ground: at the same distance the body is chosen.
    if (gap < least || (gap === least && best?.body === GROUND)) {
      least = gap;
      best = { body, marker };
    }
  };
  for (const marker of model.ground) if (!isGuideOnly(model, marker.name)) consider(GROUND, marker.name, marker.at);
  for (const body of model.bodies) {
    if (body.name === not) continue;
    const pose = poseOf(model, body.name, poses);
    for (const marker of body.markers) consider(body.name, marker.name, toWorld(pose, marker.at));
  }
  return best;
}

// The origin of a guide is not a point to pin things to.
function isGuideOnly(model: Model, marker: string): boolean {
  let guide = false;
  for (const joint of model.joints) {
    const slides = joint.type === "prismatic" || joint.type === "slot";
    for (const end of [joint.first, joint.second]) {
      if (end.body !== GROUND || end.marker !== marker) continue;
      if (!slides) return false;
      guide = true;
    }
  }
  return guide;
}

function hitConnector(model: Model, at: Point, reach: number, poses?: Poses): Hit | null {
  const near = (first: End, second: End) => {
    const a = worldPoint(model, first, poses);
    const b = worldPoint(model, second, poses);
    return distance(at, nearestOnSegment(at, a, b)) < reach * 0.8;
  };
  for (const spring of model.springs) {
    const met = spring.torsion ? distance(at, worldPoint(model, spring.second, poses)) < 1.7 * reach : near(spring.first, spring.second);
    if (met) return { thing: { kind: spring.torsion ? "torsion_spring" : "spring", name: spring.name }, end: null, body: null };
  }
  for (const joint of model.joints) {
    if (["rod", "rope", "belt", "cylinder"].includes(joint.type) && near(joint.first, joint.second)) return { thing: { kind: "joint", name: joint.name }, end: null, body: null };
  }
  return null;
}

function hitLoad(model: Model, at: Point, reach: number, poses?: Poses): Hit | null {
  for (const motor of model.motors) {
    const joint = model.joints.find((one) => one.name === motor.joint);
    if (!joint) continue;
    const p = worldPoint(model, joint.type === "revolute" ? joint.second : guideEnds(joint).runner, poses);
    const gap = distance(p, at);
    const met = joint.type === "revolute" ? gap > reach && gap < 2.1 * reach : gap > 1.4 * reach && gap < 2.6 * reach && at[1] > p[1];
    if (met) return { thing: { kind: "motor", name: motor.name }, end: null, body: null };
  }
  for (const load of model.loads) {
    const p = worldPoint(model, load.on, poses);
    const turned = load.bodyAxes ? poseOf(model, load.on.body, poses).angle : 0;
    const angle = (load.force[0] || load.force[1] ? Math.atan2(load.force[1], load.force[0]) : -Math.PI / 2) + turned;
    const tail: Point = [p[0] - 6 * reach * Math.cos(angle), p[1] - 6 * reach * Math.sin(angle)];
    const met = load.torque ? Math.abs(distance(p, at) - 1.8 * reach) < 0.5 * reach : distance(at, nearestOnSegment(at, p, tail)) < 0.7 * reach;
    if (met) return { thing: { kind: "force", name: load.name }, end: null, body: null };
  }
  return null;
}

function hitBody(model: Model, looks: Looks, at: Point, reach: number, poses?: Poses): Hit | null {
  for (const body of [...model.bodies].reverse()) {
    const look = looks.bodies.get(body.name);
    const pose = poseOf(model, body.name, poses);
    const centre: Point = [pose.x, pose.y];
    const gear = Math.max(0, ...looks.gears.filter((one) => one.body === body.name && !one.internal).map((one) => one.radius));
    let met = gear > 0 && distance(at, centre) < gear + reach / 3;
    if (look?.kind === "bar") met ||= insideRounded(look.points.map((p) => toWorld(pose, p)), at, reach * 0.85);
    else if (look?.kind === "disc") met ||= distance(at, centre) < Math.max(look.radius, reach);
    else met ||= distance(at, look?.kind === "block" ? toWorld(pose, look.at) : centre) < 1.5 * reach;
    if (met) return { thing: { kind: "body", name: body.name }, end: null, body: body.name };
  }
  return null;
}

function insideRounded(points: readonly Point[], at: Point, radius: number): boolean {
  const corners = hull(points);
  const sides = corners.length > 2 ? corners.length : corners.length - 1;
  let inside = corners.length > 2;
  for (let i = 0; i < sides; i++) {
    const a = corners[i]!;
    const b = corners[(i + 1) % corners.length]!;
    if (distance(at, nearestOnSegment(at, a, b)) < radius) return true;
    if ((b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]) < 0) inside = false;
  }
  return inside;
}

function hitGuide(model: Model, looks: Looks, at: Point, reach: number, poses?: Poses): Hit | null {
  for (const guide of looks.guides) {
    const pose = poseOf(model, guide.on, poses);
    const p = toWorld(pose, guide.at);
    const angle = pose.angle + guide.axis;
    const half: Point = [guide.reach * Math.cos(angle), guide.reach * Math.sin(angle)];
    const near = nearestOnSegment(at, [p[0] - half[0], p[1] - half[1]], [p[0] + half[0], p[1] + half[1]]);
    if (distance(at, near) < 1.6 * reach) return { thing: { kind: "joint", name: guide.joint }, end: null, body: null };
  }
  return null;
}

/** Where a drawing tool's point snaps to: an existing point, a body, or the grid. */
export function snap(model: Model, looks: Looks, at: Point, reach: number, grid: number, poses?: Poses, free = false): Target {
  if (free) return { at, end: null, body: null };
  const end = nearestMarker(model, at, reach, poses);
  if (end) return { at: worldPoint(model, end, poses), end, body: end.body };
  const hit = hitBody(model, looks, at, reach * 0.6, poses);
  if (hit?.body) return { at: onAxis(model, hit.body, at, reach, poses), end: null, body: hit.body };
  const rounded: Point = [roundTo(at[0], grid), roundTo(at[1], grid)];
  // The grid point may coincide with an existing point.
  const there = nearestMarker(model, rounded, reach * 0.2, poses);
  return { at: rounded, end: there, body: there?.body ?? null };
}

// On a bar, the point snaps to its centre line.
function onAxis(model: Model, name: string, at: Point, reach: number, poses?: Poses): Point {
  const body = model.body.get(name);
  if (body?.markers.length !== 2) return at;
  const [a, b] = body.markers.map((marker) => toWorld(poseOf(model, name, poses), marker.at));
  const near = nearestOnSegment(at, a!, b!);
  return distance(near, at) < reach ? near : at;
}

function roundTo(value: number, step: number): number {
  return Number((Math.round(value / step) * step).toPrecision(12));
}

/** All bodies under a point: those that a pin between two bars joins. */
export function bodiesAt(model: Model, looks: Looks, at: Point, reach: number, poses?: Poses): string[] {
  return model.bodies
    .filter((body) => hitBody({ ...model, bodies: [body] }, looks, at, reach, poses) !== null)
    .map((body) => body.name)
    .reverse();
}

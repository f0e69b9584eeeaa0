// Moving points: every body at a point moves with it, and a drawn body keeps its axes at its centre of mass.
import { Draft } from "./edit";
import { type Point, type Pose, direction, distance, middle, toBody, toWorld } from "./geometry";
import { type Body, type End, GROUND, type Marker, type Model, type Poses, markerOf, poseOf, worldPoint } from "./model";
import { markerLiteral, sizeOf, writeMarker, writePose, writePoses } from "./placing";
import { FROM_SHAPE, massProperties, writeInertia, writeMass } from "./shape";

/** Joints that hold two points together; their markers move as one. */
const POINT_JOINTS = new Set(["revolute", "fixed"]);

/** All markers at the point of `end`, through pins and welds. */
export function markersAt(model: Model, end: End): End[] {
  const found = [end];
  for (let i = 0; i < found.length; i++) {
    const here = found[i]!;
    for (const joint of model.joints) {
      if (!POINT_JOINTS.has(joint.type)) continue;
      const other = same(joint.first, here) ? joint.second : same(joint.second, here) ? joint.first : null;
      if (other && !found.some((one) => same(one, other))) found.push(other);
    }
  }
  return found;
}

export function same(a: End, b: End): boolean {
  return a.body === b.body && a.marker === b.marker;
}

/** The data of a body whose markers are at given positions in the world. */
export interface Fit {
  pose: Pose;
  markers: { name: string; at: Point; axis: number; traced: boolean }[];
  mass: number;
  inertia: number;
}

/** Axes at the centroid of the shape, x along the first two markers. Bodies without a bar's shape keep their axes. */
export function fit(body: Body, pose: Pose, world: readonly Point[]): Fit {
  const bar = body.shape?.kind === "bar" || (body.shape === null && isBar(body));
  const angle = bar && world.length > 1 && distance(world[0]!, world[1]!) > 0 ? direction(world[0]!, world[1]!) : pose.angle;
  let centre: Point = [pose.x, pose.y];
  let { mass, inertia } = body;
  if (body.shape?.kind === "bar" && world.length > 0) {
    const shape = massProperties(body.shape, world);
    centre = shape.centroid;
    if (body.massFromShape) mass = shape.mass;
    if (body.inertiaFromShape) inertia = shape.inertia;
  } else if (bar) {
    centre = middle(world[0]!, world[1]!);
  }
  const axes = { x: centre[0], y: centre[1], angle };
  const markers = body.markers.map((marker, i) => ({
    name: marker.name,
    at: toBody(axes, world[i] ?? [0, 0]),
    axis: marker.axis === 0 && bar ? 0 : marker.axis + pose.angle - angle,
    traced: marker.traced,
  }));
  return { pose: axes, markers, mass, inertia };
}

// Two markers on either side of the centre of mass: a bar, whether or not its shape is known.
function isBar(body: Body): boolean {
  const [a, b] = body.markers;
  if (body.markers.length !== 2 || !a || !b) return false;
  const size = distance(a.at, b.at);
  return size > 0 && Math.hypot(a.at[0] + b.at[0], a.at[1] + b.at[1]) < 1e-6 * size;
}

/** If assembly has corrected a start pose by more than this fraction of the body's size, the pose is written, so that assembly starts close again. */
const GUESSED = 0.01;

// `pose` is the body's assembled pose before the change. What the fit has not changed is not written.
function writeFit(draft: Draft, body: Body, pose: Pose, fitted: Fit): void {
  const size = sizeOf(body, pose);
  const far = distance([pose.x, pose.y], [body.pose.x, body.pose.y]) > GUESSED * size || Math.abs(pose.angle - body.pose.angle) > GUESSED;
  const moved = fitted.pose.x !== pose.x || fitted.pose.y !== pose.y || fitted.pose.angle !== pose.angle;
  writePose(draft, body.name, fitted.pose, (body.stated ? far : moved) ? null : pose, size);
  if (body.massFromShape) draft.set(["body", body.name, "mass"], writeMass(fitted.mass));
  if (body.inertiaFromShape) draft.set(["body", body.name, "inertia"], writeInertia(fitted.inertia));
  fitted.markers.forEach((marker, i) => writeMarker(draft, ["body", body.name, "markers", marker.name], marker, body.markers[i] ?? null));
}

/** Moves the point at `end`, together with every body, and the ground, joined there. */
export function movePoint(model: Model, end: End, to: Point, poses?: Poses): string {
  const draft = new Draft(model.document);
  const group = markersAt(model, end);
  const byBody = new Map<string, Set<string>>();
  for (const one of group) byBody.set(one.body, (byBody.get(one.body) ?? new Set()).add(one.marker));
  for (const [name, markers] of byBody) {
    if (name === GROUND) {
      for (const marker of markers) moveGroundMarker(draft, model, marker, to);
      continue;
    }
    const body = model.body.get(name);
    if (!body) continue;
    const pose = poseOf(model, name, poses);
    const world = body.markers.map((marker) => (markers.has(marker.name) ? to : toWorld(pose, marker.at)));
    writeFit(draft, body, pose, fit(body, pose, world));
  }
  return draft.apply();
}

function moveGroundMarker(draft: Draft, model: Model, name: string, to: Point): void {
  const marker = markerOf(model, { body: GROUND, marker: name });
  writeMarker(draft, ["ground", "markers", name], { at: to, axis: marker?.axis ?? 0, traced: marker?.traced ?? false }, marker);
}

/** The body's own length between its first two markers. */
export function barLength(body: Body): number | null {
  const [a, b] = body.markers;
  return a && b ? distance(a.at, b.at) : null;
}

/** Gives a body's first two markers another distance; assembly closes what is attached to the second one. */
export function setBarLength(model: Model, name: string, length: number, poses?: Poses): string {
  const body = model.body.get(name);
  const [a, b] = body?.markers ?? [];
  if (!body || !a || !b) return model.document.text;
  const pose = poseOf(model, name, poses);
  const from = toWorld(pose, a.at);
  const angle = direction(from, toWorld(pose, b.at));
  const to: Point = [from[0] + length * Math.cos(angle), from[1] + length * Math.sin(angle)];
  const world = body.markers.map((marker) => (marker === b ? to : toWorld(pose, marker.at)));
  const draft = new Draft(model.document);
  writeFit(draft, body, pose, fit(body, pose, world));
  return draft.apply();
}

/** Rotates a body about its first marker, so that its first two markers have this angle. */
export function setBarAngle(model: Model, name: string, angle: number, poses?: Poses): string {
  const body = model.body.get(name);
  const [a, b] = body?.markers ?? [];
  if (!body || !a || !b) return model.document.text;
  const pose = poseOf(model, name, poses);
  const pivot = toWorld(pose, a.at);
  const turn = angle - direction(pivot, toWorld(pose, b.at));
  const c = Math.cos(turn);
  const s = Math.sin(turn);
  const dx = pose.x - pivot[0];
  const dy = pose.y - pivot[1];
  const draft = new Draft(model.document);
  writePose(draft, name, { x: pivot[0] + c * dx - s * dy, y: pivot[1] + s * dx + c * dy, angle: pose.angle + turn }, body.stated ? pose : null, sizeOf(body, pose));
  return draft.apply();
}

/** Recomputes mass, inertia and axes of a body from its shape, and marks the values derived from it. */
export function applyShape(draft: Draft, body: Body, pose: Pose): void {
  const shaped = { ...body, massFromShape: true, inertiaFromShape: true };
  if (!body.shape) return;
  const world = body.markers.map((marker) => toWorld(pose, marker.at));
  const fitted = fit(shaped, pose, world);
  const properties = massProperties(body.shape, world);
  writeFit(draft, { ...shaped, massFromShape: false, inertiaFromShape: false }, pose, fitted);
  draft.set(["body", body.name, "mass"], writeMass(properties.mass), FROM_SHAPE);
  draft.set(["body", body.name, "inertia"], writeInertia(properties.inertia), FROM_SHAPE);
}

/** Adds a marker at a point of the world to a body, and updates the mass of the body's shape. Returns the marker's literal position. */
export function addMarker(draft: Draft, model: Model, body: Body, name: string, at: Point, poses?: Poses): void {
  const pose = poseOf(model, body.name, poses);
  const marker: Marker = { name, at: toBody(pose, at), axis: 0, traced: false };
  const grown: Body = { ...body, markers: [...body.markers, marker] };
  if (body.shape?.kind === "bar" && body.massFromShape) {
    writeFit(draft, grown, pose, fit(grown, pose, grown.markers.map((one) => toWorld(pose, one.at))));
  } else {
    draft.set(["body", body.name, "markers", name], markerLiteral(marker.at, 0));
  }
}

/** The text with the poses of the dragged mechanism. */
export function keepPoses(model: Model, poses: Poses): string {
  const draft = new Draft(model.document);
  writePoses(draft, model, poses);
  return draft.apply();
}

/** Moves bodies (and the ground markers named) by a step. */
export function shiftThings(model: Model, bodies: readonly string[], markers: readonly string[], step: Point, poses?: Poses): string {
  const draft = new Draft(model.document);
  for (const name of bodies) {
    const pose = poseOf(model, name, poses);
    writePose(draft, name, { ...pose, x: pose.x + step[0], y: pose.y + step[1] }, model.body.get(name)?.stated ? pose : null);
  }
  for (const name of markers) {
    const [x, y] = worldPoint(model, { body: GROUND, marker: name });
    moveGroundMarker(draft, model, name, [x + step[0], y + step[1]]);
  }
  return draft.apply();
}

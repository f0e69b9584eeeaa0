// The mechanism described by a text: bodies, markers, joints and loads with their numbers. A view, rebuilt from every
// text; operations change the text.
import { type Scope, evaluate, namesIn } from "./expression";
import { type Point, type Pose, ORIGIN, toWorld } from "./geometry";
import { TRACE, remarkAt, remarkOf } from "./remarks";
import { FROM_SHAPE, type Shape, readShape } from "./shape";
import { type Document, type Node, type TableNode, nodeAt, parseToml } from "./toml";
import type { Dimension } from "./units";

export interface Marker {
  name: string;
  at: Point;
  axis: number;
  /** Its path is drawn. */
  traced: boolean;
}

export interface Body {
  name: string;
  mass: number;
  inertia: number;
  /** Absent entries are determined by assembly. */
  pose: Pose;
  stated: boolean;
  markers: Marker[];
  shape: Shape | null;
  massFromShape: boolean;
  inertiaFromShape: boolean;
  /** The position or angle contains names of parameters. */
  parametric: boolean;
}

export interface End {
  body: string;
  marker: string;
}

export interface Joint {
  name: string;
  type: string;
  first: End;
  second: End;
  law: string;
  /** Numbers of the joint itself: radii, radius, length. */
  radii: [number, number] | null;
  radius: number | null;
  /** Radii of a belt's discs, positive if the belt is on the left of the disc; 0 if it ends at the marker. */
  discs: [number, number];
  internal: boolean;
  /** Length of a cylinder's barrel; null for other types. */
  barrel: number | null;
  /** The blades of a flexure; none for other laws. */
  blades: Blade[];
  profile: Profile | null;
}

/** A blade in the axes of its two markers: the positions of its ends along its own direction, and that direction relative to the markers' axes. */
export interface Blade {
  length: number;
  angle: number;
  from: number;
  to: number;
}

/** The outline of a cam or a curved edge in the axes of the first marker, and its follower. */
export interface Profile {
  outline: Point[];
  /** Radius of the roller; null: a flat face. */
  roller: number | null;
}

export interface Spring {
  name: string;
  torsion: boolean;
  first: End;
  second: End;
  stiffness: number;
  damping: number;
}

export interface Load {
  name: string;
  on: End;
  force: Point;
  torque: number;
  bodyAxes: boolean;
  /** Depends on time. */
  varies: boolean;
}

export interface Motor {
  name: string;
  joint: string;
  kind: "effort" | "speed" | "position";
}

export interface Model {
  document: Document;
  name: string;
  gravity: Point;
  duration: number | null;
  parameters: Map<string, number>;
  ground: Marker[];
  bodies: Body[];
  joints: Joint[];
  springs: Spring[];
  loads: Load[];
  motors: Motor[];
  body: ReadonlyMap<string, Body>;
}

export const GROUND = "ground";

const TURN = 2 * Math.PI;
const PROFILE_POINTS = 180;

type Reading = (node: Node | undefined) => number | null;

export function readModel(source: string | Document): Model {
  const document = typeof source === "string" ? parseToml(source) : source;
  const { root } = document;
  const parameters = readParameters(document);
  const number: Reading = (node) => numberOf(node, (name) => parameters.get(name));
  const bodies = children(root, "body").map(([name, table]) => readBody(document, name, table, number, parameters));
  const gravity = point(root.entries.get("gravity"), number);
  return {
    document,
    name: textOf(root.entries.get("name")) ?? "",
    gravity: gravity ?? [0, -9.80665],
    duration: number(nodeAt(root, ["simulate", "duration"])),
    parameters,
    ground: readMarkers(document, nodeAt(root, ["ground", "markers"]), number),
    bodies,
    joints: children(root, "joint").map(([name, table]) => readJoint(name, table, number, parameters)),
    springs: [
      ...children(root, "spring").map(([name, table]) => readSpring(name, table, number, false)),
      ...children(root, "torsion_spring").map(([name, table]) => readSpring(name, table, number, true)),
    ],
    loads: children(root, "force").map(([name, table]) => readLoad(name, table, number, parameters)),
    motors: children(root, "motor").map(([name, table]) => readMotor(name, table)),
    body: new Map(bodies.map((body) => [body.name, body])),
  };
}

function tableAt(root: TableNode, key: string): TableNode | null {
  const found = root.entries.get(key);
  return found?.kind === "table" ? found : null;
}

function children(root: TableNode, key: string): [string, TableNode][] {
  return [...(tableAt(root, key)?.entries ?? [])].filter((entry): entry is [string, TableNode] => entry[1].kind === "table");
}

function textOf(node: Node | undefined): string | null {
  return node?.kind === "text" ? node.value : null;
}

// TOML has inf and nan, and an expression can divide by zero while it is being typed: neither can be drawn.
function numberOf(node: Node | undefined, scope: Scope, sizes?: Dimension): number | null {
  if (node?.kind === "number") return Number.isFinite(node.value) ? node.value : null;
  return node?.kind === "text" ? evaluate(node.value, scope, sizes) : null;
}

/** Values of a model's parameters, in SI or in units of other sizes. They may refer to each other in any order; one that refers to itself has no value. */
export function readParameters(document: Document, sizes?: Dimension): Map<string, number> {
  const table = tableAt(document.root, "parameters");
  const values = new Map<string, number>();
  const open = new Set<string>();
  const find = (name: string): number | undefined => {
    const known = values.get(name);
    if (known !== undefined || open.has(name)) return known;
    const node = table?.entries.get(name);
    open.add(name);
    const value = numberOf(node, find, sizes);
    open.delete(name);
    if (value === null) return undefined;
    values.set(name, value);
    return value;
  };
  for (const name of table?.entries.keys() ?? []) find(name);
  return values;
}

function point(node: Node | undefined, number: Reading): Point | null {
  if (node?.kind !== "list" || node.items.length < 2) return null;
  const x = number(node.items[0]);
  const y = number(node.items[1]);
  return x === null || y === null ? null : [x, y];
}

function readMarkers(document: Document, node: Node | undefined, number: Reading): Marker[] {
  if (node?.kind !== "table") return [];
  return [...node.entries].map(([name, value]) => readMarker(document, name, value, number));
}

function readMarker(document: Document, name: string, node: Node, number: Reading): Marker {
  const traced = remarkOf(document, node) === TRACE;
  if (node.kind === "list") {
    const at = point(node, number) ?? [0, 0];
    return { name, at, axis: number(node.items[2]) ?? 0, traced };
  }
  if (node.kind !== "table") return { name, at: [0, 0], axis: 0, traced };
  const part = (key: string) => number(node.entries.get(key));
  const axis = part("axis") ?? 0;
  const r = part("r");
  if (r === null) return { name, at: [part("x") ?? 0, part("y") ?? 0], axis, traced };
  const xi = part("xi") ?? 0;
  return { name, at: [r * Math.cos(xi), r * Math.sin(xi)], axis, traced };
}

function readBody(document: Document, name: string, table: TableNode, number: Reading, parameters: Map<string, number>): Body {
  const position = point(table.entries.get("position"), number);
  const angle = number(table.entries.get("angle"));
  const header = table.form === "header" ? remarkAt(document, table.to) : "";
  const known = new Set(parameters.keys());
  const named = (node: Node | undefined): boolean =>
    node?.kind === "list" ? node.items.some(named) : node?.kind === "text" && namesIn(node.value, known).length > 0;
  return {
    name,
    mass: number(table.entries.get("mass")) ?? 0,
    inertia: number(table.entries.get("inertia")) ?? 0,
    pose: { x: position?.[0] ?? 0, y: position?.[1] ?? 0, angle: angle ?? 0 },
    stated: position !== null && angle !== null,
    markers: readMarkers(document, table.entries.get("markers"), number),
    shape: readShape(header),
    massFromShape: remarkOf(document, table.entries.get("mass")) === FROM_SHAPE,
    inertiaFromShape: remarkOf(document, table.entries.get("inertia")) === FROM_SHAPE,
    parametric: named(table.entries.get("position")) || named(table.entries.get("angle")),
  };
}

function endOf(node: Node | undefined): End {
  const [body = "", marker = ""] = (textOf(node) ?? "").split(".");
  return { body, marker };
}

function ends(table: TableNode): { first: End; second: End } {
  const between = table.entries.get("between");
  const items = between?.kind === "list" ? between.items : [];
  return { first: endOf(items[0]), second: endOf(items[1]) };
}

function readJoint(name: string, table: TableNode, number: Reading, parameters: Map<string, number>): Joint {
  return {
    name,
    type: textOf(table.entries.get("type")) ?? "",
    ...ends(table),
    law: textOf(table.entries.get("law")) ?? "linear",
    radii: point(table.entries.get("radii"), number) as [number, number] | null,
    radius: number(table.entries.get("radius")),
    discs: textOf(table.entries.get("type")) === "belt" ? readDiscs(table, number) : [0, 0],
    internal: textOf(table.entries.get("mesh")) === "internal",
    barrel: textOf(table.entries.get("type")) === "cylinder" ? barrelLength(number(table.entries.get("closed_length")) ?? 0, number(table.entries.get("stroke")) ?? 0) : null,
    blades: readBlades(table, number),
    profile: readProfile(table, number, parameters),
  };
}

// The piston stays inside the barrel at both ends of the stroke, as far as a single stage allows.
function barrelLength(closedLength: number, stroke: number): number {
  return Math.min(Math.max((closedLength + stroke) / 2, 0.93 * closedLength), closedLength);
}

// Radii for a belt: positive if the belt is on the left of the disc.
function readDiscs(table: TableNode, number: Reading): [number, number] {
  const [first, second] = ["first", "second"].map((end) => ({ radius: number(table.entries.get(`${end}_radius`)) ?? 0, side: textOf(table.entries.get(`${end}_side`)) }));
  const signed = (radius: number, side: string | null | undefined) => (side === "right" ? -radius : radius);
  return [signed(first?.radius ?? 0, first?.side), signed(second?.radius ?? 0, second?.side ?? first?.side)];
}

function readBlades(table: TableNode, number: Reading): Blade[] {
  const law = textOf(table.entries.get("law"));
  const length = number(table.entries.get("length")) ?? 0;
  if (law === "leaf-spring") return [{ length, angle: 0, from: 0, to: 0 }];
  if (law !== "cross-spring") return [];
  const half = (number(table.entries.get("crossing_angle")) ?? Math.PI / 2) / 2;
  const crossing = number(table.entries.get("crossing")) ?? 0.5;
  return [half, -half].map((angle) => ({ length, angle, from: -crossing * length, to: (1 - crossing) * length }));
}

function readProfile(table: TableNode, number: Reading, parameters: Map<string, number>): Profile | null {
  const type = textOf(table.entries.get("type"));
  return type === "cam" ? readCam(table, number, parameters) : type === "edge" ? readEdge(table, number, parameters) : null;
}

// A band below the edge; the height from a table is not known here and counts as 0.
function readEdge(table: TableNode, number: Reading, parameters: Map<string, number>): Profile {
  const [from, to] = [number(table.entries.get("from")) ?? 0, number(table.entries.get("to")) ?? 0];
  const thick = 0.02 * (to - from);
  const edge = Array.from({ length: PROFILE_POINTS + 1 }, (_, i): Point => {
    const x = from + ((to - from) * i) / PROFILE_POINTS;
    return [x, numberOf(table.entries.get("height"), (word) => (word === "x" ? x : parameters.get(word))) ?? 0];
  });
  return { outline: [...edge, ...edge.map(([x, y]): Point => [x, y - thick]).reverse()], roller: number(table.entries.get("roller_radius")) ?? 0 };
}

// As in the kernel (docs/theory/cams.md); the lift from a table is not known here and counts as 0.
function readCam(table: TableNode, number: Reading, parameters: Map<string, number>): Profile {
  const flat = textOf(table.entries.get("follower")) === "flat";
  const roller = flat ? 0 : (number(table.entries.get("roller_radius")) ?? 0);
  const base = number(table.entries.get("base_radius")) ?? 0;
  const radius = (angle: number) => base + roller + (numberOf(table.entries.get("lift"), (word) => (word === "angle" ? ((angle % TURN) + TURN) % TURN : parameters.get(word))) ?? 0);
  const outline = Array.from({ length: PROFILE_POINTS }, (_, i): Point => {
    const angle = (TURN * i) / PROFILE_POINTS, d = 1e-5;
    const r = radius(angle), slope = (radius(angle + d) - radius(angle - d)) / (2 * d);
    const [ux, uy] = [Math.cos(angle), Math.sin(angle)];
    if (flat) return [r * ux - slope * uy, r * uy + slope * ux];
    const [px, py] = [slope * ux - r * uy, slope * uy + r * ux];
    const length = Math.hypot(px, py) || 1;
    return [r * ux - (roller * py) / length, r * uy + (roller * px) / length];
  });
  return { outline, roller: flat ? null : roller };
}

function readSpring(name: string, table: TableNode, number: Reading, torsion: boolean): Spring {
  return {
    name,
    torsion,
    ...ends(table),
    stiffness: number(table.entries.get("stiffness")) ?? 0,
    damping: number(table.entries.get("damping")) ?? 0,
  };
}

function readLoad(name: string, table: TableNode, number: Reading, parameters: Map<string, number>): Load {
  const at = (t: number): Reading => (node) => numberOf(node, (word) => (word === "t" ? t : parameters.get(word)));
  const force = table.entries.get("force");
  const now = point(force, at(0)) ?? [0, 0];
  const later = point(force, at(0.1234)) ?? now;
  return {
    name,
    on: endOf(table.entries.get("on")),
    force: now,
    torque: at(0)(table.entries.get("torque")) ?? 0,
    bodyAxes: textOf(table.entries.get("axes")) === "body",
    varies: now[0] !== later[0] || now[1] !== later[1],
  };
}

function readMotor(name: string, table: TableNode): Motor {
  const kind = table.entries.has("speed") ? "speed" : table.entries.has("position") ? "position" : "effort";
  return { name, joint: textOf(table.entries.get("joint")) ?? "", kind };
}

/** Start poses by body; assembled poses take precedence over those stated in the text. */
export type Poses = ReadonlyMap<string, Pose>;

export function poseOf(model: Model, name: string, poses?: Poses): Pose {
  if (name === GROUND) return ORIGIN;
  return poses?.get(name) ?? model.body.get(name)?.pose ?? ORIGIN;
}

export function markerOf(model: Model, end: End): Marker | null {
  const list = end.body === GROUND ? model.ground : (model.body.get(end.body)?.markers ?? []);
  return list.find((marker) => marker.name === end.marker) ?? null;
}

export function worldPoint(model: Model, end: End, poses?: Poses): Point {
  return toWorld(poseOf(model, end.body, poses), markerOf(model, end)?.at ?? [0, 0]);
}

/** Radius of an outer gear: from its shape, or from its mesh. */
export function gearRadius(model: Model, { name, shape, markers }: Body): number | null {
  if (markers.length === 0) return null;
  if (shape) return shape.kind === "disc" ? shape.width / 2 : null;
  for (const { radii, internal, first, second } of model.joints) {
    const radius = first.body === name && !internal ? radii?.[0] : second.body === name ? radii?.[1] : undefined;
    if (radius) return radius;
  }
  return null;
}

/** Extent of the mechanism, from which the sizes of symbols and grids are chosen. */
export function extent(model: Model, poses?: Poses): { min: Point; max: Point; size: number } {
  const points: Point[] = model.ground.map((marker) => marker.at);
  for (const body of model.bodies) {
    const pose = poseOf(model, body.name, poses);
    points.push([pose.x, pose.y], ...body.markers.map((marker) => toWorld(pose, marker.at)));
  }
  for (const joint of model.joints) {
    for (const [end, radius] of [[joint.first, joint.radii?.[0] ?? joint.radius], [joint.second, joint.radii?.[1]]] as const) {
      if (!radius) continue;
      const [x, y] = worldPoint(model, end, poses);
      points.push([x - radius, y - radius], [x + radius, y + radius]);
    }
  }
  if (points.length === 0) return { min: [-0.15, -0.1], max: [0.15, 0.1], size: 0.3 };
  const min: Point = [Math.min(...points.map((p) => p[0])), Math.min(...points.map((p) => p[1]))];
  const max: Point = [Math.max(...points.map((p) => p[0])), Math.max(...points.map((p) => p[1]))];
  return { min, max, size: Math.max(max[0] - min[0], max[1] - min[1], 1e-3) };
}

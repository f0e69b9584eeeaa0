// What the tools draw, as edits of the text. Each operation is one undo step; it returns the new text and the things it created.
import { Draft, type Literal, unfolded } from "./edit";
import { type Point, type Pose, direction, distance, middle, toBody } from "./geometry";
import { type Body, type End, GROUND, type Model, type Poses, gearRadius, markerOf, poseOf, readModel, worldPoint } from "./model";
import { type Kind, countedName, lettersOf, namesOf, nextLetter } from "./names";
import { markerLiteral } from "./placing";
import { addMarker, applyShape } from "./reshape";
import { TRACE } from "./remarks";
import { FROM_SHAPE, type Shape, likelyBar, massProperties, niceSize, writeInertia, writeMass, writeShape } from "./shape";
import { writeAngle, writeLength, writeLengths } from "./units";

/** What a click hit: a point of the world; a marker there, or a body without a marker, or neither. */
export interface Target {
  at: Point;
  end: End | null;
  body: string | null;
}

export interface Thing {
  kind: Kind | "marker" | "ground";
  name: string;
}

export interface Made {
  text: string;
  made: Thing[];
}

/** Collects a drawing step: the draft, and the names it has already used. */
class Step {
  readonly draft: Draft;
  readonly made: Thing[] = [];
  private readonly letters: Set<string>;
  private readonly taken = new Map<Kind, Set<string>>();

  constructor(
    readonly model: Model,
    readonly poses?: Poses,
  ) {
    this.draft = new Draft(model.document);
    this.letters = lettersOf(model);
    if (!model.document.root.entries.has("format")) this.draft.set(["format"], 1);
  }

  letter(): string {
    const letter = nextLetter(this.letters);
    this.letters.add(letter);
    return letter;
  }

  name(kind: Kind, word: string): string {
    const taken = this.taken.get(kind) ?? namesOf(this.model, kind);
    this.taken.set(kind, taken);
    const name = /^[A-Z]\d*$/.test(word) && !taken.has(word) ? word : countedName(word.replace(/\d+$/, ""), taken);
    taken.add(name);
    return name;
  }

  /** The marker at a target, created if there is none. Bodies created by this step are not in the model: they have their own markers. */
  end(target: Target, letter?: string): End {
    if (target.end) return target.end;
    const marker = letter ?? this.letter();
    const body = target.body ? this.model.body.get(target.body) : undefined;
    if (body) addMarker(this.draft, this.model, body, marker, target.at, this.poses);
    else this.draft.set(["ground", "markers", marker], markerLiteral(target.at, 0));
    return { body: body?.name ?? GROUND, marker };
  }

  body(word: string, pose: Pose, shape: Shape, points: readonly Point[], markers: readonly { name: string; at: Point; axis?: number }[]): string {
    const name = this.name("body", word);
    const { mass, inertia } = massProperties(shape, points);
    const path = ["body", name];
    this.draft.set([...path, "mass"], writeMass(mass), FROM_SHAPE);
    this.draft.set([...path, "inertia"], writeInertia(inertia), FROM_SHAPE);
    this.draft.set([...path, "position"], writeLengths([pose.x, pose.y]));
    this.draft.set([...path, "angle"], writeAngle(pose.angle));
    for (const marker of markers) this.draft.set([...path, "markers", marker.name], markerLiteral(marker.at, marker.axis ?? 0));
    this.draft.shape(name, writeShape(shape));
    this.made.push({ kind: "body", name });
    return name;
  }

  joint(type: string, first: End, second: End, word: string, more: Record<string, Literal> = {}): string {
    const name = this.name("joint", word);
    const path = ["joint", name];
    this.draft.set([...path, "type"], type);
    this.draft.set([...path, "between"], [`${first.body}.${first.marker}`, `${second.body}.${second.marker}`]);
    for (const [key, value] of Object.entries(more)) this.draft.set([...path, key], value);
    this.made.push({ kind: "joint", name });
    return name;
  }

  done(): Made {
    return { text: this.draft.apply(), made: this.made };
  }
}

/** A bar from point to point; if an end meets something, a pin joins them. */
export function addBar(model: Model, from: Target, to: Target, poses?: Poses, shape?: Shape): Made {
  const step = new Step(model, poses);
  const length = distance(from.at, to.at);
  const form = shape ?? likelyBar(length);
  const centre = middle(from.at, to.at);
  const pose = { x: centre[0], y: centre[1], angle: direction(from.at, to.at) };
  const names = [from, to].map((target) => (target.end ? free(target.end.marker, step) : step.letter()));
  if (names[0] === names[1]) names[1] = step.letter();
  const [a, b] = names as [string, string];
  const body = step.body("link", pose, form, [from.at, to.at], [
    { name: a, at: [-length / 2, 0] },
    { name: b, at: [length / 2, 0] },
  ]);
  step.made.splice(0, step.made.length, { kind: "body", name: body });
  for (const [target, marker] of [[from, a], [to, b]] as const) {
    if (target.end || target.body) step.joint("revolute", step.end(target, marker), { body, marker }, marker);
  }
  return { text: step.draft.apply(), made: [{ kind: "body", name: body }] };
}

// A point keeps its letter in all bodies that meet there.
function free(letter: string, step: Step): string {
  return /^[A-Za-z]\w*$/.test(letter) ? letter : step.letter();
}

/** A plate through three or more points. */
export function addPlate(model: Model, targets: readonly Target[], poses?: Poses): Made {
  const step = new Step(model, poses);
  const points = targets.map((target) => target.at);
  const longest = Math.max(...points.map((p) => distance(p, points[0]!)));
  const shape = likelyBar(longest);
  const { centroid } = massProperties(shape, points);
  const pose = { x: centroid[0], y: centroid[1], angle: direction(points[0]!, points[1]!) };
  const letters: string[] = [];
  for (const target of targets) {
    const letter = target.end ? free(target.end.marker, step) : step.letter();
    letters.push(letters.includes(letter) ? step.letter() : letter);
  }
  const body = step.body("plate", pose, shape, points, points.map((at, i) => ({ name: letters[i]!, at: toBody(pose, at) })));
  targets.forEach((target, i) => {
    const marker = letters[i]!;
    if (target.end || target.body) step.joint("revolute", step.end(target, marker), { body, marker }, marker);
  });
  return { text: step.draft.apply(), made: [{ kind: "body", name: body }] };
}

/** Joins the two bodies at a point, or a body and the ground, by a pin or a weld. */
export function addPin(model: Model, first: Target, second: Target, type: "revolute" | "fixed", poses?: Poses): Made {
  const step = new Step(model, poses);
  const letter = (first.end ?? second.end)?.marker ?? step.letter();
  const a = step.end(first, letter);
  const b = step.end(second, letter);
  step.joint(type, a, b, type === "fixed" ? "weld" : letter);
  return step.done();
}

/** Pins a point of a body to the ground at its present position. */
export function addGroundPin(model: Model, target: Target, type: "revolute" | "fixed", poses?: Poses): Made {
  const step = new Step(model, poses);
  const letter = target.end?.marker ?? step.letter();
  const taken = new Set(model.ground.map((marker) => marker.name));
  const marker = taken.has(letter) ? step.letter() : letter;
  step.draft.set(["ground", "markers", marker], markerLiteral(target.at, 0));
  const end = step.end(target, letter);
  step.joint(type, { body: GROUND, marker }, end, type === "fixed" ? "weld" : letter);
  return step.done();
}

/** A block that slides along an axis through the point, on the ground or on a body; pinned to the body of the point. */
export function addSlider(model: Model, target: Target, axis: number, on: string, size: number, poses?: Poses): Made {
  const step = new Step(model, poses);
  const width = niceSize(size / 8);
  const shape: Shape = { kind: "block", width, height: niceSize(width * 0.6), thickness: niceSize(width / 2), material: "steel" };
  const pin = target.end?.marker ?? step.letter();
  const body = step.body("slider", { x: target.at[0], y: target.at[1], angle: axis }, shape, [], [{ name: pin, at: [0, 0] }]);
  const guide = addGuide(step, model, target.at, axis, on, poses);
  if (target.end || target.body) step.joint("revolute", step.end(target, pin), { body, marker: pin }, pin);
  step.joint("prismatic", guide, { body, marker: pin }, "guide");
  return step.done();
}

function addGuide(step: Step, model: Model, at: Point, axis: number, on: string, poses?: Poses): End {
  const carrier = model.body.get(on);
  const marker = countedName("guide", new Set((carrier ? carrier.markers : model.ground).map((one) => one.name)));
  if (!carrier) step.draft.set(["ground", "markers", marker], markerLiteral(at, axis));
  else {
    const pose = poseOf(model, on, poses);
    step.draft.set(["body", on, "markers", marker], markerLiteral(toBody(pose, at), axis - pose.angle));
  }
  return { body: carrier ? on : GROUND, marker };
}

/** The point moves in a straight slot of the ground or of a body. */
export function addSlot(model: Model, pin: Target, axis: number, on: string, poses?: Poses): Made {
  const step = new Step(model, poses);
  const guide = addGuide(step, model, pin.at, axis, on, poses);
  step.joint("slot", guide, step.end(pin), "slot");
  return step.done();
}

/** A disc on a pin at its centre; it becomes a gear when it meshes. */
export function addDisc(model: Model, centre: Target, radius: number, mesh: string | null, poses?: Poses): Made {
  const step = new Step(model, poses);
  const shape: Shape = { kind: "disc", width: 2 * radius, height: 2 * radius, thickness: niceSize(radius / 4), material: "steel" };
  const letter = centre.end ? free(centre.end.marker, step) : step.letter();
  const body = step.body("gear", { x: centre.at[0], y: centre.at[1], angle: 0 }, shape, [], [{ name: letter, at: [0, 0] }]);
  const home = centre.end || centre.body ? step.end(centre, letter) : step.end({ ...centre, body: null }, letter);
  step.joint("revolute", home, { body, marker: letter }, letter);
  const other = mesh ? model.body.get(mesh) : undefined;
  const otherMarker = other?.markers[0];
  if (other?.shape && otherMarker) {
    step.joint("gear", { body: other.name, marker: otherMarker.name }, { body, marker: letter }, "mesh", {
      radii: [writeLength(other.shape.width / 2), writeLength(radius)],
    });
  }
  return step.done();
}

/** Brings two existing gears into mesh; their radii add up to the distance, in the ratio of their sizes. */
export function addMesh(model: Model, first: Body, second: Body, poses?: Poses): Made {
  const [a, b] = [first, second].map((body): End => ({ body: body.name, marker: body.markers[0]?.name ?? "" })) as [End, End];
  const step = new Step(model, poses);
  const gap = distance(worldPoint(model, a, poses), worldPoint(model, b, poses));
  const share = gearRadius(model, first)! / (gearRadius(model, first)! + gearRadius(model, second)!);
  const radii = [gap * share, gap * (1 - share)];
  step.joint("gear", a, b, "mesh", { radii: writeLengths(radii) });
  [first, second].forEach((body, i) => {
    if (!body.shape) return;
    const shape = { ...body.shape, width: 2 * radii[i]!, height: 2 * radii[i]! };
    step.draft.shape(body.name, writeShape(shape));
    if (body.massFromShape && body.inertiaFromShape) applyShape(step.draft, { ...body, shape }, poseOf(model, body.name, poses));
  });
  return step.done();
}

/** Why two bodies cannot be meshed; empty if they can. */
export function meshFault(model: Model, first: Body, second: Body, poses?: Poses): string {
  const none = [first, second].find((body) => gearRadius(model, body) === null);
  if (none) return `${none.name} is not a gear.`;
  if (model.joints.some((one) => one.type === "gear" && [one.first.body, one.second.body].sort().join() === [first.name, second.name].sort().join())) return `${first.name} and ${second.name} are already in mesh.`;
  const [a, b] = [first, second].map((body) => worldPoint(model, { body: body.name, marker: body.markers[0]!.name }, poses)) as [Point, Point];
  return distance(a, b) > 0 ? "" : "Both gears have the same centre.";
}

export type Connector = "spring" | "damper" | "rod" | "rope";

/** A spring, damper, massless rod or rope between two points. */
export function addConnector(model: Model, kind: Connector, from: Target, to: Target, poses?: Poses): Made {
  const step = new Step(model, poses);
  const a = step.end(from);
  const b = step.end(to);
  if (kind === "rod" || kind === "rope") {
    step.joint(kind, a, b, kind);
    return step.done();
  }
  const name = step.name("spring", kind);
  const mass = Math.max(0.1, ...[a, b].map((end) => model.body.get(end.body)?.mass ?? 0));
  const path = ["spring", name];
  step.draft.set([...path, "between"], [`${a.body}.${a.marker}`, `${b.body}.${b.marker}`]);
  // Oscillates at about two hertz with the heavier body, with a damping ratio of about a tenth.
  if (kind === "spring") step.draft.set([...path, "stiffness"], `${niceSize(mass * 150)} N/m`);
  step.draft.set([...path, "damping"], `${niceSize(mass * (kind === "spring" ? 2.5 : 25))} N*s/m`);
  return { text: step.draft.apply(), made: [{ kind: "spring", name }] };
}

export function addTorsionSpring(model: Model, joint: string): Made {
  const step = new Step(model);
  const found = model.joints.find((one) => one.name === joint);
  if (!found) return { text: model.document.text, made: [] };
  const name = step.name("torsion_spring", "coil");
  const path = ["torsion_spring", name];
  const inertia = model.body.get(found.second.body)?.inertia ?? 0.01;
  step.draft.set([...path, "between"], [`${found.first.body}.${found.first.marker}`, `${found.second.body}.${found.second.marker}`]);
  step.draft.set([...path, "stiffness"], `${niceSize(inertia * 150)} N*m/rad`);
  step.draft.set([...path, "damping"], `${niceSize(inertia * 2.5)} N*m*s/rad`);
  return { text: step.draft.apply(), made: [{ kind: "torsion_spring", name }] };
}

/** A motor for the angle or slide that a joint leaves free, at constant speed. */
export function addMotor(model: Model, joint: string): Made {
  const step = new Step(model);
  const found = model.joints.find((one) => one.name === joint);
  const name = step.name("motor", "motor");
  const slides = found?.type === "prismatic" || found?.type === "slot";
  step.draft.set(["motor", name, "joint"], joint);
  if (slides) {
    const size = Math.max(...model.bodies.map((body) => Math.hypot(...(body.markers[0]?.at ?? [0, 0]))), 0.05);
    step.draft.set(["motor", name, "speed"], `${niceSize(size)} m/s`);
  } else step.draft.set(["motor", name, "speed"], "60 rpm");
  return { text: step.draft.apply(), made: [{ kind: "motor", name }] };
}

/** A force at a point of a body, along world axes; or a torque. */
export function addForce(model: Model, target: Target, force: Point | null, torque = 0, poses?: Poses): Made {
  const step = new Step(model, poses);
  const on = step.end(target);
  const name = step.name("force", force ? "force" : "torque");
  step.draft.set(["force", name, "on"], `${on.body}.${on.marker}`);
  if (force) step.draft.set(["force", name, "force"], force.map((part) => (part ? `${Number(part.toPrecision(4))} N` : 0)));
  else step.draft.set(["force", name, "torque"], `${torque} N*m`);
  return { text: step.draft.apply(), made: [{ kind: "force", name }] };
}

/** Turns the trace of a point on or off; a point of a body without a marker gets one. */
export function toggleTrace(model: Model, target: Target, poses?: Poses): Made {
  const { end } = target;
  if (!end && target.body) {
    const step = new Step(readModel(unfolded(model.document.text, ["body", target.body, "markers", ""])), poses);
    const marker = step.letter();
    step.draft.set(["body", target.body, "markers", marker], markerLiteral(toBody(poseOf(model, target.body, poses), target.at), 0), TRACE);
    return step.done();
  }
  if (!end || end.body === GROUND) return { text: model.document.text, made: [] };
  const path = ["body", end.body, "markers", end.marker];
  const draft = new Draft(unfolded(model.document.text, path));
  draft.remark(path, markerOf(model, end)?.traced ? "" : TRACE);
  return { text: draft.apply(), made: [] };
}

/** A new model: what the file requires and a duration, so that it runs as soon as something is drawn. */
export const EMPTY_MODEL = `format = 1
name = "Untitled"

[simulate]
duration = "2 s"
`;

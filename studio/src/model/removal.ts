// Deleting, renaming, copying and pasting: operations that follow references through the model.
import { Draft, writeLiteral } from "./edit";
import { type Point } from "./geometry";
import { type Body, type End, GROUND, type Model, type Poses, gearRadius, poseOf, readModel } from "./model";
import { type Kind, freshName, namesOf } from "./names";
import type { Made, Thing } from "./operations";
import { TRACE } from "./remarks";
import { FROM_SHAPE, type Shape, niceSize, writeShape } from "./shape";
import { nodeAt, parseToml, plain, writeKey } from "./toml";
import { writeAngle, writeLengths } from "./units";

/** Removes things, together with everything that cannot exist without them. */
export function removeThings(model: Model, things: readonly Thing[]): string {
  const gone = closure(model, things);
  const draft = new Draft(model.document);
  for (const { kind, name } of gone) {
    if (kind === "marker") {
      const [body = "", marker = ""] = name.split(".");
      draft.remove(body === GROUND ? ["ground", "markers", marker] : ["body", body, "markers", marker]);
    } else if (kind !== "ground") draft.remove([kind, name]);
  }
  for (const marker of idleGroundMarkers(model, gone)) draft.remove(["ground", "markers", marker]);
  return draft.apply();
}

// Whatever refers to something removed is removed too.
function closure(model: Model, things: readonly Thing[]): Thing[] {
  const gone: Thing[] = [];
  const add = (kind: Thing["kind"], name: string) => {
    if (gone.some((one) => one.kind === kind && one.name === name)) return;
    gone.push({ kind, name });
    if (kind === "joint") for (const motor of model.motors) if (motor.joint === name) add("motor", motor.name);
    if (kind === "body" || kind === "marker") for (const [user, userName] of users(model, kind, name)) add(user, userName);
  };
  for (const thing of things) add(thing.kind, thing.name);
  return gone;
}

function users(model: Model, kind: "body" | "marker", name: string): [Kind, string][] {
  const met = (end: End) => (kind === "body" ? end.body === name : `${end.body}.${end.marker}` === name);
  return [
    ...model.joints.filter((one) => met(one.first) || met(one.second)).map((one): [Kind, string] => ["joint", one.name]),
    ...model.springs
      .filter((one) => met(one.first) || met(one.second))
      .map((one): [Kind, string] => [one.torsion ? "torsion_spring" : "spring", one.name]),
    ...model.loads.filter((one) => met(one.on)).map((one): [Kind, string] => ["force", one.name]),
  ];
}

// Ground markers used only by the removed joints.
function idleGroundMarkers(model: Model, gone: readonly Thing[]): string[] {
  const isGone = (kind: string, name: string) => gone.some((one) => one.kind === kind && one.name === name);
  const used = (end: End, kept: boolean, set: Set<string>) => {
    if (end.body === GROUND && kept) set.add(end.marker);
  };
  const before = new Set<string>();
  const after = new Set<string>();
  const count = (kind: string, name: string, ends: readonly End[]) => {
    for (const end of ends) {
      used(end, true, before);
      used(end, !isGone(kind, name), after);
    }
  };
  for (const joint of model.joints) count("joint", joint.name, [joint.first, joint.second]);
  for (const spring of model.springs) count(spring.torsion ? "torsion_spring" : "spring", spring.name, [spring.first, spring.second]);
  return [...before].filter((marker) => !after.has(marker) && !isGone("marker", `${GROUND}.${marker}`));
}

/** Renames a thing, and updates all references to it. */
export function renameThing(model: Model, kind: Kind, from: string, to: string): string {
  const draft = new Draft(model.document);
  draft.rename([kind, from], to);
  if (kind === "joint") for (const motor of model.motors) if (motor.joint === from) draft.set(["motor", motor.name, "joint"], to);
  if (kind === "body") renameEnds(draft, model, (end) => (end.body === from ? { ...end, body: to } : end));
  return draft.apply();
}

function renameEnds(draft: Draft, model: Model, change: (end: End) => End): void {
  const pair = (path: string[], first: End, second: End) => {
    const ends = [change(first), change(second)];
    if (ends[0] !== first || ends[1] !== second) draft.set(path, ends.map((end) => `${end.body}.${end.marker}`));
  };
  for (const joint of model.joints) pair(["joint", joint.name, "between"], joint.first, joint.second);
  for (const spring of model.springs) pair([spring.torsion ? "torsion_spring" : "spring", spring.name, "between"], spring.first, spring.second);
  for (const load of model.loads) {
    const end = change(load.on);
    if (end !== load.on) draft.set(["force", load.name, "on"], `${end.body}.${end.marker}`);
  }
}

/** The selected bodies and everything between them, as a text that can be pasted here or elsewhere. */
export function copyThings(model: Model, things: readonly Thing[], poses?: Poses): string {
  const bodies = new Set(things.filter((one) => one.kind === "body").map((one) => one.name));
  const inside = (end: End) => end.body === GROUND || bodies.has(end.body);
  const among = (one: { first: End; second: End }) => inside(one.first) && inside(one.second) && (bodies.has(one.first.body) || bodies.has(one.second.body));
  const joints = model.joints.filter(among);
  const paths = [
    ...[...bodies].map((name) => ["body", name]),
    ...joints.map((one) => ["joint", one.name]),
    ...model.springs.filter(among).map((one) => [one.torsion ? "torsion_spring" : "spring", one.name]),
    ...model.loads.filter((one) => bodies.has(one.on.body)).map((one) => ["force", one.name]),
    ...model.motors.filter((one) => joints.some((joint) => joint.name === one.joint)).map((one) => ["motor", one.name]),
  ];
  const lines: string[] = ["# copied from Pintle Studio"];
  const markers = new Set(joints.flatMap((one) => [one.first, one.second]).filter((end) => end.body === GROUND).map((end) => end.marker));
  for (const spring of model.springs.filter(among)) for (const end of [spring.first, spring.second]) if (end.body === GROUND) markers.add(end.marker);
  if (markers.size > 0) {
    lines.push("[ground.markers]");
    for (const name of markers) {
      const marker = model.ground.find((one) => one.name === name);
      if (marker) lines.push(`${writeKey(name)} = ${writeLiteral([marker.at[0], marker.at[1], marker.axis])}`);
    }
  }
  for (const path of paths) {
    const node = nodeAt(model.document.root, path);
    if (node?.kind !== "table") continue;
    const body = path[0] === "body" ? model.body.get(path[1]!) : undefined;
    const shape = body && (body.shape ?? gearShape(model, body));
    lines.push("", `[${path.map(writeKey).join(".")}]${behind(shape ? writeShape(shape) : "")}`);
    for (const [key, value] of node.entries) {
      if (body && (key === "position" || key === "angle" || key === "markers")) continue;
      const fromShape = (key === "mass" && body?.massFromShape) || (key === "inertia" && body?.inertiaFromShape);
      lines.push(`${writeKey(key)} = ${writeLiteral(plain(value))}${behind(fromShape ? FROM_SHAPE : "")}`);
    }
    if (!body) continue;
    const pose = poseOf(model, body.name, poses);
    lines.push(`position = ${writeLiteral(writeLengths([pose.x, pose.y]))}`, `angle = ${writeLiteral(writeAngle(pose.angle))}`);
    for (const marker of body.markers) lines.push(`markers.${writeKey(marker.name)} = ${writeLiteral([marker.at[0], marker.at[1], marker.axis])}${behind(marker.traced ? TRACE : "")}`);
  }
  return lines.join("\n") + "\n";
}

const behind = (remark: string): string => (remark ? `  # ${remark}` : "");

// A gear without a shape gets its size from its mesh, which may not be copied with it.
function gearShape(model: Model, body: Body): Shape | null {
  const radius = gearRadius(model, body);
  return radius === null ? null : { kind: "disc", width: 2 * radius, height: 2 * radius, thickness: niceSize(radius / 4), material: "steel" };
}

/** Adds what was copied, shifted by `step`, under unused names. */
export function pasteThings(model: Model, copied: string, step: Point): Made {
  const source = parseToml(copied);
  const draft = new Draft(model.document);
  const made: Thing[] = [];
  const tables = (kind: string) => {
    const node = source.root.entries.get(kind);
    return node?.kind === "table" ? [...node.entries] : [];
  };
  const renamed = new Map<string, string>();
  for (const kind of ["body", "joint", "spring", "torsion_spring", "force", "motor"] as const) {
    const taken = namesOf(model, kind);
    for (const [name] of tables(kind)) {
      const fresh = freshName(name, taken);
      taken.add(fresh);
      renamed.set(`${kind}.${name}`, fresh);
    }
  }
  const groundNames = new Set(model.ground.map((marker) => marker.name));
  const ground = nodeAt(source.root, ["ground", "markers"]);
  for (const [name, node] of ground?.kind === "table" ? ground.entries : []) {
    const fresh = freshName(name, groundNames);
    groundNames.add(fresh);
    renamed.set(`ground.${name}`, fresh);
    const [x = 0, y = 0, axis = 0] = plain(node) as number[];
    draft.set(["ground", "markers", fresh], [...writeLengths([x + step[0], y + step[1]]), writeAngle(axis)]);
  }
  const moveEnd = (end: string): string => {
    const [body = "", marker = ""] = end.split(".");
    return body === GROUND ? `ground.${renamed.get(`ground.${marker}`) ?? marker}` : `${renamed.get(`body.${body}`) ?? body}.${marker}`;
  };
  const lengths = readLengths(copied);
  const from = readModel(source);
  for (const kind of ["body", "joint", "spring", "torsion_spring", "force", "motor"] as const) {
    for (const [name, node] of tables(kind)) {
      const fresh = renamed.get(`${kind}.${name}`) ?? name;
      made.push({ kind, name: fresh });
      const body = kind === "body" ? from.body.get(name) : undefined;
      if (body?.shape) draft.shape(fresh, writeShape(body.shape));
      for (const [key, value] of node.kind === "table" ? node.entries : []) {
        let literal = plain(value);
        if (key === "between") literal = (literal as string[]).map(moveEnd);
        else if (key === "on") literal = moveEnd(String(literal));
        else if (key === "joint" && kind === "motor") literal = renamed.get(`joint.${String(literal)}`) ?? literal;
        else if (key === "position") {
          const [x, y] = lengths.get(name) ?? [0, 0];
          literal = writeLengths([x + step[0], y + step[1]]);
        } else if (key === "markers" && value.kind === "table") {
          for (const [marker, place] of value.entries) {
            const traced = body?.markers.some((one) => one.name === marker && one.traced);
            draft.set([kind, fresh, "markers", marker], plain(place), traced ? TRACE : "");
          }
          continue;
        }
        const fromShape = (key === "mass" && body?.massFromShape) || (key === "inertia" && body?.inertiaFromShape);
        draft.set([kind, fresh, key], literal, fromShape ? FROM_SHAPE : "");
      }
    }
  }
  return { text: draft.apply(), made: made.filter((one) => one.kind === "body") };
}

function readLengths(copied: string): Map<string, Point> {
  const places = new Map<string, Point>();
  const bodies = nodeAt(parseToml(copied).root, ["body"]);
  for (const [name, node] of bodies?.kind === "table" ? bodies.entries : []) {
    const position = node.kind === "table" ? node.entries.get("position") : undefined;
    const [x = 0, y = 0] = position?.kind === "list" ? position.items.map(metres) : [];
    places.set(name, [x, y]);
  }
  return places;
}

// Reads what writeLengths wrote: "12.5 mm", "3 m" or 0.
function metres(node: { kind: string; value?: unknown }): number {
  if (typeof node.value === "number") return node.value;
  const text = String(node.value ?? "0");
  return Number.parseFloat(text) * (text.endsWith("mm") ? 1e-3 : 1);
}

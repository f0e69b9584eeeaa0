// The drawing of a mechanism: built once per model and zoom, then only moved. A frame only sets a transform for each
// moving thing; it creates and measures nothing.
import { type Point, type Pose, distance, roundedOutline, toWorld } from "../model/geometry";
import { type Blade, type End, GROUND, type Joint, type Model, type Profile, type Spring, markerOf } from "../model/model";
import type { Thing } from "../model/operations";
import type { Camera } from "./camera";
import { type BodyLook, type Looks, guideEnds } from "./looks";
import { ForceArrows, drawLoads } from "./loads";
import { BAR, BEARING, PIN, bearingRing, beltRun, bend, centreMark, circle, coil, cylinder, dashpot, groundGuide, polyline, rackTeeth, rectangle, slot, support, teeth, zigzag } from "./symbols";
import { group, make, path, put } from "./svg";

/** One instant: poses of the bodies, and joint forces (fx, fy, moment on the second body, in the order of the model). */
export interface Frame {
  pose: (body: string) => Pose;
  forces: ArrayLike<number> | null;
}

export interface SceneOptions {
  labels: boolean;
  forces: boolean;
  centres: boolean;
  /** The force that the longest force arrow represents [N]. */
  forceScale: number;
}

/** With more joints, labels hide the mechanism, and take half of each frame without a graphics card. */
const MOST_LABELS = 60;

type Mover = (frame: Frame) => void;

/** Layers from back to front. */
const LAYERS = ["grid", "ground", "trace", "ghost", "guides", "bodies", "links", "pins", "loads", "forces", "labels", "overlay"] as const;
export type Layer = (typeof LAYERS)[number];

export class Scene {
  readonly layers = {} as Record<Layer, SVGGElement>;
  private readonly root: SVGGElement;
  private movers: Mover[] = [];
  private marked = new Map<string, Element[]>();
  private scale = 1;
  private arrows: ForceArrows | null = null;

  constructor(readonly svg: SVGSVGElement) {
    this.layers.grid = group("layer-grid", svg);
    this.root = group("world", svg);
    for (const name of LAYERS.slice(1)) this.layers[name] = group(`layer-${name}`, this.root);
  }

  /** Redraws everything, after an edit or a zoom. */
  show(model: Model, looks: Looks, camera: Camera, options: SceneOptions): void {
    for (const name of ["ground", "guides", "bodies", "links", "pins", "loads", "forces", "labels"] as const) this.layers[name].replaceChildren();
    this.movers = [];
    this.marked = new Map();
    this.scale = camera.scale;
    this.pan(camera);
    for (const guide of looks.guides) this.drawGuide(guide);
    for (const gear of looks.gears) this.drawGear(gear);
    for (const joint of model.joints) if (joint.profile) this.drawProfile(model, joint, joint.profile);
    // Blocks and discs are below the bars that are pinned to them.
    const looked = model.bodies.map((body, i) => ({ name: body.name, look: looks.bodies.get(body.name) ?? ({ kind: "mass" } as BodyLook), i }));
    for (const under of [true, false]) for (const { name, look, i } of looked) if ((look.kind !== "bar") === under) this.drawBody(name, look, i);
    const pinned = new Set(model.joints.filter((joint) => joint.type === "revolute" || joint.type === "fixed").flatMap((joint) => [joint.first, joint.second]).map((end) => `${end.body}.${end.marker}`));
    for (const body of model.bodies) this.drawMarkers(body.name, body.markers, pinned, options);
    for (const joint of model.joints) this.drawJoint(model, joint);
    for (const spring of model.springs) this.drawSpring(model, spring);
    this.drawRacks(model);
    this.drawFollowers(model);
    drawLoads(this, model);
    if (options.labels && model.joints.length <= MOST_LABELS) this.drawLabels(model);
    this.arrows = options.forces ? new ForceArrows(this.layers.forces, model, options.forceScale) : null;
  }

  pan(camera: Camera): void {
    put(this.root, camera.x, camera.y);
  }

  place(frame: Frame): void {
    for (const move of this.movers) move(frame);
    this.arrows?.place(frame, this.scale);
  }

  /** Highlights the selection and the thing under the pointer. */
  mark(selection: readonly Thing[], hover: Thing | null): void {
    for (const elements of this.marked.values()) for (const one of elements) one.classList.remove("selected", "hover");
    for (const thing of selection) for (const one of this.marked.get(`${thing.kind}.${thing.name}`) ?? []) one.classList.add("selected");
    if (hover) for (const one of this.marked.get(`${hover.kind}.${hover.name}`) ?? []) one.classList.add("hover");
  }

  /** Registers an element of a thing, for highlighting. */
  register(kind: Thing["kind"], name: string, element: Element): void {
    const key = `${kind}.${name}`;
    const list = this.marked.get(key);
    if (list) list.push(element);
    else this.marked.set(key, [element]);
  }

  onFrame(move: Mover): void {
    this.movers.push(move);
  }

  /** Position of a point of a body, in pixels from the world's origin. */
  at(frame: Frame, body: string, point: Point): Point {
    const [x, y] = body === GROUND ? point : toWorld(frame.pose(body), point);
    return [x * this.scale, -y * this.scale];
  }

  private local([x, y]: Point): Point {
    return [x * this.scale, -y * this.scale];
  }

  /** Attaches an element to a point of a body, rotated with the body and by an angle of its own. */
  follow(element: Element, body: string, point: Point, angle = 0, turns = true): void {
    if (body === GROUND) return put(element, ...this.local(point), turns ? angle : 0);
    this.onFrame((frame) => {
      const [x, y] = this.at(frame, body, point);
      put(element, x, y, turns ? frame.pose(body).angle + angle : 0);
    });
  }

  private drawBody(name: string, look: BodyLook, index: number): void {
    const one = group(`body tint${index % 6}`, this.layers.bodies);
    this.register("body", name, one);
    this.follow(one, name, [0, 0]);
    if (look.kind === "bar") path(polyline(roundedOutline(look.points.map((p) => this.local(p)), BAR, 24), true), "solid", one);
    else if (look.kind === "disc" && look.radius > 0) this.drawDisc(one, look.radius * this.scale);
    else if (look.kind === "block") {
      const width = Math.max((look.width ?? 0) * this.scale, 30);
      const height = Math.max((look.height ?? 0) * this.scale, 20);
      const inner = group("", one);
      put(inner, ...this.local(look.at), look.axis);
      path(rectangle(width, height, 3), "solid", inner);
    } else if (look.kind === "mass") path(circle(0, 0, 12), "solid", one);
  }

  private drawDisc(one: SVGGElement, radius: number): void {
    path(circle(0, 0, radius), "solid", one);
    path(circle(0, 0, Math.max(radius * 0.18, 7)) + `M0 ${-radius * 0.9}V${-radius * 0.55}`, "detail", one);
  }

  private drawGear(gear: Looks["gears"][number]): void {
    const one = group("gear", this.layers.bodies);
    this.register("body", gear.body, one);
    this.follow(one, gear.body, gear.at);
    const radius = gear.radius * this.scale;
    path(teeth(radius, gear.internal ? -1 : 1) + (gear.internal ? circle(0, 0, radius + 12) : ""), gear.internal ? "solid ring" : "solid", one);
    path(circle(0, 0, radius), "pitch", one);
    if (!gear.internal) path(circle(0, 0, Math.max(radius * 0.2, 7)) + `M0 ${-radius * 0.85}V${-radius * 0.5}`, "detail", one);
  }

  private drawProfile(model: Model, joint: Joint, profile: Profile): void {
    const one = group("gear", this.layers.bodies);
    const marker = markerOf(model, joint.first);
    this.register("joint", joint.name, one);
    this.follow(one, joint.first.body, marker?.at ?? [0, 0], marker?.axis ?? 0);
    path(polyline(profile.outline.map((p) => this.local(p)), true), "solid", one);
  }

  // The followers of cams and edges: a roller, or the line of a flat face.
  private drawFollowers(model: Model): void {
    for (const joint of model.joints) {
      if (!joint.profile) continue;
      const marker = markerOf(model, joint.second);
      const one = group("gear", this.layers.links);
      this.register("joint", joint.name, one);
      this.follow(one, joint.second.body, marker?.at ?? [0, 0], marker?.axis ?? 0);
      const reach = Math.max(...joint.profile.outline.map(([x, y]) => Math.hypot(x, y))) * this.scale;
      if (joint.profile.roller === null) path(polyline([[-reach, 0], [reach, 0]]), "solid", one);
      else path(circle(0, 0, Math.max(joint.profile.roller * this.scale, 3)), "solid", one);
    }
  }

  private drawRacks(model: Model): void {
    for (const joint of model.joints) {
      if (joint.type !== "rack") continue;
      const marker = markerOf(model, joint.second);
      const one = group("body rack", this.layers.bodies);
      this.register("joint", joint.name, one);
      this.follow(one, joint.second.body, marker?.at ?? [0, 0], marker?.axis ?? 0);
      path(rackTeeth(Math.max(60, (joint.radius ?? 0) * this.scale * 2.5)), "detail", one);
    }
  }

  private drawGuide(guide: Looks["guides"][number]): void {
    const onGround = guide.on === GROUND;
    const one = group(guide.slot ? "guide slot" : "guide", onGround ? this.layers.guides : this.layers.links);
    this.register("joint", guide.joint, one);
    this.follow(one, guide.on, guide.at, guide.axis);
    const reach = Math.max(guide.reach * this.scale, 40);
    if (guide.slot) path(slot(onGround ? reach : Math.max(reach - 20, 12), onGround ? PIN + 2 : PIN), "hollow", one);
    else if (onGround) path(groundGuide(reach, 12), "line", one);
    else path(`M${-reach} 0H${reach}`, "axis", one);
  }

  // A point under a pin needs no dot.
  private drawMarkers(body: string, markers: Model["ground"], pinned: ReadonlySet<string>, options: SceneOptions): void {
    for (const marker of markers) {
      if (pinned.has(`${body}.${marker.name}`) && !marker.traced) continue;
      const dot = path(circle(0, 0, marker.traced ? 4 : 2.5), marker.traced ? "marker traced" : "marker", this.layers.links);
      this.register("marker", `${body}.${marker.name}`, dot);
      this.follow(dot, body, marker.at, 0, false);
    }
    if (!options.centres) return;
    const mark = group("centre", this.layers.links);
    const { ring, quarters } = centreMark();
    path(ring, "ring", mark);
    path(quarters, "quarters", mark);
    this.follow(mark, body, [0, 0]);
  }

  private drawJoint(model: Model, joint: Joint): void {
    if (joint.type === "rod" || joint.type === "rope" || joint.type === "belt") return this.drawTie(model, joint);
    if (joint.barrel !== null) return this.drawCylinder(model, joint, joint.barrel * this.scale);
    if (joint.type === "gear" || joint.type === "rack" || joint.type === "cam") return;
    for (const blade of joint.blades) this.drawBlade(model, joint, blade);
    const end = joint.type === "prismatic" || joint.type === "slot" ? guideEnds(joint).runner : joint.second;
    const marker = markerOf(model, end);
    const at = marker?.at ?? [0, 0];
    const grounded = [joint.first, joint.second].find((one) => one.body === GROUND);
    if (grounded && (joint.type === "revolute" || joint.type === "fixed")) this.drawSupport(model, joint, grounded);
    if (joint.type === "prismatic") {
      if (model.body.get(end.body)?.markers.length !== 1) this.drawBlock(joint, end, at, marker?.axis ?? 0);
      return;
    }
    const ring = joint.type === "revolute" ? bearingRing(joint.law) : null;
    if (ring) {
      const bush = group(`bearing ${ring.look}`, this.layers.pins);
      path(circle(0, 0, BEARING), "ring", bush);
      if (ring.balls) path(ring.balls, "balls", bush);
      this.follow(bush, joint.first.body, markerOf(model, joint.first)?.at ?? [0, 0]);
    }
    const pin = path(joint.type === "fixed" ? "M-5 -5L5 5M5 -5L-5 5" : circle(0, 0, PIN), `pin ${joint.type}`, this.layers.pins);
    this.register("joint", joint.name, pin);
    this.follow(pin, end.body, at, 0, joint.type === "fixed");
  }

  // A block on a guide, if the sliding body also has other points.
  private drawBlock(joint: Joint, end: End, at: Point, axis: number): void {
    const block = path(rectangle(28, 18, 3), "block", this.layers.links);
    this.register("joint", joint.name, block);
    this.follow(block, end.body, at, axis);
  }

  private drawSupport(model: Model, joint: Joint, ground: End): void {
    const one = group("support", this.layers.ground);
    const { body, hatch } = support();
    path(body, "plate", one);
    path(hatch, "line", one);
    this.register("joint", joint.name, one);
    put(one, ...this.local(markerOf(model, ground)?.at ?? [0, 0]));
  }

  private drawTie(model: Model, joint: Joint): void {
    const line = path("", joint.type === "rod" ? "tie rod" : "tie rope", this.layers.links);
    this.register("joint", joint.name, line);
    const [a, b] = [joint.first, joint.second].map((end) => ({ body: end.body, at: markerOf(model, end)?.at ?? ([0, 0] as Point) }));
    if (!a || !b) return;
    this.onFrame((frame) => line.setAttribute("d", polyline(beltRun(this.at(frame, a.body, a.at), this.at(frame, b.body, b.at), joint.discs.map((radius) => -radius * this.scale)))));
    for (const end of [a, b]) this.follow(path(circle(0, 0, PIN - 1), "pin", this.layers.pins), end.body, end.at, 0, false);
  }

  private drawCylinder(model: Model, joint: Joint, barrelLength: number): void {
    const one = group("cylinder", this.layers.links);
    const barrel = path("", "barrel", one);
    const rod = path("", "tie rod", one);
    this.register("joint", joint.name, one);
    const [a, b] = [joint.first, joint.second].map((end) => ({ body: end.body, at: markerOf(model, end)?.at ?? ([0, 0] as Point) }));
    if (!a || !b) return;
    this.onFrame((frame) => {
      const [x, y] = this.at(frame, a.body, a.at);
      const [u, v] = this.at(frame, b.body, b.at);
      const shape = cylinder(distance([x, y], [u, v]), barrelLength);
      barrel.setAttribute("d", shape.barrel);
      rod.setAttribute("d", shape.rod);
      put(one, x, y, -Math.atan2(v - y, u - x));
    });
    for (const end of [a, b]) this.follow(path(circle(0, 0, PIN - 1), "pin", this.layers.pins), end.body, end.at, 0, false);
  }

  // The cubic curve that is tangent to the blade's direction at both clamps.
  private drawBlade(model: Model, joint: Joint, blade: Blade): void {
    const line = path("", "spring blade", this.layers.links);
    this.register("joint", joint.name, line);
    const third = (blade.length / 3) * this.scale;
    const clamp = (end: End, along: number) => {
      const marker = markerOf(model, end);
      const angle = (marker?.axis ?? 0) + blade.angle;
      const [x, y] = marker?.at ?? [0, 0];
      return { body: end.body, at: [x + along * Math.cos(angle), y + along * Math.sin(angle)] as Point, angle };
    };
    const from = clamp(joint.first, blade.from);
    const to = clamp(joint.second, blade.to);
    this.onFrame((frame) => {
      const [x, y] = this.at(frame, from.body, from.at);
      const [u, v] = this.at(frame, to.body, to.at);
      const leaves = from.angle + (from.body === GROUND ? 0 : frame.pose(from.body).angle);
      const arrives = to.angle + (to.body === GROUND ? 0 : frame.pose(to.body).angle);
      line.setAttribute("d", bend([x, y], leaves, [u, v], arrives, third));
    });
  }

  private drawSpring(model: Model, spring: Spring): void {
    const kind = spring.torsion ? "torsion_spring" : "spring";
    const line = path("", spring.stiffness > 0 ? "spring" : "spring damper", this.layers.links);
    this.register(kind, spring.name, line);
    const a = markerOf(model, spring.first)?.at ?? [0, 0];
    const b = markerOf(model, spring.second)?.at ?? [0, 0];
    if (spring.torsion) {
      line.setAttribute("d", coil());
      return this.follow(line, spring.second.body, b);
    }
    let drawn = -1;
    this.onFrame((frame) => {
      const [x, y] = this.at(frame, spring.first.body, a);
      const [u, v] = this.at(frame, spring.second.body, b);
      const length = distance([x, y], [u, v]);
      if (Math.abs(length - drawn) > 0.3) line.setAttribute("d", (spring.stiffness > 0 ? zigzag : dashpot)((drawn = length)));
      put(line, x, y, -Math.atan2(v - y, u - x));
    });
  }

  // Labels next to the points, each once however many joints meet there; names of bodies at their centres.
  private drawLabels(model: Model): void {
    const seen = new Set<string>();
    for (const joint of model.joints) {
      const end = joint.second.body === GROUND ? joint.first : joint.second;
      const marker = markerOf(model, end);
      if (!marker || ["gear", "rack", "rod", "rope", "belt"].includes(joint.type)) continue;
      const word = make("text", { class: "label", dx: 10, dy: -10 }, this.layers.labels);
      word.textContent = joint.name;
      const key = `${end.body}.${end.marker}`;
      if (seen.has(key)) word.setAttribute("dy", "20");
      seen.add(key);
      this.follow(word, end.body, marker.at, 0, false);
    }
  }

  /** A plain picture of another mechanism: the ideal run behind the real one. */
  ghost(model: Model, looks: Looks | null): ((frame: Frame) => void) | null {
    this.layers.ghost.replaceChildren();
    if (!looks) return null;
    const moves: Mover[] = [];
    for (const body of model.bodies) {
      const look = looks.bodies.get(body.name);
      const shape = path("", "ghost", this.layers.ghost);
      if (look?.kind === "bar") shape.setAttribute("d", polyline(roundedOutline(look.points.map((p) => this.local(p)), BAR, 24), true));
      else if (look?.kind === "disc") shape.setAttribute("d", circle(0, 0, Math.max(look.radius * this.scale, 8)));
      else shape.setAttribute("d", rectangle(30, 20, 3));
      moves.push((frame) => {
        const pose = frame.pose(body.name);
        put(shape, pose.x * this.scale, -pose.y * this.scale, pose.angle);
      });
    }
    return (frame) => moves.forEach((move) => move(frame));
  }

  /** Paths of traced points, in metres. */
  traces(curves: readonly { points: Float64Array; tone: number }[]): void {
    this.layers.trace.replaceChildren();
    for (const { points, tone } of curves) {
      const list: Point[] = [];
      for (let i = 0; i + 1 < points.length; i += 2) list.push(this.local([points[i]!, points[i + 1]!]));
      path(polyline(list), `curve tone${tone % 6}`, this.layers.trace);
    }
  }
}

// Forces, torques and motors as stated by the model, and arrows for joint forces.
import type { Point } from "../model/geometry";
import { type End, GROUND, type Model, markerOf } from "../model/model";
import { guideEnds } from "./looks";
import type { Frame, Scene } from "./scene";
import { arrow, turnArrow } from "./symbols";
import { group, make, path, put } from "./svg";

const LOAD_LENGTH = 56;

export function drawLoads(scene: Scene, model: Model): void {
  for (const load of model.loads) {
    const at = markerOf(model, load.on)?.at ?? [0, 0];
    const one = group(load.varies ? "load varies" : "load", scene.layers.loads);
    scene.register("force", load.name, one);
    if (load.torque || (load.force[0] === 0 && load.force[1] === 0 && !load.varies)) {
      path(turnArrow(18, load.torque >= 0), "turn", one);
      scene.follow(one, load.on.body, at, 0, false);
    } else {
      // The arrow ends at the point, as pushing forces are drawn.
      const angle = load.force[0] || load.force[1] ? Math.atan2(load.force[1], load.force[0]) : -Math.PI / 2;
      const shaft = path(arrow(LOAD_LENGTH, 11, 1.8), "arrow", one);
      put(shaft, -(LOAD_LENGTH + 6) * Math.cos(angle), (LOAD_LENGTH + 6) * Math.sin(angle), angle);
      scene.follow(one, load.on.body, at, 0, load.bodyAxes);
    }
  }
  for (const motor of model.motors) drawMotor(scene, model, motor.name, motor.joint);
}

function drawMotor(scene: Scene, model: Model, name: string, jointName: string): void {
  const joint = model.joints.find((one) => one.name === jointName);
  if (!joint) return;
  const one = group("motor", scene.layers.loads);
  scene.register("motor", name, one);
  if (joint.type === "revolute") {
    const at = markerOf(model, joint.second)?.at ?? [0, 0];
    path(turnArrow(15, true), "turn", one);
    return scene.follow(one, joint.second.body, at, 0, false);
  }
  const { guide, runner } = guideEnds(joint);
  const place = markerOf(model, runner);
  const axis = markerOf(model, guide)?.axis ?? 0;
  path("M-24 -19H20M-18 -22.5L-25 -19L-18 -15.5M14 -22.5L21 -19L14 -15.5", "turn", one);
  scene.onFrame((frame) => {
    const [x, y] = scene.at(frame, runner.body, place?.at ?? [0, 0]);
    put(one, x, y, axis + (guide.body === GROUND ? 0 : frame.pose(guide.body).angle));
  });
}

/** Where a joint's force is drawn: at its second marker, or its first if the second is on the ground. */
function placeOf(model: Model, first: End, second: End): { body: string; at: Point } {
  const end = second.body === GROUND ? first : second;
  return { body: end.body, at: markerOf(model, end)?.at ?? [0, 0] };
}

/** Joint forces during playback, on the second body; the length follows the square root, so that small ones are visible next to large ones. */
export class ForceArrows {
  private readonly places: { body: string; at: Point; line: SVGPathElement; drawn: number }[];

  constructor(
    layer: Element,
    private readonly model: Model,
    private readonly scale: number,
  ) {
    this.places = model.joints.map((joint) => ({
      ...placeOf(model, joint.first, joint.second),
      line: make("path", { class: "force", visibility: "hidden" }, layer),
      drawn: -1,
    }));
  }

  place(frame: Frame, pixelsPerMetre: number): void {
    const { forces } = frame;
    this.places.forEach((one, i) => {
      const fx = forces?.[3 * i] ?? 0;
      const fy = forces?.[3 * i + 1] ?? 0;
      const size = Math.hypot(fx, fy);
      const length = this.scale > 0 ? 78 * Math.sqrt(Math.min(size / this.scale, 4)) : 0;
      if (length < 4) {
        if (one.drawn !== 0) one.line.setAttribute("visibility", "hidden");
        one.drawn = 0;
        return;
      }
      if (Math.abs(length - one.drawn) > 0.4) one.line.setAttribute("d", arrow(length, 10, 1.5));
      if (one.drawn <= 0) one.line.setAttribute("visibility", "visible");
      one.drawn = length;
      const pose = one.body === GROUND ? null : frame.pose(one.body);
      const [x, y] = one.at;
      const c = pose ? Math.cos(pose.angle) : 1;
      const s = pose ? Math.sin(pose.angle) : 0;
      put(one.line, ((pose?.x ?? 0) + c * x - s * y) * pixelsPerMetre, -((pose?.y ?? 0) + s * x + c * y) * pixelsPerMetre, Math.atan2(fy, fx));
    });
  }
}

// The display side of a live motion: a session of the kernel, and the frames it has delivered.
import type { Frame } from "../drawing/scene";
import type { LiveSession } from "../kernel/kernel";
import type { Fault, LiveFrame } from "../kernel/protocol";
import { ORIGIN, type Pose } from "../model/geometry";
import { GROUND, type Model } from "../model/model";

/** Number of frames that can be scrubbed through: at sixty per second, a minute and a half. */
const RECORD = 5400;

export class Live {
  /** The session has been asked for a frame and has not answered yet. */
  asking = false;
  /** Why the motion is stopped, according to the last frame. */
  fault: Fault | null = null;
  private readonly frames: LiveFrame[] = [];
  /** The frame shown; the last one during playback. */
  private shown = -1;
  private readonly bodies: ReadonlyMap<string, number>;
  private readonly joints: ReadonlyMap<string, number>;
  private flat = new Float64Array(0);

  constructor(
    readonly session: LiveSession,
    /** The text that it simulates. */
    readonly text: string,
  ) {
    const indices = (names: readonly string[]) => new Map(names.map((name, i): [string, number] => [name, i]));
    this.bodies = indices(session.start.bodies);
    this.joints = indices(session.start.joints);
  }

  get begin(): number {
    return this.frames[0]?.t ?? 0;
  }

  get end(): number {
    return this.frames[this.frames.length - 1]?.t ?? 0;
  }

  get behind(): boolean {
    return this.frames[this.frames.length - 1]?.behind ?? false;
  }

  take(frame: LiveFrame): void {
    this.frames.push(frame);
    if (this.frames.length > RECORD) this.frames.splice(0, RECORD / 10);
    this.shown = this.frames.length - 1;
  }

  /** Shows the frame at a time, and returns that frame's time. */
  seek(t: number): number {
    const at = this.frames.findIndex((frame) => frame.t >= t);
    this.shown = at < 0 ? this.frames.length - 1 : at;
    return this.frames[this.shown]?.t ?? 0;
  }

  /** By names: until there is a session for the model on the page, that model can differ from the moving one. */
  frame(model: Model, otherwise: (name: string) => Pose): Frame {
    const frame = this.frames[this.shown];
    const poses = frame?.poses ?? this.session.start.poses;
    return {
      pose: (name) => {
        const i = this.bodies.get(name);
        return i === undefined ? (name === GROUND ? ORIGIN : otherwise(name)) : { x: poses[3 * i]!, y: poses[3 * i + 1]!, angle: poses[3 * i + 2]! };
      },
      forces: frame ? this.forces(model, frame.joint_forces) : null,
    };
  }

  /** On the joint's second body: x and y of the force in world axes [N]; null where this motion has no such joint. */
  force(joint: string): readonly [number, number] | null {
    const j = this.joints.get(joint);
    const of = this.frames[this.shown]?.joint_forces;
    return j === undefined || !of ? null : [of[3 * j]!, of[3 * j + 1]!];
  }

  private forces(model: Model, of: Float64Array): Float64Array {
    if (this.flat.length !== 3 * model.joints.length) this.flat = new Float64Array(3 * model.joints.length);
    model.joints.forEach((joint, i) => {
      const j = this.joints.get(joint.name);
      for (let k = 0; k < 3; k++) this.flat[3 * i + k] = j === undefined ? 0 : of[3 * j + k]!;
    });
    return this.flat;
  }
}

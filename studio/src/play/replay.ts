// The display side of a finished run: poses and joint forces at any time.
import type { Frame } from "../drawing/scene";
import type { Column, RunAnswer } from "../kernel/protocol";
import { type Point, type Pose, toWorld } from "../model/geometry";
import type { Model } from "../model/model";

type Lookup = (t: number, values: Float64Array) => number;

export class Replay {
  readonly time: Float64Array;
  readonly end: number;
  readonly step: number;
  readonly typicalForce: number;
  private readonly bodies = new Map<string, [Float64Array, Float64Array, Float64Array]>();
  private readonly forces = new Map<string, [Float64Array, Float64Array]>();
  private flat = new Float64Array(0);

  constructor(readonly answer: RunAnswer) {
    this.time = answer.values[0] ?? new Float64Array(0);
    this.end = this.time[this.time.length - 1] ?? 0;
    this.step = this.time.length > 1 ? this.end / (this.time.length - 1) : 0.01;
    const of = (kind: Column["kind"]) => (column: Column) => column.kind === kind;
    const find = (columns: Column[], name: string, quantity: string, feels?: string) => {
      const column = columns.find((one) => one.of === name && one.quantity === quantity && (feels === undefined || (one.feels === feels && one.frame === "world")));
      return column ? answer.values[answer.columns.indexOf(column)] : undefined;
    };
    const bodies = answer.columns.filter(of("body"));
    for (const name of new Set(bodies.map((column) => column.of))) {
      const own = bodies.filter((column) => column.of === name);
      const [x, y, angle] = ["x", "y", "angle"].map((quantity) => find(own, name, quantity));
      if (x && y && angle) this.bodies.set(name, [x, y, angle]);
    }
    const byJoint = new Map<string, Column[]>();
    for (const column of answer.columns) if (column.kind === "joint") byJoint.set(column.of, [...(byJoint.get(column.of) ?? []), column]);
    for (const joint of answer.joints) {
      const own = byJoint.get(joint.name) ?? [];
      const fx = find(own, joint.name, "fx", joint.second_body);
      const fy = find(own, joint.name, "fy", joint.second_body);
      if (fx && fy) this.forces.set(joint.name, [fx, fy]);
    }
    const sizes = answer.joints.map((joint) => joint.rms).filter((size) => size > 0).sort((a, b) => a - b);
    this.typicalForce = sizes[Math.floor(sizes.length * 0.8)] ?? 0;
  }

  private at(t: number): Lookup {
    const { time } = this;
    let low = 0;
    let high = time.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (time[middle]! <= t) low = middle;
      else high = middle;
    }
    const span = time[high]! - time[low]!;
    const part = span > 0 ? Math.min(Math.max((t - time[low]!) / span, 0), 1) : 0;
    return (_, values) => values[low]! + (values[high]! - values[low]!) * part;
  }

  frame(t: number, model: Model, otherwise: (name: string) => Pose): Frame {
    const look = this.at(t);
    if (this.flat.length !== 3 * model.joints.length) this.flat = new Float64Array(3 * model.joints.length);
    model.joints.forEach((joint, i) => {
      const columns = this.forces.get(joint.name);
      this.flat[3 * i] = columns ? look(t, columns[0]) : 0;
      this.flat[3 * i + 1] = columns ? look(t, columns[1]) : 0;
    });
    return {
      pose: (name) => {
        const columns = this.bodies.get(name);
        return columns ? { x: look(t, columns[0]), y: look(t, columns[1]), angle: look(t, columns[2]) } : otherwise(name);
      },
      forces: this.flat,
    };
  }

  /** x, y, x, y, ... of a point of a body. */
  path(body: string, [px, py]: Point): Float64Array {
    const columns = this.bodies.get(body);
    if (!columns) return new Float64Array(0);
    const [x, y, angle] = columns;
    const path = new Float64Array(2 * x.length);
    for (let i = 0; i < x.length; i++) {
      const c = Math.cos(angle[i]!);
      const s = Math.sin(angle[i]!);
      path[2 * i] = x[i]! + c * px - s * py;
      path[2 * i + 1] = y[i]! + s * px + c * py;
    }
    return path;
  }

  /** The area that all points of the bodies cover in the run, from about fifty instants. */
  box(model: Model): { min: Point; max: Point } | null {
    let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
    const stride = Math.max(1, Math.floor(this.time.length / 50));
    for (const body of model.bodies) {
      const columns = this.bodies.get(body.name);
      if (!columns) continue;
      for (let i = 0; i < this.time.length; i += stride) {
        const pose = { x: columns[0][i]!, y: columns[1][i]!, angle: columns[2][i]! };
        for (const [x, y] of [[pose.x, pose.y] as Point, ...body.markers.map((marker) => toWorld(pose, marker.at))]) {
          left = Math.min(left, x);
          right = Math.max(right, x);
          bottom = Math.min(bottom, y);
          top = Math.max(top, y);
        }
      }
    }
    return Number.isFinite(left + right + bottom + top) ? { min: [left, bottom], max: [right, top] } : null;
  }

  /** Smallest and largest value of a joint's column. */
  range(joint: string, quantity: string): [number, number] | null {
    const values = this.answer.values[this.answer.columns.findIndex((one) => one.kind === "joint" && one.of === joint && one.quantity === quantity)];
    if (!values || values.length === 0) return null;
    let low = values[0]!;
    let high = low;
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    return Number.isFinite(low + high) ? [low, high] : null;
  }

  valueAt(column: number, t: number): number {
    const values = this.answer.values[column];
    return values ? this.at(t)(t, values) : Number.NaN;
  }
}

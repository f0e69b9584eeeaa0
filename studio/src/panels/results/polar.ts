// The data of a pin's polar load diagram: the path of the force's tip, its longest vector, the rings around it.
import type { PeakForce, RunAnswer } from "../../kernel/protocol";
import { niceSize } from "../../model/shape";
import { jointValues, resample } from "./series";

/** The world's axes, or those of the pin's marker on its first or second body. */
export type Axes = "world" | "first" | "second";

export interface ForcePath {
  x: Float64Array;
  y: Float64Array;
}

/** In world axes the force on the second body; in a marker's axes the force on that marker's body. docs/theory/bearing_life.md Eq. (4.1) */
export function forcePath(answer: RunAnswer, joint: PeakForce, axes: Axes): ForcePath | null {
  const [x, y] = axes === "world" ? ["fx", "fy"].map((quantity) => jointValues(answer, joint, quantity, "world")) : ["f1", "f2"].map((quantity) => jointValues(answer, joint, quantity, "joint"));
  if (!x || !y) return null;
  if (axes === "world") return { x, y };
  if (axes === "first") return { x: x.map((value) => -value), y: y.map((value) => -value) };
  const angle = jointValues(answer, joint, "angle");
  return angle ? { x: x.map((f1, i) => Math.cos(angle[i]!) * f1 + Math.sin(angle[i]!) * y[i]!), y: y.map((f2, i) => Math.cos(angle[i]!) * f2 - Math.sin(angle[i]!) * x[i]!) } : null;
}

/** The tip of the largest force, in the direction of the path at that time. None if the adjacent rows are less than half as long: they do not
 * give the direction of an impact between them. */
export function peakTip({ x, y }: ForcePath, time: Float64Array, { peak, peak_time }: PeakForce): [number, number] | null {
  const [fx, fy] = [x, y].map((values) => resample(time, values, Float64Array.of(peak_time))[0] ?? 0) as [number, number];
  const length = Math.hypot(fx, fy);
  return length >= peak / 2 && length > 0 ? [(fx * peak) / length, (fy * peak) / length] : null;
}

/** Direction in degrees from the x axis, counter-clockwise. */
export const direction = ([x, y]: readonly [number, number]): number => Math.round((Math.atan2(y, x) * 180) / Math.PI);

export function longest(paths: readonly ForcePath[]): number {
  let most = 0;
  for (const { x, y } of paths) x.forEach((value, i) => (most = Math.max(most, Math.hypot(value, y[i]!) || 0)));
  return most;
}

/** Two to five round forces up to the largest. */
export function ringsUpTo(largest: number): number[] {
  if (!(largest > 0)) return [];
  const step = niceSize(largest / 3);
  return Array.from({ length: Math.floor((largest / step) * (1 + 1e-9)) }, (_, i) => step * (i + 1));
}

/** The row whose tip is nearest to the given force. */
export function rowNearestTo({ x, y }: ForcePath, [fx, fy]: readonly [number, number]): number {
  let best = 0;
  let least = Number.POSITIVE_INFINITY;
  x.forEach((value, i) => {
    const far = Math.hypot(value - fx, y[i]! - fy);
    if (far < least) [least, best] = [far, i];
  });
  return best;
}

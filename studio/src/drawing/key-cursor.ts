// Drawing without a pointer: arrow keys move the tool's point over the grid and onto points of the mechanism, and words state its position.
import { type Point, toWorld } from "../model/geometry";
import { GROUND, type Model, type Poses, poseOf } from "../model/model";
import type { Target } from "../model/operations";
import { quantity } from "../model/units";

/** In world axes: y points up. */
export const ARROWS: Readonly<Record<string, Point>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export function pointsOf(model: Model, poses: Poses): Point[] {
  return [...model.ground.map((marker) => marker.at), ...model.bodies.flatMap((body) => body.markers.map((marker) => toWorld(poseOf(model, body.name, poses), marker.at)))];
}

/**
 * One step along an arrow: to the next grid line, or to the first point of the mechanism on the way. Points within half a
 * step of the row count, so that every point can be reached.
 */
export function nextPoint(from: Point, [dx, dy]: Point, step: number, points: readonly Point[]): Point {
  const forward = dx !== 0 ? 0 : 1;
  const sense = dx + dy;
  const row = Math.round(from[1 - forward]! / step) * step;
  const here = from[forward]! * sense;
  const line = (Math.floor(here / step + 1e-6) + 1) * step;
  const grid: Point = forward === 0 ? [line * sense, row] : [row, line * sense];
  let best = grid;
  let least = line + 1e-6 * step;
  for (const point of points) {
    const there = point[forward]! * sense;
    if (there <= here + 1e-6 * step || there >= least || Math.abs(point[1 - forward]! - row) > (0.5 + 1e-6) * step) continue;
    least = there;
    best = point;
  }
  return best;
}

/** "x 120 mm, y −40 mm, on A of crank". */
export function placeInWords({ at, end, body }: Target): string {
  const on = end ? `, on ${end.marker} of ${end.body === GROUND ? "the ground" : end.body}` : body ? `, on ${body}` : "";
  return `x ${quantity(at[0], "m")}, y ${quantity(at[1], "m")}${on}`;
}

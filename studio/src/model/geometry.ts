// Points, poses and some plane geometry. Lengths in metres, angles in radians, counter-clockwise.
export type Point = readonly [number, number];

/** Pose of a body's axes in the world. */
export interface Pose {
  x: number;
  y: number;
  angle: number;
}

export const ORIGIN: Pose = { x: 0, y: 0, angle: 0 };

export function toWorld(pose: Pose, [x, y]: Point): Point {
  const c = Math.cos(pose.angle);
  const s = Math.sin(pose.angle);
  return [pose.x + c * x - s * y, pose.y + s * x + c * y];
}

export function toBody(pose: Pose, [x, y]: Point): Point {
  const c = Math.cos(pose.angle);
  const s = Math.sin(pose.angle);
  const dx = x - pose.x;
  const dy = y - pose.y;
  return [c * dx + s * dy, -s * dx + c * dy];
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

export function direction(a: Point, b: Point): number {
  return Math.atan2(b[1] - a[1], b[0] - a[0]);
}

export function along(from: Point, length: number, angle: number): Point {
  return [from[0] + length * Math.cos(angle), from[1] + length * Math.sin(angle)];
}

export function middle(a: Point, b: Point): Point {
  return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
}

/** The point of the segment from a to b that is nearest to p. */
export function nearestOnSegment(p: Point, a: Point, b: Point): Point {
  const dx = b[0] - a[0];
  const dy = b[1] - a[1];
  const square = dx * dx + dy * dy;
  const s = square > 0 ? Math.min(Math.max(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square, 0), 1) : 0;
  return [a[0] + s * dx, a[1] + s * dy];
}

/** Counter-clockwise convex hull; collinear points are left out. */
export function hull(points: readonly Point[]): Point[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const half = (list: Point[]): Point[] => {
    const chain: Point[] = [];
    for (const p of list) {
      while (chain.length > 1 && turn(chain[chain.length - 2]!, chain[chain.length - 1]!, p) <= 1e-15) chain.pop();
      chain.push(p);
    }
    chain.pop();
    return chain;
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

function turn(a: Point, b: Point, c: Point): number {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/** The outline of everything within `radius` of the hull of the points, as a polygon. */
export function roundedOutline(points: readonly Point[], radius: number, perTurn = 32): Point[] {
  const corners = hull(points);
  if (corners.length === 0) return [];
  if (corners.length === 1) return arc(corners[0]!, radius, 0, 2 * Math.PI, perTurn);
  const outline: Point[] = [];
  corners.forEach((corner, i) => {
    const before = corners[(i + corners.length - 1) % corners.length]!;
    const after = corners[(i + 1) % corners.length]!;
    const from = direction(before, corner) - Math.PI / 2;
    let to = direction(corner, after) - Math.PI / 2;
    while (to < from) to += 2 * Math.PI;
    outline.push(...arc(corner, radius, from, to, perTurn));
  });
  return outline;
}

function arc(centre: Point, radius: number, from: number, to: number, perTurn: number): Point[] {
  const pieces = Math.max(1, Math.ceil(((to - from) / (2 * Math.PI)) * perTurn));
  return Array.from({ length: pieces + 1 }, (_, i) => along(centre, radius, from + ((to - from) * i) / pieces));
}

export interface AreaMoments {
  area: number;
  centroid: Point;
  /** Polar second moment of area about the centroid [m^4]. */
  polar: number;
}

/** For a simple polygon, counter-clockwise. */
export function areaMoments(polygon: readonly Point[]): AreaMoments {
  let area = 0;
  let sx = 0;
  let sy = 0;
  let polar = 0;
  polygon.forEach((a, i) => {
    const b = polygon[(i + 1) % polygon.length]!;
    const cross = a[0] * b[1] - a[1] * b[0];
    area += cross / 2;
    sx += (cross * (a[0] + b[0])) / 6;
    sy += (cross * (a[1] + b[1])) / 6;
    polar += (cross * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0] + a[1] * a[1] + a[1] * b[1] + b[1] * b[1])) / 12;
  });
  const centroid: Point = area > 0 ? [sx / area, sy / area] : (polygon[0] ?? [0, 0]);
  return { area, centroid, polar: polar - area * (centroid[0] ** 2 + centroid[1] ** 2) };
}

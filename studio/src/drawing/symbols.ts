// Paths of the symbols, in pixels, y down. Sizes are fixed on the screen, so that a drawing is equally readable at every zoom.
import type { Point } from "../model/geometry";

export const PIN = 4.5;
export const BAR = 8;

/** Limit for lines and teeth of one symbol: far outside any screen, yet quick to draw. */
const MOST_REACH = 40_000;

const f = (value: number) => (Math.round(value * 10) / 10).toString();

export function polyline(points: readonly Point[], close = false): string {
  if (points.length === 0) return "";
  return "M" + points.map(([x, y]) => `${f(x)} ${f(y)}`).join("L") + (close ? "Z" : "");
}

export function circle(x: number, y: number, r: number): string {
  return `M${f(x - r)} ${f(y)}a${f(r)} ${f(r)} 0 1 0 ${f(2 * r)} 0a${f(r)} ${f(r)} 0 1 0 ${f(-2 * r)} 0`;
}

export const BEARING = 8.5;

/** The ring around the pin of a joint with this law: balls, oil, rubber, or clearance. None for a plain spring and damper. */
export function bearingRing(law: string): { look: "rolling" | "oil" | "rubber" | "gap"; balls?: string } | null {
  if (law === "journal-bearing") return { look: "oil" };
  if (law === "clearance") return { look: "gap" };
  if (law === "rubber-bushing" || law === "bushing" || law === "maxwell") return { look: "rubber" };
  if (law !== "rolling-bearing") return null;
  const count = 10;
  const centres = (BEARING + PIN) / 2;
  const around = Array.from({ length: count }, (_, i) => (2 * Math.PI * i) / count);
  return { look: "rolling", balls: around.map((angle) => circle(centres * Math.cos(angle), centres * Math.sin(angle), 1.3)).join("") };
}

/** A support: a triangle below the pin, a line, and hatching below it. */
export function support(): { body: string; hatch: string } {
  const h = 17;
  const w = 11;
  let hatch = `M${-w - 5} ${h}H${w + 5}`;
  for (let x = -w - 1; x <= w + 5; x += 6) hatch += `M${x} ${h}l-6 6`;
  return { body: `M0 0L${-w} ${h}H${w}Z`, hatch };
}

/** A straight guide of a given half-length: a line hatched on its lower side, at a distance below the axis. */
export function groundGuide(reach: number, gap: number): string {
  const end = Math.min(reach, MOST_REACH);
  let path = `M${f(-end)} ${gap}H${f(end)}`;
  for (let x = -end + 6; x <= end; x += 8) path += `M${f(x)} ${gap}l-6 6`;
  return path;
}

export function slot(reach: number, radius: number): string {
  return `M${f(-reach)} ${-radius}H${f(reach)}a${radius} ${radius} 0 0 1 0 ${2 * radius}H${f(-reach)}a${radius} ${radius} 0 0 1 0 ${-2 * radius}Z`;
}

export function rectangle(width: number, height: number, corner = 2): string {
  const w = width / 2 - corner;
  const h = height / 2;
  return `M${f(-w)} ${f(-h)}H${f(w)}q${corner} 0 ${corner} ${corner}V${f(h - corner)}q0 ${corner} ${-corner} ${corner}H${f(-w)}q${-corner} 0 ${-corner} ${-corner}V${f(-h + corner)}q0 ${-corner} ${corner} ${-corner}Z`;
}

/** A zigzag from the origin along x. */
export function zigzag(length: number): string {
  const lead = Math.min(12, length / 5);
  const coils = 8;
  const step = (length - 2 * lead) / coils;
  const height = 6.5;
  let path = `M0 0H${f(lead)}`;
  for (let i = 0; i < coils; i++) path += `l${f(step / 4)} ${-height}l${f(step / 2)} ${2 * height}l${f(step / 4)} ${-height}`;
  return path + `H${f(length)}`;
}

/** A dashpot from the origin along x. */
export function dashpot(length: number): string {
  const mid = length / 2;
  const cup = Math.min(14, length / 4);
  return `M0 0H${f(mid - cup)}M${f(mid - cup)} -7V7M${f(mid - cup)} -7H${f(mid + cup)}M${f(mid - cup)} 7H${f(mid + cup)}M${f(mid)} -5V5M${f(mid)} 0H${f(length)}`;
}

/** A cylinder along x: the barrel from its end forwards, and from the other end back the rod with its piston, as long as the barrel; of several stages the last one. */
export function cylinder(length: number, barrelLength: number): { barrel: string; rod: string } {
  const piston = Math.min(length - barrelLength, barrelLength);
  return { barrel: `M0 -9H${f(barrelLength)}V9H0Z`, rod: `M${f(piston)} 0H${f(length)}M${f(piston)} -9V9` };
}

/** Both ends of a belt between discs about two points; a radius is positive if the belt, seen from the first point, is on the +90 degree side of the centre line. */
export function beltRun([x, y]: Point, [u, v]: Point, [first = 0, second = 0]: readonly number[]): [Point, Point] {
  const w = second - first;
  const far = Math.max(Math.hypot(u - x, v - y), Math.abs(w));
  if (far === 0) return [[x, y], [u, v]];
  const t = Math.sqrt((far - w) * (far + w));
  const [a, b] = [(-t * (v - y) - w * (u - x)) / far ** 2, (t * (u - x) - w * (v - y)) / far ** 2];
  return [[x + first * a, y + first * b], [u + second * a, v + second * b]];
}

/** A blade from one point to another, with the given directions at its ends (y up) and handles of this length. */
export function bend([x, y]: Point, leaves: number, [u, v]: Point, arrives: number, handle: number): string {
  const c = [x + handle * Math.cos(leaves), y - handle * Math.sin(leaves), u - handle * Math.cos(arrives), v + handle * Math.sin(arrives)];
  return `M${f(x)} ${f(y)}C${c.map(f).join(" ")} ${f(u)} ${f(v)}`;
}

/** A spiral about the origin. */
export function coil(radius = 15): string {
  const points: Point[] = [];
  for (let i = 0; i <= 60; i++) {
    const angle = (i / 60) * 2.6 * 2 * Math.PI;
    const r = 6 + ((radius - 6) * i) / 60;
    points.push([r * Math.cos(angle), r * Math.sin(angle)]);
  }
  return polyline(points);
}

/** An arrow from the origin along x, with its head at the end. */
export function arrow(length: number, head = 9, shaft = 1.3): string {
  const l = Math.max(length, 0.1);
  const h = Math.min(head, l);
  const back = l - h;
  return `M0 ${-shaft}H${f(back)}V${f(-h * 0.42)}L${f(l)} 0L${f(back)} ${f(h * 0.42)}V${shaft}H0Z`;
}

/** Part of a circle about the origin with an arrowhead; counter-clockwise on the screen if `left`. */
export function turnArrow(radius: number, left: boolean): string {
  const from = left ? 0.7 : -0.7;
  const to = left ? -4.1 : 4.1;
  const at = (angle: number): Point => [radius * Math.cos(angle), radius * Math.sin(angle)];
  const [x0, y0] = at(from);
  const [x1, y1] = at(to);
  const forward = to + (left ? -Math.PI / 2 : Math.PI / 2);
  const tip: Point = [x1 + 8 * Math.cos(forward), y1 + 8 * Math.sin(forward)];
  const side = (s: number): Point => [x1 + s * 4.5 * Math.cos(to), y1 + s * 4.5 * Math.sin(to)];
  return `M${f(x0)} ${f(y0)}A${radius} ${radius} 0 1 ${left ? 0 : 1} ${f(x1)} ${f(y1)}` + `M${f(side(-1)[0])} ${f(side(-1)[1])}L${f(tip[0])} ${f(tip[1])}L${f(side(1)[0])} ${f(side(1)[1])}`;
}

/** Teeth on a pitch circle: short strokes across it. */
export function teeth(radius: number, outward = 1): string {
  const count = Math.max(8, Math.min(90, Math.round((2 * Math.PI * radius) / 11)));
  const points: Point[] = [];
  for (let i = 0; i < count; i++) {
    for (const [part, offset] of [[0, -3], [0.22, 3.2], [0.5, 3.2], [0.72, -3]] as const) {
      const angle = ((i + part) / count) * 2 * Math.PI;
      const r = radius + outward * offset;
      points.push([r * Math.cos(angle), r * Math.sin(angle)]);
    }
  }
  return polyline(points, true);
}

/** A rack's teeth along x. */
export function rackTeeth(reach: number): string {
  const points: Point[] = [];
  const end = Math.min(reach, MOST_REACH);
  for (let x = -end; x <= end; x += 11) points.push([x, 3], [x + 2.4, -3.2], [x + 5.5, -3.2], [x + 7.9, 3]);
  return polyline(points);
}

/** The symbol of a centre of mass: a circle with two dark quarters. */
export function centreMark(r = 5): { ring: string; quarters: string } {
  return { ring: circle(0, 0, r), quarters: `M0 0V${-r}A${r} ${r} 0 0 1 ${r} 0ZM0 0V${r}A${r} ${r} 0 0 1 ${-r} 0Z` };
}

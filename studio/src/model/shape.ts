// Mass and inertia from shape and material. The format knows only mass and inertia; the shape is in a comment after
// the body's header, and values derived from it are marked by comments.
import { type Point, areaMoments, roundedOutline } from "./geometry";
import { shortNumber } from "./units";

export interface Shape {
  kind: "bar" | "block" | "disc";
  /** Bar: width across it. Block: size along x. Disc: diameter [m]. */
  width: number;
  /** Block: size along y [m]. */
  height: number;
  thickness: number;
  material: string;
}

/** kg/m^3 */
export const MATERIALS: Readonly<Record<string, number>> = {
  steel: 7850,
  "cast iron": 7200,
  aluminium: 2700,
  titanium: 4430,
  brass: 8500,
  nylon: 1150,
  acrylic: 1180,
  oak: 700,
};

export const FROM_SHAPE = "from its shape";

export interface MassProperties {
  mass: number;
  inertia: number;
  centroid: Point;
}

/** About the centroid; points are the body's markers, in any axes. */
export function massProperties(shape: Shape, points: readonly Point[]): MassProperties {
  const surface = (MATERIALS[shape.material] ?? 7850) * shape.thickness;
  if (shape.kind === "bar" && points.length > 0) {
    const { area, centroid, polar } = areaMoments(roundedOutline(points, shape.width / 2, 64));
    return { mass: surface * area, inertia: surface * polar, centroid };
  }
  const { width, height } = shape;
  const area = shape.kind === "disc" ? (Math.PI * width * width) / 4 : width * height;
  const polar = shape.kind === "disc" ? (area * width * width) / 8 : (area * (width * width + height * height)) / 12;
  return { mass: surface * area, inertia: surface * polar, centroid: [0, 0] };
}

const mm = (metres: number) => `${Number((metres * 1e3).toFixed(3))} mm`;

export function writeShape(shape: Shape): string {
  const size = shape.kind === "block" ? `${mm(shape.width)} x ${mm(shape.height)}` : shape.kind === "disc" ? `diameter ${mm(shape.width)}` : `width ${mm(shape.width)}`;
  return `shape: ${shape.kind}, ${size}, thickness ${mm(shape.thickness)}, ${shape.material}`;
}

const SHAPE = /^shape: (bar|block|disc), (?:width |diameter )?([\d.]+) mm(?: x ([\d.]+) mm)?, thickness ([\d.]+) mm, ([a-z ]+)$/;

export const isShape = (remark: string): boolean => SHAPE.test(remark);

export function readShape(remark: string): Shape | null {
  const found = SHAPE.exec(remark);
  if (!found) return null;
  const [, kind, width, height, thickness, material] = found;
  return {
    kind: kind as Shape["kind"],
    width: Number(width) / 1e3,
    height: Number(height ?? width) / 1e3,
    thickness: Number(thickness) / 1e3,
    material: (material ?? "steel").trim(),
  };
}

/** Four digits are enough for a mass, and easy to read. */
export function writeMass(kilograms: number): string {
  return `${shortNumber(kilograms, 5)} kg`;
}

export function writeInertia(value: number): string {
  return `${shortNumber(value, 5)} kg*m^2`;
}

/** The default shape of a bar of this length: its width is about a twelfth of its length. */
export function likelyBar(length: number): Shape {
  const width = Math.max(niceSize(length / 12), 1e-3);
  return { kind: "bar", width, height: width, thickness: Math.max(niceSize(width / 2), 1e-3), material: "steel" };
}

/** The size rounded to 1, 2 or 5 times a power of ten, at most 43 % above it. */
export function niceSize(size: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(size, 1e-9)));
  const digit = size / power;
  const nice = digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10;
  return Number((nice * power).toPrecision(12));
}

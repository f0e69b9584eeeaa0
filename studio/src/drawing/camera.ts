// Converts from metres to pixels and back. World y points up, screen y down.
import type { Point } from "../model/geometry";

export interface Camera {
  /** Pixels per metre. */
  scale: number;
  /** Position of the world's origin on the screen [px]. */
  x: number;
  y: number;
}

export interface Size {
  width: number;
  height: number;
}

export function toScreen(camera: Camera, [x, y]: Point): Point {
  return [camera.x + x * camera.scale, camera.y - y * camera.scale];
}

export function fromScreen(camera: Camera, [x, y]: Point): Point {
  return [(x - camera.x) / camera.scale, (camera.y - y) / camera.scale];
}

export function zoomAt(camera: Camera, at: Point, factor: number): Camera {
  const scale = Math.min(Math.max(camera.scale * factor, 1e-2), 1e7);
  const real = scale / camera.scale;
  return { scale, x: at[0] - (at[0] - camera.x) * real, y: at[1] - (at[1] - camera.y) * real };
}

/** `foot`: height at the lower edge to keep free [px]. */
export function fitTo(box: { min: Point; max: Point }, whole: Size, margin = 0.16, foot = 0): Camera {
  const size = { width: whole.width, height: Math.max(whole.height - foot, 1) };
  const width = Math.max(box.max[0] - box.min[0], 1e-6);
  const height = Math.max(box.max[1] - box.min[1], 1e-6);
  const least = Math.max(width, height) * 0.4;
  const scale = (1 - 2 * margin) * Math.min(size.width / Math.max(width, least), size.height / Math.max(height, least));
  return {
    scale,
    x: size.width / 2 - ((box.min[0] + box.max[0]) / 2) * scale,
    y: size.height / 2 + ((box.min[1] + box.max[1]) / 2) * scale,
  };
}

/** The grid spacing [m]: 1, 2 or 5 times a power of ten, drawn 12 to 30 pixels apart. */
export function gridStep(camera: Camera): number {
  const raw = 12 / camera.scale;
  const power = 10 ** Math.floor(Math.log10(raw));
  const digit = raw / power;
  return (digit <= 1 ? 1 : digit <= 2 ? 2 : digit <= 5 ? 5 : 10) * power;
}

// The canvas: a scene, a camera, and the overlay of the active tool. It follows the page's state by itself; React takes
// no part in the animation loop.
import { isJustOpened, onOpened } from "../actions";
import { type Point, distance, toWorld } from "../model/geometry";
import { GROUND, type Model, extent, markerOf } from "../model/model";
import { player } from "../play/player";
import { type StudioState, studio } from "../state";
import { type Camera, type Size, fitTo, fromScreen, gridStep, toScreen, zoomAt } from "./camera";
import { type Looks, guideEnds, looksOf } from "./looks";
import { Scene } from "./scene";
import { make, path } from "./svg";
import { circle, polyline } from "./symbols";

export interface Preview {
  /** Rubber bands and outlines, in metres. */
  lines: Point[][];
  circle?: { centre: Point; radius: number };
  /** The point that a click would take, whether there is something to join, and whether the keys move it: then it has a cross. */
  snap?: { at: Point; joins: boolean; keyed?: boolean };
  box?: [Point, Point];
}

export class View {
  camera: Camera = { scale: 1000, x: 400, y: 300 };
  size: Size = { width: 800, height: 600 };
  looks: Looks = { bodies: new Map(), gears: [], guides: [] };
  readonly scene: Scene;
  private shown: Partial<StudioState> & { forceScale?: number; scale?: number } = {};
  private ghost: ((frame: ReturnType<typeof player.frame>) => void) | null = null;
  private preview: Preview | null = null;
  private fitted = false;
  /** The camera as set automatically: until the user moves it, the first run of a model may set it again. */
  private own: Camera | null = null;
  private ranOnce = false;
  private readonly ends: (() => void)[] = [];
  private readonly cameraListeners = new Set<() => void>();

  constructor(readonly svg: SVGSVGElement) {
    this.scene = new Scene(svg);
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(svg);
    this.ends.push(
      () => observer.disconnect(),
      player.onFrame(() => this.draw()),
      onOpened(() => {
        this.fitted = false;
        this.ranOnce = false;
        player.touch();
      }),
    );
    this.resize();
  }

  close(): void {
    for (const end of this.ends) end();
    this.svg.replaceChildren();
  }

  onCamera(listener: () => void): () => void {
    this.cameraListeners.add(listener);
    return () => this.cameraListeners.delete(listener);
  }

  private resize(): void {
    const { width, height } = this.svg.getBoundingClientRect();
    if (width === 0 || height === 0) return;
    const dx = (width - this.size.width) / 2;
    const dy = (height - this.size.height) / 2;
    this.size = { width, height };
    this.setCamera({ ...this.camera, x: this.camera.x + dx, y: this.camera.y + dy });
  }

  setCamera(camera: Camera): void {
    this.camera = camera;
    player.touch();
    for (const listener of this.cameraListeners) listener();
  }

  zoom(factor: number, at: Point = [this.size.width / 2, this.size.height / 2]): void {
    this.setCamera(zoomAt(this.camera, at, factor));
  }

  fit(): void {
    const { model, poses } = studio.get();
    const box = extent(model, poses ?? undefined);
    const run = player.reachOfRun();
    // Fitting a motion that goes far away would reduce the mechanism to a dot.
    const near = run && Math.max(run.max[0] - run.min[0], run.max[1] - run.min[1]) < 4 * box.size;
    const motion = near ? joined(box, run) : widened(model, box);
    this.setCamera(fitTo(model.bodies.length > 0 ? withGuides(motion, this.looks) : box, this.size, 0.13, 30));
    this.own = this.camera;
  }

  /** Converts pixels to metres. */
  metres(pixels: number): number {
    return pixels / this.camera.scale;
  }

  toWorld(at: Point): Point {
    return fromScreen(this.camera, at);
  }

  toScreen(at: Point): Point {
    return toScreen(this.camera, at);
  }

  show(preview: Preview | null): void {
    this.preview = preview;
    this.drawPreview();
  }

  private draw(): void {
    const now = studio.get();
    const { shown } = this;
    if (shown.model !== now.model) this.looks = looksOf(now.model, extent(now.model, now.poses ?? undefined).size, now.poses ?? undefined);
    if (!this.fitted && (now.poses || now.model.bodies.length === 0 || now.kernelState !== "starting")) {
      this.fitted = true;
      this.fit();
    }
    const forceScale = player.forceScale;
    if (!this.ranOnce && now.run.status === "done" && now.run.serial !== shown.run?.serial && now.model.bodies.length > 0) {
      this.ranOnce = true;
      this.stretchGuides(now.model);
      if (this.own === this.camera && isJustOpened(now.history)) this.fit();
    }
    const again =
      shown.model !== now.model || shown.show !== now.show || shown.scale !== this.camera.scale || Math.abs((shown.forceScale ?? 0) - forceScale) > 0.3 * forceScale;
    if (shown.poses === null && now.poses) this.looks = looksOf(now.model, extent(now.model, now.poses ?? undefined).size, now.poses ?? undefined);
    const ran = shown.run?.serial !== now.run.serial && this.stretchGuides(now.model);
    if (again || ran || (shown.poses === null && now.poses)) {
      if (again) this.stretchGuides(now.model);
      this.scene.show(now.model, this.looks, this.camera, { labels: now.show.labels, forces: now.show.forces, centres: now.show.centres, forceScale });
      this.ghost = this.scene.ghost(now.model, now.ghost.answer ? this.looks : null);
    } else if (shown.ghost !== now.ghost) this.ghost = this.scene.ghost(now.model, now.ghost.answer ? this.looks : null);
    if (again || shown.run?.serial !== now.run.serial) this.scene.traces(now.show.traces ? player.curves() : []);
    if (again || ran || shown.selection !== now.selection || shown.hover !== now.hover) this.scene.mark(now.selection, now.hover);
    this.scene.pan(this.camera);
    this.drawGrid(now.show.grid);
    this.scene.place(player.frame());
    const ghostFrame = this.ghost ? player.ghostFrame() : null;
    if (ghostFrame && this.ghost) this.ghost(ghostFrame);
    this.shown = { ...now, forceScale: again ? forceScale : shown.forceScale, scale: this.camera.scale };
    const pulling = player.pulling !== null;
    if (this.preview || pulling || this.wasPulling) this.drawPreview();
    this.wasPulling = pulling;
  }

  // A guide on the ground is extended to the length needed by the run.
  private stretchGuides(model: Model): boolean {
    let changed = false;
    for (const guide of this.looks.guides) {
      const range = guide.on === GROUND ? player.slides(guide.joint) : null;
      const joint = model.joints.find((one) => one.name === guide.joint);
      const marker = joint ? markerOf(model, guideEnds(joint).guide) : null;
      if (!range || !marker || joint?.second.body === GROUND) continue;
      const half = (range[1] - range[0]) / 2 + 34 / this.camera.scale;
      const middle = (range[0] + range[1]) / 2;
      guide.at = [marker.at[0] + middle * Math.cos(marker.axis), marker.at[1] + middle * Math.sin(marker.axis)];
      guide.reach = Math.min(half, 50 * this.size.width / this.camera.scale);
      changed = true;
    }
    return changed;
  }

  private wasPulling = false;

  private gridShown = "";

  private drawGrid(on: boolean): void {
    const { width, height } = this.size;
    const { camera } = this;
    const key = `${on} ${camera.scale} ${camera.x} ${camera.y} ${width} ${height}`;
    if (key === this.gridShown) return;
    this.gridShown = key;
    const layer = this.scene.layers.grid;
    layer.replaceChildren();
    if (!on) return;
    const step = gridStep(camera);
    const lines = (major: boolean): string => {
      const spacing = step * (major ? 5 : 1) * camera.scale;
      let d = "";
      for (let x = ((camera.x % spacing) + spacing) % spacing; x < width; x += spacing) d += `M${x.toFixed(1)} 0V${height}`;
      for (let y = ((camera.y % spacing) + spacing) % spacing; y < height; y += spacing) d += `M0 ${y.toFixed(1)}H${width}`;
      return d;
    };
    path(lines(false), "minor", layer);
    path(lines(true), "major", layer);
  }

  private drawPreview(): void {
    const layer = this.scene.layers.overlay;
    layer.replaceChildren();
    const px = ([x, y]: Point): Point => [x * this.camera.scale, -y * this.camera.scale];
    const { preview } = this;
    const pull = player.pulling;
    if (pull) {
      // A spring from the body's point to the pointer.
      const end = px(pull.target);
      path(polyline([px(toWorld(player.frame().pose(pull.body), pull.point)), end]), "pull", layer);
      path(circle(...end, 5), "pull-end", layer);
    }
    if (!preview) return;
    for (const line of preview.lines) path(polyline(line.map(px)), "rubber", layer);
    if (preview.circle) path(circle(...px(preview.circle.centre), Math.max(preview.circle.radius * this.camera.scale, 1)), "rubber", layer);
    if (preview.snap) path(circle(...px(preview.snap.at), preview.snap.joins ? 8 : 3.5), preview.snap.joins ? "snap joins" : "snap", layer);
    if (preview.snap?.keyed) {
      const [x, y] = px(preview.snap.at);
      path(`M${x - 16} ${y}H${x - 4}M${x + 4} ${y}H${x + 16}M${x} ${y - 16}V${y - 4}M${x} ${y + 4}V${y + 16}`, "cross", layer);
    }
    if (preview.box) {
      const [a, b] = preview.box.map(px) as [Point, Point];
      make("rect", { x: Math.min(a[0], b[0]), y: Math.min(a[1], b[1]), width: Math.abs(a[0] - b[0]), height: Math.abs(a[1] - b[1]), class: "lasso" }, layer);
    }
  }
}

function joined(a: { min: Point; max: Point }, b: { min: Point; max: Point }): { min: Point; max: Point } {
  return { min: [Math.min(a.min[0], b.min[0]), Math.min(a.min[1], b.min[1])], max: [Math.max(a.max[0], b.max[0]), Math.max(a.max[1], b.max[1])] };
}

function withGuides(box: { min: Point; max: Point }, looks: Looks): { min: Point; max: Point } {
  let { min, max } = box;
  for (const guide of looks.guides) {
    if (guide.on !== GROUND) continue;
    const dx = Math.abs(guide.reach * Math.cos(guide.axis));
    const dy = Math.abs(guide.reach * Math.sin(guide.axis));
    min = [Math.min(min[0], guide.at[0] - dx), Math.min(min[1], guide.at[1] - dy)];
    max = [Math.max(max[0], guide.at[0] + dx), Math.max(max[1], guide.at[1] + dy)];
  }
  return { min, max };
}

// Adds room for swinging links, which reach around their pins.
function widened(model: Model, box: { min: Point; max: Point; size: number }): { min: Point; max: Point } {
  let { min, max } = box;
  for (const joint of model.joints) {
    if (joint.type !== "revolute" || joint.first.body !== "ground") continue;
    const body = model.body.get(joint.second.body);
    const pin = body?.markers.find((marker) => marker.name === joint.second.marker);
    const at = model.ground.find((marker) => marker.name === joint.first.marker)?.at;
    if (!body || !pin || !at || model.bodies.length > 3) continue;
    const reach = Math.min(0.75 * Math.max(...body.markers.map((marker) => distance(marker.at, pin.at))), 0.75 * box.size);
    min = [Math.min(min[0], at[0] - reach), Math.min(min[1], at[1] - reach)];
    max = [Math.max(max[0], at[0] + reach), Math.max(max[1], at[1] + reach)];
  }
  return { min, max };
}

// The clock of the page: what the drawing shows at this moment. It replays the run, or takes frames of a live motion, and
// tells once a frame whoever draws.
import { asFault, say } from "../actions";
import type { Frame } from "../drawing/scene";
import type { LiveSession } from "../kernel/kernel";
import type { LiveFrame, Pull } from "../kernel/protocol";
import { ORIGIN, type Point, type Pose } from "../model/geometry";
import { poseOf } from "../model/model";
import { studio } from "../state";
import { kernel } from "./desk";
import { Replay } from "./replay";

/** Frames of a live motion that can be scrubbed through; at sixty a second, a minute and a half. */
const RECORD = 5400;

interface Live {
  session: LiveSession;
  index: Map<string, number>;
  frames: LiveFrame[];
  /** The frame shown; the last one while it plays. */
  shown: number;
}

class Player {
  t = 0;
  /** Longest force of what is shown, for the arrows [N]. */
  forceScale = 0;
  private replay: Replay | null = null;
  private ghostReplay: Replay | null = null;
  private serial = -1;
  private live: Live | null = null;
  private opening = false;
  private asking = false;
  private pull: Pull | null = null;
  private before = 0;
  private readonly listeners = new Set<() => void>();
  private dirty = true;

  constructor() {
    studio.subscribe(() => {
      this.dirty = true;
    });
  }

  /** Begins the loop. */
  start(): void {
    const tick = (now: number) => {
      const elapsed = Math.min((now - this.before) / 1e3, 0.1);
      this.before = now;
      this.advance(elapsed);
      if (this.dirty) {
        this.dirty = false;
        for (const listener of this.listeners) listener();
      }
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  /** Called when there is something new to draw, at most once a frame. */
  onFrame(listener: () => void): () => void {
    this.listeners.add(listener);
    this.dirty = true;
    return () => this.listeners.delete(listener);
  }

  touch(): void {
    this.dirty = true;
  }

  get duration(): number {
    if (this.live) return Math.max(this.live.frames[this.live.frames.length - 1]?.t ?? 0, 1e-9);
    return this.current()?.end ?? studio.get().model.duration ?? 1;
  }

  /** Model time where the scale begins. */
  get begin(): number {
    return this.live?.frames[0]?.t ?? 0;
  }

  /** Decimals of the clock: as many as tell two frames apart, three at least. */
  get digits(): number {
    const step = this.live ? 0.01 : (this.current()?.step ?? 0.01);
    return Math.min(Math.max(3, Math.ceil(-Math.log10(step) - 1e-9)), 7);
  }

  get behind(): boolean {
    return this.live?.frames[this.live.frames.length - 1]?.behind ?? false;
  }

  private current(): Replay | null {
    const { run, ghost } = studio.get();
    if (run.serial !== this.serial) {
      this.serial = run.serial;
      this.replay = run.answer && (run.answer.values[0]?.length ?? 0) > 1 ? new Replay(run.answer) : null;
      this.forceScale = this.replay?.typicalForce ?? 0;
      if (this.replay && this.t > this.replay.end) this.t = this.replay.end;
    }
    if (this.ghostReplay?.answer !== ghost.answer) this.ghostReplay = ghost.answer ? new Replay(ghost.answer) : null;
    return this.replay;
  }

  private advance(elapsed: number): void {
    const { mode, playing, speed, loop } = studio.get();
    if (mode === "live") return this.advanceLive(playing ? elapsed * speed : 0);
    if (mode !== "replay" || !playing) return;
    const replay = this.current();
    if (!replay) return;
    this.t += elapsed * speed;
    if (this.t >= replay.end) {
      if (loop) this.t = replay.end > 0 ? this.t % replay.end : 0;
      else {
        this.t = replay.end;
        studio.set({ playing: false });
      }
    }
    this.dirty = true;
  }

  private advanceLive(dt: number): void {
    const live = this.live;
    if (!live || this.asking || (dt === 0 && !this.pull)) return;
    if (dt === 0) return;
    this.asking = true;
    live.session
      .advance(Math.min(dt, 0.05), this.pull, 0.03)
      .then((frame) => {
        live.frames.push(frame);
        if (live.frames.length > RECORD) live.frames.splice(0, RECORD / 10);
        live.shown = live.frames.length - 1;
        this.t = frame.t;
        if (frame.error) studio.set({ obstacle: frame.error });
        this.dirty = true;
      })
      .catch((error: unknown) => {
        say(`The live motion ended: ${asFault(error).message}`);
        this.leaveLive();
      })
      .finally(() => {
        this.asking = false;
      });
  }

  private leaveLive(): void {
    this.live?.session.close();
    this.live = null;
    studio.set({ mode: "edit", playing: false });
  }

  /** Play or pause: the run where there is one, else the live motion. */
  toggle(): void {
    const { playing, mode, model } = studio.get();
    if (playing) return studio.set({ playing: false });
    if (model.bodies.length === 0) return say("Draw a link first, or open a template.");
    if (mode === "live") return studio.set({ playing: true });
    const replay = this.current();
    if (replay && studio.get().run.status !== "running") {
      if (this.t >= replay.end * 0.9999) this.t = 0;
      studio.set({ mode: "replay", playing: true, tool: "select" });
    } else void this.goLive(0);
  }

  /** Back to the start and to drawing. */
  stop(): void {
    this.live?.session.close();
    this.live = null;
    this.pull = null;
    this.t = 0;
    studio.set({ mode: "edit", playing: false });
    this.dirty = true;
  }

  seek(t: number): void {
    const live = this.live;
    if (live && studio.get().mode === "live") {
      let at = live.frames.findIndex((frame) => frame.t >= t);
      if (at < 0) at = live.frames.length - 1;
      live.shown = Math.max(at, 0);
      this.t = live.frames[live.shown]?.t ?? 0;
      studio.set({ playing: false });
    } else {
      this.t = Math.min(Math.max(t, 0), this.duration);
      if (this.current()) studio.set({ mode: "replay" });
    }
    this.dirty = true;
  }

  /** One frame on or back. */
  step(direction: number): void {
    studio.set({ playing: false });
    this.seek(this.t + direction * (this.current()?.step ?? 0.01));
  }

  /** Starts a live motion at model time t, where the replay stands. */
  async goLive(t = this.t): Promise<void> {
    if (this.opening) return;
    this.opening = true;
    try {
      const { history } = studio.get();
      const session = await kernel.openLive(history.text);
      let frames: LiveFrame[] = [];
      if (t > 0) {
        for (let now = 0, guard = 0; now < t * (1 - 1e-9) && guard < 400; guard++) {
          const frame = await session.advance(t - now, null, 0.25);
          frames = [frame];
          if (frame.t <= now) break;
          now = frame.t;
        }
      }
      this.live?.session.close();
      const index = new Map(session.start.bodies.map((name, i): [string, number] => [name, i]));
      this.live = { session, index, frames, shown: frames.length - 1 };
      this.forceScale = Math.max(session.start.force_scale, this.replay?.typicalForce ?? 0);
      studio.set({ mode: "live", playing: true, tool: "select" });
    } catch (error) {
      studio.set({ obstacle: asFault(error), dock: "problems" });
    } finally {
      this.opening = false;
    }
  }

  /** Pulls a point of a body; null lets go. Where a replay runs it becomes a live motion. */
  setPull(pull: Pull | null): void {
    this.pull = pull;
    if (pull && studio.get().mode !== "live") void this.goLive();
    else if (pull && !studio.get().playing) studio.set({ playing: true });
    this.dirty = true;
  }

  get pulling(): Pull | null {
    return this.pull;
  }

  /** Where everything is now. */
  frame(): Frame {
    const { mode, model, poses } = studio.get();
    const still = (name: string): Pose => poseOf(model, name, poses ?? undefined);
    const live = this.live;
    if (mode === "live" && live) {
      const frame = live.frames[live.shown];
      const flat = frame?.poses ?? live.session.start.poses;
      return {
        pose: (name) => {
          const i = live.index.get(name);
          return i === undefined ? (name === "ground" ? ORIGIN : still(name)) : { x: flat[3 * i]!, y: flat[3 * i + 1]!, angle: flat[3 * i + 2]! };
        },
        forces: frame?.joint_forces ?? null,
      };
    }
    const replay = this.current();
    if (mode !== "replay" || !replay) return { pose: still, forces: null };
    return replay.frame(this.t, model, still);
  }

  ghostFrame(): Frame | null {
    this.current();
    const { mode, model } = studio.get();
    return this.ghostReplay ? this.ghostReplay.frame(mode === "edit" ? 0 : this.t, model, (name) => poseOf(model, name)) : null;
  }

  /** What the mechanism passes over in the run. */
  reachOfRun(): { min: Point; max: Point } | null {
    return this.current()?.box(studio.get().model) ?? null;
  }

  /** Between which slides a sliding joint moves in the run [m]. */
  slides(joint: string): [number, number] | null {
    return this.current()?.range(joint, "slide") ?? null;
  }

  /** Paths of the traced points over the whole run. */
  curves(): { points: Float64Array; tone: number }[] {
    const replay = this.current();
    if (!replay) return [];
    const curves: { points: Float64Array; tone: number }[] = [];
    studio.get().model.bodies.forEach((body, tone) => {
      for (const marker of body.markers) if (marker.traced) curves.push({ points: replay.path(body.name, marker.at), tone });
    });
    return curves;
  }
}

export const player = new Player();

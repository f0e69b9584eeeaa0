// The clock of the page: what the drawing shows at this moment. It replays the run, or takes frames of a live motion, and
// notifies the drawing code once per frame.
import { asFault, onOpened, say } from "../actions";
import type { Frame } from "../drawing/scene";
import type { Fault, LiveFrame, Pull } from "../kernel/protocol";
import type { Point, Pose } from "../model/geometry";
import { poseOf } from "../model/model";
import { studio } from "../state";
import { kernel } from "./kernel-session";
import { Live } from "./live";
import { Replay } from "./replay";

/** If the text changes more often than this, the live motion follows it only after a pause [ms]. */
const REST = 120;

class Player {
  t = 0;
  private replay: Replay | null = null;
  private ghostReplay: Replay | null = null;
  private serial = -1;
  private live: Live | null = null;
  /** Counts requests for live motions: a session that opens for an outdated request is closed again. */
  private wish = 0;
  private starting = false;
  /** The newest text that the live motion was told to follow. */
  private followed = "";
  private restTimer: ReturnType<typeof setTimeout> | undefined;
  private pull: Pull | null = null;
  private before = 0;
  private readonly listeners = new Set<() => void>();
  private readonly failures = new Set<string>();
  private dirty = true;

  constructor() {
    studio.subscribe(() => {
      this.dirty = true;
      this.follow();
    });
    onOpened(() => this.endLive());
  }

  /** Starts the loop. */
  start(): void {
    const tick = (now: number) => {
      requestAnimationFrame(tick);
      const elapsed = Math.min((now - this.before) / 1e3, 0.1);
      this.before = now;
      this.attempt(() => this.advance(elapsed));
      if (!this.dirty) return;
      this.dirty = false;
      for (const listener of this.listeners) this.attempt(listener);
    };
    requestAnimationFrame(tick);
  }

  // What fails in one frame may succeed in the next. It is reported once, not sixty times a second.
  private attempt(work: () => void): void {
    try {
      work();
    } catch (error) {
      const { message } = asFault(error);
      if (this.failures.has(message)) return;
      this.failures.add(message);
      console.error(error);
      say(`The drawing failed: ${message}. It is retried after every change.`);
    }
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
    if (this.live) return Math.max(this.live.end, 1e-9);
    return this.current()?.end ?? studio.get().model.duration ?? 1;
  }

  /** Model time at the start of the scale. */
  get begin(): number {
    return this.live?.begin ?? 0;
  }

  /** Decimals of the clock: enough to distinguish two frames, at least three. */
  get digits(): number {
    const step = this.live ? 0.01 : (this.current()?.step ?? 0.01);
    return Math.min(Math.max(3, Math.ceil(-Math.log10(step) - 1e-9)), 7);
  }

  get behind(): boolean {
    return this.live?.behind ?? false;
  }

  /** Longest force shown, for the arrows [N]. */
  get forceScale(): number {
    return Math.max(this.current()?.typicalForce ?? 0, this.live?.session.start.force_scale ?? 0);
  }

  /** A live motion has been requested and has not started yet. */
  get opening(): boolean {
    return this.starting;
  }

  private current(): Replay | null {
    const { run, ghost } = studio.get();
    if (run.serial !== this.serial) {
      this.serial = run.serial;
      this.replay = run.answer && (run.answer.values[0]?.length ?? 0) > 1 ? new Replay(run.answer) : null;
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
    const { live } = this;
    if (!live || live.asking || dt === 0) return;
    live.asking = true;
    live.session
      .advance(Math.min(dt, 0.05), this.pull, 0.03)
      .then((frame) => {
        if (this.live !== live) return;
        live.take(frame);
        this.t = frame.t;
        this.tell(live, frame.error);
        this.dirty = true;
      })
      .catch((error: unknown) => {
        if (this.live !== live) return;
        say(`The live motion ended: ${asFault(error).message}`);
        this.stop();
      })
      .finally(() => {
        live.asking = false;
      });
  }

  // An obstacle that does not come from the motion, but from assembly or reading, is left alone.
  private tell(live: Live, fault: Fault | null): void {
    const { obstacle } = studio.get();
    if (obstacle !== null && obstacle !== live.fault) return;
    if (obstacle?.message === fault?.message) return;
    live.fault = fault;
    studio.set({ obstacle: fault });
  }

  // A live motion is tied to its mode and its text.
  private follow(): void {
    const { mode, tool, history } = studio.get();
    if (this.starting && tool !== "select") return this.endLive();
    if (!this.live) return;
    if (mode !== "live") return this.endLive();
    if (history.text === this.followed) return;
    this.followed = history.text;
    this.wish++;
    clearTimeout(this.restTimer);
    this.restTimer = setTimeout(() => void this.reopen(), REST);
  }

  // The changed mechanism continues from the state of the old one. While its text is rejected, which the kernel session reports, the old one keeps moving.
  private async reopen(): Promise<void> {
    const old = this.live;
    const { history, stale, model } = studio.get();
    if (!old || stale || history.text === old.text) return;
    if (model.bodies.length === 0) return this.stop();
    const mine = ++this.wish;
    // A position as a function of time would jump, because the clock of a new session starts at 0.
    const like = model.motors.some((motor) => motor.kind === "position") ? undefined : old.session;
    const session = await kernel.openLive(history.text, { like }).catch(() => null);
    if (!session) return;
    if (mine !== this.wish) return session.close();
    this.tell(old, null);
    old.session.close();
    this.live = new Live(session, history.text);
    this.t = 0;
    this.dirty = true;
  }

  private endLive(): void {
    this.wish++;
    this.starting = false;
    this.pull = null;
    clearTimeout(this.restTimer);
    const { live } = this;
    this.live = null;
    if (!live) return;
    live.session.close();
    this.tell(live, null);
  }

  /** Play or pause: the run if there is one, else the live motion. */
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
    this.endLive();
    this.t = 0;
    studio.set({ mode: "edit", playing: false });
    this.dirty = true;
  }

  seek(t: number): void {
    if (this.live) {
      this.t = this.live.seek(t);
      studio.set({ playing: false });
    } else {
      this.t = Math.min(Math.max(t, 0), this.duration);
      if (this.current()) studio.set({ mode: "replay" });
    }
    this.dirty = true;
  }

  /** One frame forwards or back. */
  step(direction: number): void {
    studio.set({ playing: false });
    this.seek(this.t + direction * (this.current()?.step ?? 0.01));
  }

  /** Starts a live motion at model time t, from the state of the replay. */
  async goLive(t = this.t): Promise<void> {
    if (this.starting) return;
    if (this.live) return studio.set({ playing: true });
    const mine = ++this.wish;
    this.starting = true;
    try {
      studio.set({ tool: "select" });
      const live = await this.opened(t, () => mine === this.wish);
      if (!live) return;
      this.starting = false;
      this.live = live;
      this.followed = live.text;
      studio.set({ mode: "live", playing: true });
    } catch (error) {
      if (mine !== this.wish) return;
      this.endLive();
      studio.set({ obstacle: asFault(error), dock: "problems" });
    }
  }

  // Null if it is no longer wanted.
  private async opened(t: number, wanted: () => boolean): Promise<Live | null> {
    const { text } = studio.get().history;
    const session = await kernel.openLive(text);
    let last: LiveFrame | null = null;
    for (let now = 0, guard = 0; wanted() && now < t * (1 - 1e-9) && guard < 400; guard++) {
      last = await session.advance(t - now, null, 0.25);
      if (last.t <= now) break;
      now = last.t;
    }
    if (!wanted()) {
      session.close();
      return null;
    }
    const live = new Live(session, text);
    if (last) live.take(last);
    return live;
  }

  /** Pulls a point of a body; null releases it. A running replay becomes a live motion. */
  setPull(pull: Pull | null): void {
    this.pull = pull;
    if (pull && studio.get().mode !== "live") void this.goLive();
    else if (pull && !studio.get().playing) studio.set({ playing: true });
    this.dirty = true;
  }

  get pulling(): Pull | null {
    return this.pull;
  }

  /** The current poses and forces. */
  frame(): Frame {
    const { mode, model, poses } = studio.get();
    const still = (name: string): Pose => poseOf(model, name, poses ?? undefined);
    if (this.live) return this.live.frame(model, still);
    const replay = this.current();
    if (mode !== "replay" || !replay) return { pose: still, forces: null };
    return replay.frame(this.t, model, still);
  }

  /** The force on a joint's second body in the live motion, if that has it. */
  liveForce(joint: string): readonly [number, number] | null {
    return this.live?.force(joint) ?? null;
  }

  ghostFrame(): Frame | null {
    this.current();
    const { mode, model } = studio.get();
    return this.ghostReplay ? this.ghostReplay.frame(mode === "edit" ? 0 : this.t, model, (name) => poseOf(model, name)) : null;
  }

  /** The area that the mechanism covers during the run. */
  reachOfRun(): { min: Point; max: Point } | null {
    return this.current()?.box(studio.get().model) ?? null;
  }

  /** The range of slide of a sliding joint in the run [m]. */
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

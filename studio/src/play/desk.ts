// Keeps what follows from the text up to date: complaints, assembled poses, the check's report, the run. Whatever is asked
// for an older text is forgotten when it answers.
import { asFault, localComplaints } from "../actions";
import { type DragSession, type Kernel, type RunHandle, startKernel } from "../kernel/kernel";
import type { Catalog, Fault, RunAnswer, RunProgress } from "../kernel/protocol";
import { type Pose, distance, toWorld } from "../model/geometry";
import type { Poses } from "../model/model";
import { NO_RUN, studio } from "../state";
import { runWhereFastest } from "./long-run";

export const kernel: Kernel = startKernel();

let generation = 0;
let drag: DragSession | null = null;
let running: RunHandle | null = null;
let timer: ReturnType<typeof setTimeout> | undefined;

let catalogAnswer: Promise<Catalog> | null = null;
export const catalog = (): Promise<Catalog> => (catalogAnswer ??= kernel.catalog());
let schemaAnswer: Promise<Record<string, unknown>> | null = null;
export const schema = (): Promise<Record<string, unknown>> => (schemaAnswer ??= kernel.schema());

/** Watches the text for as long as the page is there. */
export function startDesk(): void {
  let text: string | null = null;
  const look = () => {
    const now = studio.get().history.text;
    if (now === text) return;
    text = now;
    clearTimeout(timer);
    timer = setTimeout(() => void refresh(now), 40);
  };
  studio.subscribe(look);
  look();
}

export function posesFrom(bodies: readonly string[], flat: ArrayLike<number>): Poses {
  return new Map(bodies.map((name, i): [string, Pose] => [name, { x: flat[3 * i]!, y: flat[3 * i + 1]!, angle: flat[3 * i + 2]! }]));
}

async function refresh(text: string): Promise<void> {
  const mine = ++generation;
  const current = () => mine === generation;
  running?.cancel();
  running = null;
  const document = studio.get().model.document;
  if (studio.get().stale || document.text !== text) return;
  try {
    const read = await kernel.read(text);
    if (!current()) return;
    studio.set({ kernelState: "ready", complaints: [...localComplaints(document), ...read.complaints] });
    if (!read.ok) {
      studio.set({ obstacle: null, report: null, run: { ...NO_RUN, answer: studio.get().run.answer, serial: studio.get().run.serial } });
      return;
    }
    await assemble(text, current);
    if (!current()) return;
    startRun(text, current);
    void check(text, current);
  } catch (error) {
    if (current()) complain(asFault(error));
  }
}

function complain(fault: Fault): void {
  studio.set({ run: { ...studio.get().run, status: "failed", progress: null }, obstacle: fault, ...(fault.kind === "missing" ? { kernelState: "missing" as const } : {}) });
}

async function assemble(text: string, current: () => boolean): Promise<void> {
  if (studio.get().model.bodies.length === 0) {
    studio.set({ poses: null, obstacle: null, report: null, run: { ...NO_RUN, serial: studio.get().run.serial + 1 } });
    return;
  }
  const session = await kernel.openDrag(text);
  if (!current()) return session.close();
  drag?.close();
  drag = session;
  const answer = await session.assemble();
  if (!current()) return;
  studio.set({ poses: posesFrom(session.bodies, answer.poses), obstacle: answer.ok ? null : (answer.reason ?? { message: "The mechanism does not close.", hint: "" }) });
}

async function check(text: string, current: () => boolean): Promise<void> {
  if (studio.get().model.bodies.length === 0) return;
  const ask = () => kernel.check(text);
  const report = await ask().catch((error: unknown) => (wasEnded(error) ? ask() : null)).catch(() => null);
  if (current()) studio.set({ report });
}

function startRun(text: string, current: () => boolean): void {
  const { model, run, ghost } = studio.get();
  if (model.bodies.length === 0) return;
  if (model.duration === null) return studio.set({ run: { ...NO_RUN, status: "failed", serial: run.serial, fault: { message: "The model says no duration.", hint: "Set one in Model, Simulation." } } });
  studio.set({ run: { ...run, status: "running", progress: null, fault: null } });
  const told = (progress: RunProgress) => {
    if (current()) studio.set((now) => ({ run: { ...now.run, progress } }));
  };
  const handle = runWhereFastest(kernel, text, () => studio.get().folder !== null, told);
  running = handle;
  handle.result
    .then((answer) => {
      if (!current()) return;
      running = null;
      studio.set((now) => ({ run: { status: answer.outcome === "failed" ? "failed" : "done", answer, progress: null, fault: null, serial: now.run.serial + 1 } }));
      if (ghost.on) void runGhost(text, current);
    })
    .catch((error: unknown) => {
      if (!current()) return;
      // Ended along with another run that did not stop in time, and not by the user: asked again.
      if (running === handle && wasEnded(error)) return startRun(text, current);
      studio.set((now) => ({ run: { ...NO_RUN, status: "failed", fault: asFault(error), serial: now.run.serial + 1 } }));
    });
}

async function runGhost(text: string, current: () => boolean): Promise<void> {
  const answer = await kernel.run(text, { set: { "simulate.equations": "ideal" } }).result.catch(() => null);
  if (current()) studio.set((now) => ({ ghost: { ...now.ghost, answer } }));
}

/** Shows or hides the run with ideal joints behind the model's own. */
export function setGhost(on: boolean): void {
  studio.set((now) => ({ ghost: { on, answer: on ? now.ghost.answer : null } }));
  const mine = generation;
  if (on) void runGhost(studio.get().history.text, () => mine === generation);
}

export function cancelRun(): void {
  running?.cancel();
  running = null;
}

const wasEnded = (error: unknown): boolean => asFault(error).kind === "ended";

/** Drags a point of a body while nothing runs: one question at a time, the newest target wins. */
export class KinematicDrag {
  private busy = false;
  private waiting: [number, number] | null = null;
  private last: Float64Array | undefined;
  private left = Number.POSITIVE_INFINITY;
  poses: Poses | null = null;

  constructor(
    private readonly body: string,
    private readonly point: [number, number],
  ) {}

  to(target: [number, number]): void {
    this.waiting = target;
    if (!this.busy) void this.next();
  }

  private async next(): Promise<void> {
    const session = drag;
    this.busy = true;
    while (this.waiting && session) {
      const target = this.waiting;
      this.waiting = null;
      const answer = await session.assemble({ body: this.body, point: this.point, target }, this.last).catch(() => null);
      if (!answer) break;
      if (answer.poses.length === 0) continue;
      this.last = answer.poses.slice();
      this.poses = posesFrom(session.bodies, answer.poses);
      studio.set({ poses: this.poses });
      // The hold is soft: it is asked again while the point still comes nearer.
      const pose = this.poses.get(this.body);
      const left = pose ? distance(toWorld(pose, this.point), target) : 0;
      if (!this.waiting && left < 0.98 * this.left && left > 1e-6) this.waiting = target;
      this.left = this.waiting === target ? left : Number.POSITIVE_INFINITY;
    }
    this.busy = false;
  }
}

export type { RunAnswer };

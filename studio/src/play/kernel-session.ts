// Keeps everything derived from the text up to date: complaints, assembled poses, the check's report, the run. Answers for
// an older text are discarded.
import { asFault, localComplaints, onOpened, say } from "../actions";
import { type DragSession, type Kernel, type RunHandle, startKernel } from "../kernel/kernel";
import type { NamedFiles } from "../kernel/named-files";
import type { Catalog, Fault, RunAnswer, RunProgress } from "../kernel/protocol";
import { type Pose, distance, toWorld } from "../model/geometry";
import type { Poses } from "../model/model";
import { quantity } from "../model/units";
import { NO_RUN, studio } from "../state";
import { runWhereFastest } from "./long-run";

export const kernel: Kernel = startKernel({ files: () => studio.get().files });

let generation = 0;
let drag: DragSession | null = null;
let running: RunHandle | null = null;
let ghostRun: RunHandle | null = null;
let timer: ReturnType<typeof setTimeout> | undefined;

let catalogAnswer: Promise<Catalog> | null = null;
export const catalog = (): Promise<Catalog> => (catalogAnswer ??= kernel.catalog());
let schemaAnswer: Promise<Record<string, unknown>> | null = null;
export const schema = (): Promise<Record<string, unknown>> => (schemaAnswer ??= kernel.schema());

/** Watches the text, and the files that it names, for the lifetime of the page. */
export function startKernelSession(): void {
  let text: string | null = null;
  let files: NamedFiles | null = null;
  const look = () => {
    const { history, files: named } = studio.get();
    const now = history.text;
    if (now === text && named === files) return;
    text = now;
    files = named;
    forget();
    clearTimeout(timer);
    timer = setTimeout(() => void refresh(now), 40);
  };
  studio.subscribe(look);
  // Opening the text that is already open leaves it unchanged, but discards everything computed for it.
  onOpened(() => {
    text = null;
    look();
  });
  look();
}

/** From now on, what is under way and what can be dragged belongs to an older text. */
function forget(): void {
  generation++;
  running?.cancel();
  running = null;
  drag?.close();
  drag = null;
  dropGhost();
}

export function posesFrom(bodies: readonly string[], flat: ArrayLike<number>): Poses {
  return new Map(bodies.map((name, i): [string, Pose] => [name, { x: flat[3 * i]!, y: flat[3 * i + 1]!, angle: flat[3 * i + 2]! }]));
}

async function refresh(text: string): Promise<void> {
  const mine = generation;
  const current = () => mine === generation;
  const document = studio.get().model.document;
  if (document.text !== text) return;
  if (studio.get().stale) return studio.set({ complaints: localComplaints(document) });
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
    check(text, current);
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
  drag = session;
  const answer = await session.assemble();
  if (!current()) return;
  studio.set({ poses: posesFrom(session.bodies, answer.poses), obstacle: answer.ok ? null : (answer.reason ?? { message: "The mechanism does not close.", hint: "" }) });
}

let checking: Promise<unknown> = Promise.resolve();

// One check at a time: of the texts that arrive during a long check, only the last is checked.
function check(text: string, current: () => boolean): void {
  if (studio.get().model.bodies.length === 0) return;
  checking = checking.then(async () => {
    if (!current()) return;
    const report = await kernel.check(text).catch(() => null);
    if (current()) studio.set({ report });
  });
}

function startRun(text: string, current: () => boolean): void {
  const { model, run } = studio.get();
  if (model.bodies.length === 0) return;
  if (model.duration === null) return studio.set({ run: { ...NO_RUN, status: "failed", serial: run.serial, fault: { message: "The model has no duration.", hint: "Set one in Model, Simulation." } } });
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
      runGhost(text);
    })
    .catch((error: unknown) => {
      if (!current()) return;
      // The run was ended together with another one that did not stop in time, and not by the user: it is started again.
      if (running === handle && wasEnded(error)) return startRun(text, current);
      studio.set((now) => ({ run: { ...NO_RUN, status: "failed", fault: asFault(error), serial: now.run.serial + 1 } }));
    });
}

function runGhost(text: string): void {
  const { on, answer } = studio.get().ghost;
  if (!on || answer || ghostRun) return;
  const handle = kernel.run(text, { set: { "simulate.equations": "ideal" } });
  ghostRun = handle;
  handle.result
    .then((found) => {
      if (ghostRun !== handle) return;
      ghostRun = null;
      studio.set({ ghost: { on: true, answer: found } });
      if (found.stopped) say(`With ideal joints the run stopped at ${quantity(found.stopped.time, "s")}: ${found.stopped.reason}`);
    })
    .catch((error: unknown) => {
      if (ghostRun !== handle) return;
      ghostRun = null;
      if (wasEnded(error)) return runGhost(text);
      say(`No motion with ideal joints: ${asFault(error).message}`);
    });
}

// Its run is ended too; answers that still arrive are ignored.
function dropGhost(): void {
  ghostRun?.cancel();
  ghostRun = null;
  studio.set((now) => (now.ghost.answer ? { ghost: { ...now.ghost, answer: null } } : {}));
}

/** Shows or hides the run with ideal joints behind the model's own run. */
export function setGhost(on: boolean): void {
  dropGhost();
  studio.set({ ghost: { on, answer: null } });
  const { history, run, model, stale } = studio.get();
  // While the model's own run is being computed, the ghost waits for it.
  if (on && run.status !== "running" && !stale && model.bodies.length > 0) runGhost(history.text);
}

export function cancelRun(): void {
  running?.cancel();
  running = null;
}

const wasEnded = (error: unknown): boolean => asFault(error).kind === "ended";

/** Drags a point of a body while nothing is running: one request at a time, and the newest target wins. */
export class KinematicDrag {
  private busy = false;
  private waiting: [number, number] | null = null;
  private last: Float64Array | undefined;
  private session: DragSession | null = null;
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
    if (session !== this.session) this.last = undefined;
    this.session = session;
    this.busy = true;
    while (this.waiting && session) {
      const target = this.waiting;
      this.waiting = null;
      const answer = await session.assemble({ body: this.body, point: this.point, target }, this.last).catch(() => null);
      if (!answer || session !== drag) break;
      if (answer.poses.length === 0) continue;
      this.last = answer.poses.slice();
      this.poses = posesFrom(session.bodies, answer.poses);
      studio.set({ poses: this.poses });
      // The hold is soft: the request is repeated as long as the point still approaches the target.
      const pose = this.poses.get(this.body);
      const left = pose ? distance(toWorld(pose, this.point), target) : 0;
      if (!this.waiting && left < 0.98 * this.left && left > 1e-6) this.waiting = target;
      this.left = this.waiting === target ? left : Number.POSITIVE_INFINITY;
    }
    this.busy = false;
  }
}

export type { RunAnswer };

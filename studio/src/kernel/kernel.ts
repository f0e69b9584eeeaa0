// The page's side of the kernel: typed calls that return promises. Five workers, each started when first needed: for quick
// questions, for the motion during playback, for checks, runs and reports; so that no slow call delays the others.
import { KernelFault } from "./fault";
import type { FromWorker, ToWorker } from "./messages";
import { type NamedFiles, filesNamedIn, withNamedFiles } from "./named-files";
import { findNativeServer, type NativeServer } from "./native";
import type {
  AssemblyAnswer, Catalog, CheckReport, Fault, Hold, LiveFrame, LiveStart, ModelTree, Pull, ReadAnswer, RunAnswer, RunProgress,
  TextAnswer,
} from "./protocol";

export { KernelFault };

export interface RunOptions {
  /** "native": on the server of `pintle studio`, if it serves the page. */
  where?: "browser" | "native";
  onProgress?: (progress: RunProgress) => void;
  /** Settings that differ from the model's, by path: {"simulate.tolerance": "1e-3"}. */
  set?: Record<string, string>;
  /** Files for the text to name, if it is not the open model. */
  files?: NamedFiles;
}

export interface RunHandle {
  result: Promise<RunAnswer>;
  /** Ends the run; `result` then has what was computed so far, with outcome "interrupted". */
  cancel(): void;
}

/** Kinematic drag: the model is read once and assembled in every frame. */
export interface DragSession {
  bodies: string[];
  joints: string[];
  /** Poses that close every loop, with the held point as near to its target as they allow; starts from the last answer. */
  assemble(hold?: Hold, from?: Float64Array): Promise<AssemblyAnswer>;
  close(): void;
}

export interface LiveSession {
  start: LiveStart;
  /** Advances by dt of model time [s]; `budget` is the wall time it may take [s]. */
  advance(dt: number, pull?: Pull | null, budget?: number): Promise<LiveFrame>;
  close(): void;
}

export interface LiveOptions {
  /** Start in the state of another session of (nearly) the same model: bodies are matched by name. */
  like?: LiveSession;
}

export interface Kernel {
  schema(): Promise<Record<string, unknown>>;
  catalog(): Promise<Catalog>;
  read(text: string): Promise<ReadAnswer>;
  /** The tree as TOML. The tree contains no comments. */
  write(model: ModelTree): Promise<TextAnswer>;
  check(text: string): Promise<CheckReport>;
  openDrag(text: string): Promise<DragSession>;
  openLive(text: string, options?: LiveOptions): Promise<LiveSession>;
  run(text: string, options?: RunOptions): RunHandle;
  /** The page of `pintle report` for a run of the model, which is run again for this. */
  report(text: string, onProgress?: (progress: RunProgress) => void): Promise<string>;
  /** The server of `pintle studio`: files of its folder, native runs. Null if another server serves the page. */
  native(): Promise<NativeServer | null>;
  /** Ends the workers. */
  stop(): void;
}

type Role = "session" | "live" | "check" | "run" | "report";

interface Pending {
  resolve(value: unknown): void;
  reject(error: KernelFault): void;
  onProgress?: (progress: RunProgress) => void;
  /** Set by the first call to `hurry`. */
  fault?: Fault;
  timer?: ReturnType<typeof setTimeout>;
}

export interface CallOptions {
  onProgress?: (progress: RunProgress) => void;
  goOn?: string;
  files?: NamedFiles;
}

interface Call {
  id: number;
  result: Promise<unknown>;
}

/** One worker and its unanswered calls. A worker that dies is replaced; its calls are rejected. */
class Line {
  private worker: Worker | undefined;
  private pending = new Map<number, Pending>();
  private next = 1;
  private answered = false;

  constructor(
    private readonly makeWorker: () => Worker,
    private readonly kernelUrl: string,
    private readonly files: () => NamedFiles,
  ) {}

  call(name: string, args: unknown, options: CallOptions = {}): Call {
    const id = this.next++;
    const result = new Promise((resolve, reject) => {
      this.pending.set(id, { resolve, reject, onProgress: options.onProgress });
      try {
        this.start().postMessage({ id, call: name, args: withNamedFiles(args, options.files ?? this.files()), kernelUrl: this.kernelUrl, goOn: options.goOn } satisfies ToWorker);
      } catch (error) {
        this.pending.delete(id);
        reject(new KernelFault({ kind: "missing", message: `The kernel cannot be called: ${String(error)}`, hint: "Reload the page." }));
      }
    });
    return { id, result };
  }

  /** Ends the worker unless the call is answered within the grace period, which starts when its turn comes. */
  hurry(id: number, fault: Fault) {
    const call = this.pending.get(id);
    if (!call) return;
    call.fault = fault;
    this.watchFirst();
  }

  // A worker answers in the order of the calls: only the first call has begun.
  private watchFirst() {
    const [first] = this.pending.values();
    if (!first?.fault || first.timer !== undefined) return;
    const { fault } = first;
    first.timer = setTimeout(() => this.abandon(fault), kGrace);
  }

  /** Ends the worker; the next call starts a new one. */
  abandon(fault: Fault) {
    this.worker?.terminate();
    this.worker = undefined;
    const lost = [...this.pending.values()];
    this.pending.clear();
    for (const call of lost) {
      clearTimeout(call.timer);
      call.reject(new KernelFault(fault));
    }
  }

  private start(): Worker {
    if (this.worker) return this.worker;
    const worker = this.makeWorker();
    worker.onmessage = (event: MessageEvent<FromWorker>) => this.take(event.data);
    worker.onerror = (event) => {
      event.preventDefault?.();
      this.abandon({
        kind: this.answered ? undefined : "missing",
        message: `The kernel stopped: ${event.message || "its worker could not be started"}.`,
        hint: "It restarts automatically. If it stops at the same place, save the model and report it.",
      });
    };
    this.worker = worker;
    return worker;
  }

  private take(message: FromWorker) {
    const call = this.pending.get(message.id);
    if (!call) return;
    this.answered = true;
    if (message.progress) return call.onProgress?.(message.progress);
    this.pending.delete(message.id);
    clearTimeout(call.timer);
    this.watchFirst();
    if (message.fault) call.reject(new KernelFault(message.fault));
    else call.resolve(message.value);
  }
}

/** Time within which a stopped run must hand over its results [ms]. */
const kGrace = 3000;

export interface KernelPlace {
  makeWorker?: () => Worker;
  kernelUrl?: string;
  /** The files of the open model. */
  files?: () => NamedFiles;
}

export function startKernel(place: KernelPlace = {}): Kernel {
  const makeWorker = place.makeWorker ?? (() => new Worker(new URL("./worker.ts", import.meta.url), { type: "module" }));
  const kernelUrl = place.kernelUrl ?? new URL("kernel/pintle.wasm", document.baseURI).href;
  const files = place.files ?? (() => ({}));
  const lines: Partial<Record<Role, Line>> = {};
  const line = (role: Role) => (lines[role] ??= new Line(makeWorker, kernelUrl, files));
  const ask = <T>(role: Role, name: string, args: unknown, options?: CallOptions) => line(role).call(name, args, options).result as Promise<T>;

  let server: Promise<NativeServer | null> | undefined;
  const native = () => (server ??= findNativeServer());

  function runNative(text: string, options: RunOptions): RunHandle {
    let handle: RunHandle | undefined, cancelled = false;
    // Another model may be open by the time the server is found.
    const named = filesNamedIn(text, options.files ?? files());
    const result = native().then((found) => {
      if (!found) throw new KernelFault({ message: "This page was not served by pintle studio.", hint: "Run it in the browser." });
      handle = found.run(text, options.set ?? {}, named, options.onProgress);
      if (cancelled) handle.cancel();
      return handle.result;
    });
    return {
      result,
      cancel: () => {
        cancelled = true;
        handle?.cancel();
      },
    };
  }

  function run(text: string, options: RunOptions = {}): RunHandle {
    if (options.where === "native") return runNative(text, options);
    const goOn = URL.createObjectURL(new Blob(["go on"]));
    const call = line("run").call("run", { text, set: options.set ?? {} }, { onProgress: options.onProgress, goOn, files: options.files });
    return {
      result: (call.result as Promise<RunAnswer>).finally(() => URL.revokeObjectURL(goOn)),
      cancel: () => {
        URL.revokeObjectURL(goOn);
        line("run").hurry(call.id, { kind: "ended", message: "The run was cancelled before it had any results.", hint: "" });
      },
    };
  }

  async function openDrag(text: string): Promise<DragSession> {
    const opened = await ask<{ id: number; bodies: string[]; joints: string[] }>("session", "open_drag", { text });
    return {
      bodies: opened.bodies,
      joints: opened.joints,
      assemble: (hold, from) => ask("session", "drag", { id: opened.id, hold: hold ?? null, from: from ? [...from] : null }),
      close: () => void ask("session", "close_drag", { id: opened.id }).catch(() => undefined),
    };
  }

  const liveIds = new WeakMap<LiveSession, number>();

  async function openLive(text: string, options: LiveOptions = {}): Promise<LiveSession> {
    const like = (options.like && liveIds.get(options.like)) ?? 0;
    const opened = await ask<LiveStart & { id: number }>("live", "open_live", { text, like });
    const session: LiveSession = {
      start: opened,
      advance: (dt, pull, budget) => ask("live", "advance", { id: opened.id, dt, pull: pull ?? null, budget: budget ?? 0 }),
      close: () => void ask("live", "close_live", { id: opened.id }).catch(() => undefined),
    };
    liveIds.set(session, opened.id);
    return session;
  }

  return {
    schema: () => ask("session", "schema", {}),
    catalog: () => ask("session", "catalog", {}),
    read: (text) => ask("session", "read", { text }),
    report: async (text, onProgress) => (await ask<{ html: string }>("report", "report", { text, set: {} }, { onProgress })).html,
    write: (model) => ask("session", "write", { model }),
    check: (text) => ask("check", "check", { text }),
    openDrag,
    openLive,
    run,
    native,
    stop: () => {
      for (const each of Object.values(lines)) each.abandon({ message: "The kernel was stopped.", hint: "" });
    },
  };
}

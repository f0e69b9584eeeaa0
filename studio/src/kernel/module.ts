// The WebAssembly module: loads it, and calls it with JSON in and JSON with arrays out.
import type { Fault, RunProgress } from "./protocol";

export interface KernelAnswer {
  value: unknown;
  /** The arrays inside `value`, to be transferred to another thread. */
  arrays: Float64Array[];
}

export interface KernelModule {
  /** Throws `{fault}`. `onProgress` returns false to end a run. */
  call(name: string, args: unknown, onProgress?: (progress: RunProgress) => boolean): KernelAnswer;
  /** After a call that crashed the module itself, it can no longer be used. */
  readonly broken: boolean;
}

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  malloc(size: number): number;
  free(pointer: number): void;
  pintle_call(name: number, nameSize: number, args: number, argsSize: number): number;
  pintle_text(): number;
  pintle_text_size(): number;
  pintle_array(index: number): number;
  pintle_array_size(index: number): number;
  pintle_forget(): void;
}

const kErrnoUnsupported = 52; // WASI's ENOSYS

/** Inserts the arrays in place of {"f64": index}. */
export function withArrays(value: unknown, arrays: Float64Array[]): unknown {
  if (Array.isArray(value)) {
    value.forEach((entry, i) => (value[i] = withArrays(entry, arrays)));
    return value;
  }
  if (typeof value !== "object" || value === null) return value;
  const record = value as Record<string, unknown>;
  const index = record["f64"];
  if (typeof index === "number" && Object.keys(record).length === 1) return arrays[index];
  for (const key of Object.keys(record)) {
    const entry = record[key];
    if (typeof entry === "object" && entry !== null) record[key] = withArrays(entry, arrays);
  }
  return record;
}

/** The value of an answer; throws if the answer is a fault. */
export function valueOf(text: string, arrays: Float64Array[]): KernelAnswer {
  const answer = JSON.parse(text) as { value?: unknown; fault?: Fault };
  if (answer.fault) throw { fault: answer.fault };
  return { value: arrays.length === 0 ? answer.value : withArrays(answer.value, arrays), arrays };
}

class Module implements KernelModule {
  broken = false;
  private onProgress: ((progress: RunProgress) => boolean) | undefined;
  private readonly decoder = new TextDecoder();
  private readonly encoder = new TextEncoder();
  private exports!: Exports;

  /** What the module requires of its host: clocks, standard output, exit. There are no files. */
  imports(): WebAssembly.Imports {
    const memory = () => new DataView(this.exports.memory.buffer);
    const wasi: Record<string, (...args: never[]) => number> = {
      clock_time_get: (_clock: number, _precision: bigint, at: number) => {
        memory().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
        return 0;
      },
      fd_write: (_fd: number, vectors: number, count: number, written: number) => {
        let size = 0;
        for (let i = 0; i < count; ++i) size += memory().getUint32(vectors + 8 * i + 4, true);
        memory().setUint32(written, size, true);
        return 0;
      },
      proc_exit: (code: number) => {
        throw new Error(`the module ended with code ${code}`);
      },
    };
    const env: Record<string, (...args: never[]) => number> = {
      pintle_progress: (text: number, size: number) => {
        const go = this.onProgress?.(JSON.parse(this.textAt(text, size)) as RunProgress) ?? true;
        return go ? 1 : 0;
      },
      emscripten_notify_memory_growth: () => 0,
    };
    const others = { get: (known: typeof wasi, name: string) => known[name] ?? (() => kErrnoUnsupported) };
    return { env: new Proxy(env, others), wasi_snapshot_preview1: new Proxy(wasi, others) } as unknown as WebAssembly.Imports;
  }

  start(instance: WebAssembly.Instance) {
    this.exports = instance.exports as unknown as Exports;
    this.exports._initialize();
  }

  call(name: string, args: unknown, onProgress?: (progress: RunProgress) => boolean): KernelAnswer {
    this.onProgress = onProgress;
    try {
      return this.callModule(name, args);
    } catch (error) {
      if (typeof error === "object" && error !== null && "fault" in error) throw error;
      this.broken = true;
      const message = error instanceof Error ? error.message : String(error);
      throw { fault: { message: `The kernel crashed: ${message}.`, hint: "It restarts automatically. Please report the model that caused it." } };
    } finally {
      this.onProgress = undefined;
    }
  }

  private callModule(name: string, args: unknown): KernelAnswer {
    const it = this.exports;
    const nameBytes = this.encoder.encode(name), argBytes = this.encoder.encode(JSON.stringify(args));
    const at = it.malloc(nameBytes.length + argBytes.length + 1);
    if (at === 0) throw { fault: { message: "There is not enough memory for this model.", hint: "" } };
    new Uint8Array(it.memory.buffer, at, nameBytes.length).set(nameBytes);
    new Uint8Array(it.memory.buffer, at + nameBytes.length, argBytes.length).set(argBytes);
    let count: number;
    try {
      count = it.pintle_call(at, nameBytes.length, at + nameBytes.length, argBytes.length);
    } finally {
      it.free(at);
    }
    const arrays: Float64Array[] = [];
    for (let i = 0; i < count; ++i) arrays.push(new Float64Array(it.memory.buffer, it.pintle_array(i), it.pintle_array_size(i)).slice());
    const text = this.textAt(it.pintle_text(), it.pintle_text_size());
    it.pintle_forget();
    return valueOf(text, arrays);
  }

  private textAt(at: number, size: number): string {
    return this.decoder.decode(new Uint8Array(this.exports.memory.buffer, at, size));
  }
}

/** From the module's bytes, or from a response that delivers them. */
export async function startModule(source: BufferSource | Response): Promise<KernelModule> {
  const module = new Module();
  const imports = module.imports();
  const { instance } =
    source instanceof Response
      ? await WebAssembly.instantiateStreaming(source, imports).catch(async () => {
          throw new Error("the module could not be compiled");
        })
      : await WebAssembly.instantiate(source, imports);
  module.start(instance);
  return module;
}

export async function loadKernel(url: string): Promise<KernelModule> {
  const missing = (why: string) => ({
    fault: { kind: "missing" as const, message: `The kernel could not be loaded (${why}).`, hint: "Is the folder complete? make studio builds kernel/pintle.wasm." },
  });
  let response: Response;
  try {
    response = await fetch(url);
  } catch (error) {
    throw missing(String(error));
  }
  if (!response.ok) throw missing(`${response.status} for ${url}`);
  try {
    // Responses without the proper type of .wasm files cannot be compiled while loading.
    const known = response.headers.get("content-type")?.startsWith("application/wasm");
    return await startModule(known ? response : await response.arrayBuffer());
  } catch (error) {
    throw missing(error instanceof Error ? error.message : String(error));
  }
}

// The WebAssembly module: loads it, and calls it with JSON in and JSON with arrays out.
import type { RunProgress } from "./protocol";

export interface KernelModule {
  /** Throws `{fault}`. `arrays` are those inside `value`, for the transfer to another thread. */
  call(name: string, args: unknown, onProgress?: (progress: RunProgress) => boolean): { value: unknown; arrays: Float64Array[] };
}

export async function loadKernel(url: string): Promise<KernelModule> {
  throw { fault: { message: `The kernel is not built (${url}).`, hint: "Run make studio." } };
}

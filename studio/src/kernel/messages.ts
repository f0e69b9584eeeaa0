// Messages between the page and a worker.
import type { Fault, RunProgress } from "./protocol";

export interface ToWorker {
  id: number;
  call: string;
  args: unknown;
  kernelUrl: string;
  /** An address that is readable as long as the call should continue. */
  goOn?: string;
}

export interface FromWorker {
  id: number;
  value?: unknown;
  fault?: Fault;
  progress?: RunProgress;
}

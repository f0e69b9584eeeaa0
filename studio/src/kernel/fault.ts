import type { Fault } from "./protocol";

/** What every rejected promise of the kernel carries. */
export class KernelFault extends Error {
  constructor(readonly fault: Fault) {
    super(fault.message);
    this.name = "KernelFault";
  }
  get hint() {
    return this.fault.hint;
  }
}

import type { Fault } from "./protocol";

/** The error of every rejected promise of the kernel. */
export class KernelFault extends Error {
  constructor(readonly fault: Fault) {
    super(fault.message);
    this.name = "KernelFault";
  }
  get hint() {
    return this.fault.hint;
  }
}

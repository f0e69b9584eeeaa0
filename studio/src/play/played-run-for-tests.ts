// A run whose progress and end are controlled by the test.
import type { RunHandle, RunOptions } from "../kernel/kernel";
import type { RunAnswer, RunProgress } from "../kernel/protocol";

export class PlayedRun implements RunHandle {
  cancelled = false;
  resolve!: (answer: RunAnswer) => void;
  reject!: (error: Error) => void;
  readonly result = new Promise<RunAnswer>((resolve, reject) => {
    this.resolve = resolve;
    this.reject = reject;
  });
  constructor(readonly options: RunOptions) {}
  cancel() {
    this.cancelled = true;
  }
  tell(fraction: number, seconds_left: number) {
    this.options.onProgress?.({ fraction, t: 0, duration: 1, pass: 1, wall_seconds: 1, seconds_left } satisfies RunProgress);
  }
}

// Where a run is computed. It begins in the browser, which finishes short runs before a server could; a long one moves to the native
// kernel if there is one, and the browser's run continues until the native one makes progress.
import type { Kernel, RunHandle } from "../kernel/kernel";
import type { RunAnswer, RunProgress } from "../kernel/protocol";

/** A run with more than this time left goes to the native kernel [s]. */
const LONG = 3;
/** Before this time the estimate of the remaining time is unreliable [s]. */
const SETTLED = 0.5;

export function runWhereFastest(kernel: Pick<Kernel, "run">, text: string, mayMove: () => boolean, onProgress: (progress: RunProgress) => void): RunHandle {
  let here: RunHandle | null = null;
  let native: RunHandle | null = null;
  let tried = false;
  let moved = false;
  let cancelled = false;
  const result = new Promise<RunAnswer>((resolve, reject) => {
    const isLong = (progress: RunProgress) => (progress.seconds_left ?? 0) >= LONG && progress.wall_seconds >= SETTLED;
    const beginHere = () => {
      here = kernel.run(text, {
        onProgress: (progress) => {
          if (moved) return;
          onProgress(progress);
          if (!tried && !cancelled && isLong(progress) && mayMove()) beginNative();
        },
      });
      const end = (settle: () => void) => {
        if (moved) return;
        native?.cancel();
        native = null;
        settle();
      };
      here.result.then((answer) => end(() => resolve(answer)), (error: unknown) => end(() => reject(error)));
    };
    const beginNative = () => {
      tried = true;
      const take = () => {
        if (!moved) here?.cancel();
        moved = true;
      };
      const own = kernel.run(text, {
        where: "native",
        onProgress: (progress) => {
          if (native !== own) return;
          take();
          onProgress(progress);
        },
      });
      native = own;
      own.result.then(
        (answer) => {
          if (native !== own) return;
          take();
          resolve(answer);
        },
        (error: unknown) => {
          native = null;
          // A server that refuses or does not answer costs nothing; if one is lost during the run, its work is lost.
          if (!moved) return;
          if (cancelled) return reject(error);
          moved = false;
          beginHere();
        },
      );
    };
    beginHere();
  });
  return {
    result,
    cancel: () => {
      cancelled = true;
      native?.cancel();
      here?.cancel();
    },
  };
}

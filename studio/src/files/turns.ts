// Saving is done one file after the other: each must know what the one before has left.
let last: Promise<unknown> = Promise.resolve();

export function inTurn<T>(task: () => Promise<T>): Promise<T> {
  const done = last.then(task, task);
  last = done.catch(() => undefined);
  return done;
}

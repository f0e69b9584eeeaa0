// Files are saved one after another: each save must know the result of the previous one.
let last: Promise<unknown> = Promise.resolve();

export function inTurn<T>(task: () => Promise<T>): Promise<T> {
  const done = last.then(task, task);
  last = done.catch(() => undefined);
  return done;
}

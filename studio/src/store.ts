// A value that notifies its observers when it changes.
import { useSyncExternalStore } from "react";

export interface Store<T> {
  get(): T;
  set(change: Partial<T> | ((now: T) => Partial<T>)): void;
  subscribe(listener: () => void): () => void;
}

export function createStore<T extends object>(start: T): Store<T> {
  let now = start;
  const listeners = new Set<() => void>();
  return {
    get: () => now,
    set(change) {
      const part = typeof change === "function" ? change(now) : change;
      const keys = Object.keys(part) as (keyof T)[];
      if (keys.every((key) => Object.is(now[key], part[key]))) return;
      now = { ...now, ...part };
      for (const listener of [...listeners]) listener();
    },
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}

/** Gives a component a part of a store; the part must stay the identical value while it has not changed. */
export function useStore<T extends object, P>(store: Store<T>, part: (now: T) => P): P {
  return useSyncExternalStore(store.subscribe, () => part(store.get()));
}

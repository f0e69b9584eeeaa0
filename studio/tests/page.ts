// As much of a browser's page as modules ask for when they are loaded, for tests in Node. Import it first.
import { vi } from "vitest";

export class Kept implements Pick<Storage, "getItem" | "setItem" | "removeItem" | "key" | "length"> {
  readonly entries = new Map<string, string>();
  /** Length of the longest entry that is taken. */
  room = Number.POSITIVE_INFINITY;
  get length(): number {
    return this.entries.size;
  }
  key(i: number): string | null {
    return [...this.entries.keys()][i] ?? null;
  }
  getItem(key: string): string | null {
    return this.entries.get(key) ?? null;
  }
  setItem(key: string, value: string): void {
    if (value.length > this.room) throw new Error("full");
    this.entries.set(key, value);
  }
  removeItem(key: string): void {
    this.entries.delete(key);
  }
}

export const page = new EventTarget() as EventTarget & Record<string, unknown>;
export const local = new Kept();
export const session = new Kept();
export const place = { hash: "", href: "http://127.0.0.1:7463/", hostname: "127.0.0.1", reload: vi.fn() };
Object.assign(page, {
  location: place,
  localStorage: local,
  sessionStorage: session,
  history: { replaceState: (_: unknown, __: string, to: string) => (place.hash = /#.*$/.exec(to)?.[0] ?? "") },
  matchMedia: () => ({ matches: false }),
});
vi.stubGlobal("window", page);
vi.stubGlobal("location", place);
vi.stubGlobal("localStorage", local);
vi.stubGlobal("sessionStorage", session);
vi.stubGlobal("document", Object.assign(new EventTarget(), { baseURI: place.href, visibilityState: "visible" }));
vi.stubGlobal("HTMLElement", class {});

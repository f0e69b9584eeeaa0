// Everything derived from the text, with a simulated kernel: nothing from an older text may count for the present one.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { edit, openText, undo } from "../actions";
import { KernelFault } from "../kernel/fault";
import type { DragSession, RunOptions } from "../kernel/kernel";
import type { AssemblyAnswer, RunAnswer } from "../kernel/protocol";
import { readModel } from "../model/model";
import { studio } from "../state";
import { PlayedRun } from "./played-run-for-tests";

class BegunRun extends PlayedRun {
  static all: BegunRun[] = [];
  constructor(
    readonly text: string,
    options: RunOptions,
  ) {
    super(options);
    BegunRun.all.push(this);
  }
  get ideal() {
    return this.options.set?.["simulate.equations"] === "ideal";
  }
}

const sessions: (DragSession & { text: string; closed: boolean; asked: number })[] = [];
const checks: { text: string; resolve: (report: unknown) => void }[] = [];
let held = false;
let missing = false;

vi.mock("../kernel/kernel", () => ({
  startKernel: () => ({
    read: async () => {
      if (missing) throw new KernelFault({ kind: "missing", message: "It could not be loaded.", hint: "" });
      return { ok: true, complaints: [] };
    },
    openDrag: async (text: string) => {
      const session = {
        text,
        closed: false,
        asked: 0,
        bodies: ["a"],
        joints: [],
        assemble: async () => (session.asked++, { ok: true, poses: new Float64Array(3), gaps: new Float64Array(0) }) as AssemblyAnswer,
        close: () => void (session.closed = true),
      };
      sessions.push(session);
      return session;
    },
    check: (text: string) => new Promise((resolve) => (held ? checks.push({ text, resolve }) : resolve(null))),
    run: (text: string, options: RunOptions = {}) => new BegunRun(text, options),
  }),
}));

const { KinematicDrag, setGhost, startKernelSession } = await import("./kernel-session");

const MODEL = `[body.a]\nmass = "1 kg"\nmarkers.A = [0, 0]\n[simulate]\nduration = "2 s"\n`;
const OTHER = MODEL.replace("1 kg", "2 kg");
const answer = (method: string) => ({ outcome: "completed", method, columns: [], values: [], joints: [] }) as unknown as RunAnswer;

/** Waits until the kernel session has sent the requests that it makes after a pause. */
const rest = () => vi.advanceTimersByTimeAsync(100);
const last = () => BegunRun.all.at(-1)!;

let watching = false;

beforeEach(async () => {
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout"] });
  missing = held = false;
  studio.set({ ghost: { on: false, answer: null }, kernelState: "starting" });
  if (!watching) startKernelSession();
  watching = true;
  openText(MODEL, "a.toml");
  await rest();
  last().resolve(answer("first"));
  await rest();
  BegunRun.all = [];
});

afterEach(() => vi.useRealTimers());

describe("the kernel session", () => {
  it("computes again what is opened again", async () => {
    openText(MODEL, "a.toml");
    expect([studio.get().run.status, studio.get().poses]).toEqual(["none", null]);
    await rest();
    last().resolve(answer("again"));
    await rest();
    expect([studio.get().run.status, studio.get().run.answer?.method]).toEqual(["done", "again"]);
    expect(studio.get().poses?.has("a")).toBe(true);
  });

  it("computes again when a file that the text names has another content", async () => {
    studio.set({ files: { "mine.csv": "1" } });
    await rest();
    last().resolve(answer("with the file"));
    await rest();
    expect(studio.get().run.answer?.method).toBe("with the file");
  });

  it("takes no answer for the text before, not even in the pause before it asks again", async () => {
    edit(OTHER, "mass");
    await rest();
    const before = last();
    undo();
    expect(before.cancelled).toBe(true);
    before.resolve(answer("of the other text"));
    await vi.advanceTimersByTimeAsync(5);
    expect(studio.get().run).toMatchObject({ status: "running", answer: { method: "first" } });
  });

  it("drags nothing by a session of another text", async () => {
    const session = sessions.at(-1)!;
    edit("[body.a\n", "typing");
    expect(session.closed).toBe(true);
    const asked = session.asked;
    new KinematicDrag("a", [0, 0]).to([1, 1]);
    await rest();
    expect(session.asked).toBe(asked);
  });

  it("says what is wrong with a text that was restored with its faults", async () => {
    const text = "[body.a\n";
    const model = readModel(text);
    studio.set({ history: { ...studio.get().history, text }, model, stale: true, complaints: [] });
    await rest();
    expect(studio.get().complaints.map((one) => one.severity)).toEqual(["error"]);
  });

  it("sees that there is no kernel", async () => {
    missing = true;
    edit(OTHER, "mass");
    await rest();
    expect(studio.get().kernelState).toBe("missing");
  });

  it("checks only the last of the texts that came while it checked", async () => {
    held = true;
    for (const mass of ["2 kg", "3 kg", "4 kg"]) {
      edit(MODEL.replace("1 kg", mass), "mass");
      await rest();
    }
    expect(checks.map((one) => one.text)).toEqual([OTHER]);
    checks[0]!.resolve({ passed: false });
    await rest();
    expect(studio.get().report).toBeNull();
    expect(checks.map((one) => one.text)).toEqual([OTHER, MODEL.replace("1 kg", "4 kg")]);
    checks[1]!.resolve(null);
  });
});

describe("the ghost", () => {
  it("stays away when it is hidden before it has come", async () => {
    setGhost(true);
    const ideal = last();
    expect(ideal.ideal).toBe(true);
    setGhost(false);
    expect(ideal.cancelled).toBe(true);
    ideal.resolve(answer("ideal"));
    await rest();
    expect(studio.get().ghost).toEqual({ on: false, answer: null });
  });

  it("is of the text that is there: gone with an edit, back after its run", async () => {
    setGhost(true);
    last().resolve(answer("ideal"));
    await rest();
    expect(studio.get().ghost.answer?.method).toBe("ideal");
    edit(OTHER, "mass");
    expect(studio.get().ghost).toEqual({ on: true, answer: null });
    await rest();
    last().resolve(answer("second"));
    await rest();
    expect([last().ideal, last().text]).toEqual([true, OTHER]);
  });

  it("is not computed for a run that ended after it was hidden", async () => {
    setGhost(true);
    edit(OTHER, "mass");
    await rest();
    setGhost(false);
    last().resolve(answer("second"));
    await rest();
    expect(BegunRun.all.filter((one) => one.ideal && one.text === OTHER)).toEqual([]);
  });

  it("says why there is none", async () => {
    setGhost(true);
    last().reject(new KernelFault({ message: "A cam has no ideal form.", hint: "" }));
    await rest();
    expect(studio.get().toasts.at(-1)?.text).toContain("A cam has no ideal form.");
  });
});

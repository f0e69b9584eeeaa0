// The clock of the page, with frames triggered by the test and simulated live sessions.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { chooseTool, edit, openText } from "../actions";
import type { LiveOptions, LiveSession } from "../kernel/kernel";
import type { LiveFrame } from "../kernel/protocol";
import { studio } from "../state";

class PlayedSession implements LiveSession {
  static opened: PlayedSession[] = [];
  closed = false;
  t = 0;
  error: LiveFrame["error"] = null;
  readonly start;
  constructor(
    readonly text: string,
    readonly like: LiveSession | undefined,
  ) {
    const names = (table: string) => [...text.matchAll(new RegExp(`\\[${table}\\.(\\w+)\\]`, "g"))].map((one) => one[1]!);
    const bodies = names("body");
    this.start = { bodies, joints: names("joint"), poses: new Float64Array(3 * bodies.length), force_scale: 10, notes: [] };
    PlayedSession.opened.push(this);
  }
  async advance(dt: number): Promise<LiveFrame> {
    this.t += dt;
    const { bodies, joints } = this.start;
    const joint_forces = Float64Array.from(joints.flatMap((name) => [name.charCodeAt(0), 0, 0]));
    return { t: this.t, poses: new Float64Array(3 * bodies.length), velocities: new Float64Array(3 * bodies.length), joint_forces, energy: { kinetic: 0, potential: 0, dissipated: 0, supplied: 0 }, behind: false, cost: 0, error: this.error };
  }
  close() {
    this.closed = true;
  }
}

let gate: Promise<void> = Promise.resolve();
vi.mock("./kernel-session", () => ({
  kernel: {
    openLive: async (text: string, options: LiveOptions = {}) => {
      await gate;
      return new PlayedSession(text, options.like);
    },
  },
}));

const { player } = await import("./player");

const joint = (name: string) => `[joint.${name}]\ntype = "revolute"\nbetween = ["ground.O", "a.A"]\n`;
const MODEL = `[ground.markers]\nO = [0, 0]\n[body.a]\nmass = "1 kg"\nmarkers.A = [0, 0]\n${joint("P")}${joint("Q")}[simulate]\nduration = "2 s"\n`;

let callbacks: ((now: number) => void)[] = [];
let clock = 0;

/** Some frames of the page, with time in between for asynchronous answers. */
async function frames(count = 1): Promise<void> {
  for (let i = 0; i < count; i++) {
    clock += 16;
    const due = callbacks;
    callbacks = [];
    for (const one of due) one(clock);
    await vi.advanceTimersByTimeAsync(16);
  }
}

const started = (async () => {
  vi.stubGlobal("requestAnimationFrame", (callback: (now: number) => void) => callbacks.push(callback));
  player.start();
})();

beforeEach(async () => {
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout"] });
  await started;
  gate = Promise.resolve();
  PlayedSession.opened = [];
  openText(MODEL, "a.toml");
});

afterEach(() => {
  player.stop();
  vi.useRealTimers();
});

async function live(): Promise<PlayedSession> {
  await player.goLive(0);
  await frames(5);
  return PlayedSession.opened.at(-1)!;
}

describe("the clock", () => {
  it("goes on after a frame that fails, and says it once", async () => {
    const said = vi.spyOn(console, "error").mockImplementation(() => undefined);
    let drawn = 0;
    const ends = [player.onFrame(() => { throw new Error("no picture"); }), player.onFrame(() => drawn++)];
    for (let i = 0; i < 3; i++) {
      player.touch();
      await frames();
    }
    ends.forEach((end) => end());
    expect(drawn).toBe(3);
    expect(said).toHaveBeenCalledTimes(1);
    expect(studio.get().toasts.filter((one) => one.text.includes("no picture")).length).toBe(1);
    said.mockRestore();
  });
});

describe("a live motion", () => {
  it("ends when a tool is chosen or another model is opened, and leaves the scale to the run", async () => {
    for (const leave of [() => chooseTool("link"), () => openText(MODEL, "b.toml")]) {
      const session = await live();
      expect(studio.get().mode).toBe("live");
      expect(player.duration).toBeLessThan(1);
      leave();
      expect(session.closed).toBe(true);
      expect([studio.get().mode, player.begin, player.duration]).toEqual(["edit", 0, 2]);
    }
  });

  it.each([
    ["stop", () => player.stop()],
    ["another model", () => openText(MODEL, "b.toml")],
    ["a tool", () => chooseTool("link")],
  ])("does not begin after %s, if it was still opening", async (_, leave) => {
    let open = () => undefined as void;
    gate = new Promise((resolve) => (open = resolve));
    const begun = player.goLive(0);
    expect(player.opening).toBe(true);
    leave();
    open();
    await begun;
    expect(studio.get().mode).toBe("edit");
    expect(PlayedSession.opened.map((one) => one.closed)).toEqual([true]);
    expect(player.opening).toBe(false);
  });

  it("goes on with a changed text from where it stands", async () => {
    const first = await live();
    edit(MODEL.replace("1 kg", "2 kg"), "mass");
    await frames(20);
    const [, second] = PlayedSession.opened;
    expect(second?.like).toBe(first);
    expect([first.closed, second?.closed, studio.get().mode]).toEqual([true, false, "live"]);
  });

  it("shows each joint its own force, also while its model is another", async () => {
    await live();
    const force = () => Array.from(player.frame().forces ?? []).filter((_, i) => i % 3 === 0);
    expect(force()).toEqual(["P", "Q"].map((name) => name.charCodeAt(0)));
    edit(MODEL.replace(joint("P"), ""), "remove P");
    expect(force()).toEqual(["Q".charCodeAt(0)]);
  });

  it("gives the force of a joint by its name, as long as it is live", async () => {
    await live();
    expect(["P", "Q", "R"].map((name) => player.liveForce(name))).toEqual([["P".charCodeAt(0), 0], ["Q".charCodeAt(0), 0], null]);
    player.stop();
    expect(player.liveForce("P")).toBeNull();
  });

  it("takes its error back when it goes on", async () => {
    const session = await live();
    session.error = { message: "stuck", hint: "" };
    await frames(2);
    expect(studio.get().obstacle?.message).toBe("stuck");
    session.error = null;
    await frames(2);
    expect(studio.get().obstacle).toBeNull();
    session.error = { message: "stuck", hint: "" };
    await frames(2);
    player.stop();
    expect(studio.get().obstacle).toBeNull();
  });
});

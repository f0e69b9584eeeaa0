// Keys and pointer on a canvas without a picture.
import { beforeAll, beforeEach, describe, expect, it, vi } from "vitest";
import { chooseTool, openText } from "../actions";
import type { Pull } from "../kernel/protocol";
import { EMPTY_MODEL } from "../model/operations";
import { studio } from "../state";
import { fromScreen, gridStep, toScreen } from "./camera";
import { nextPoint, placeInWords } from "./key-cursor";
import { looksOf } from "./looks";
import type { View } from "./view";

vi.mock("../play/player", () => {
  const player = {
    pulling: null as Pull | null,
    setPull: (pull: Pull | null) => void (player.pulling = pull),
    frame: () => ({ pose: (name: string) => studio.get().model.body.get(name)?.pose ?? { x: 0, y: 0, angle: 0 }, forces: null }),
    touch: () => undefined,
  };
  return { player };
});
vi.mock("../play/kernel-session", () => ({ KinematicDrag: class {} }));

class Control extends EventTarget {
  isContentEditable = false;
  constructor(
    readonly tagName: string,
    readonly type = "",
  ) {
    super();
  }
  closest(selector: string) {
    const name = this.tagName.toLowerCase();
    return selector.split(", ").some((one) => one === name || one === `${name}[type=${this.type}]`) ? this : null;
  }
}

const page = new EventTarget();
const svg = new EventTarget();
const camera = { scale: 1000, x: 400, y: 300 };

function press(key: string, more: Partial<KeyboardEvent> = {}): Event {
  const event = Object.assign(new Event("keydown", { cancelable: true }), { key, shiftKey: false, altKey: false, ctrlKey: false, metaKey: false, ...more });
  page.dispatchEvent(event);
  return event;
}

const pressed = (keys: string) => keys.split(" ").forEach((key) => press({ R: "ArrowRight", L: "ArrowLeft", U: "ArrowUp", D: "ArrowDown" }[key] ?? key));

let entry: typeof import("./gestures").entry;

beforeAll(async () => {
  vi.stubGlobal("window", page);
  vi.stubGlobal("document", { activeElement: null });
  vi.stubGlobal("Element", Control);
  vi.stubGlobal("HTMLElement", Control);
  Object.assign(svg, {
    dataset: {},
    style: {},
    classList: { add: () => undefined, remove: () => undefined },
    getBoundingClientRect: () => ({ left: 0, top: 0, width: 800, height: 600 }),
    setPointerCapture: () => undefined,
  });
  const view = {
    svg,
    camera,
    size: { width: 800, height: 600 },
    get looks() {
      return looksOf(model(), 0.2);
    },
    metres: (pixels: number) => pixels / camera.scale,
    toWorld: (at: [number, number]) => fromScreen(camera, at),
    toScreen: (at: [number, number]) => toScreen(camera, at),
    show: () => undefined,
    setCamera: (to: typeof camera) => Object.assign(camera, to),
  };
  const module = await import("./gestures");
  entry = module.entry;
  new module.Gestures(view as unknown as View);
});

beforeEach(() => {
  Object.assign(camera, { scale: 1000, x: 400, y: 300 });
  chooseTool("select");
  openText(EMPTY_MODEL, "untitled.toml");
});

const model = () => studio.get().model;

describe("by keys alone", () => {
  it("a link is drawn from its first point to its last", () => {
    const step = gridStep(camera);
    chooseTool("link");
    expect(press("ArrowRight").defaultPrevented).toBe(true);
    expect(entry.get().said).toBe(placeInWords({ at: [step, 0], end: null, body: null }));
    pressed("Enter R R R U Enter");
    const [link] = model().bodies;
    expect(Math.hypot(link!.markers[0]!.at[0] - link!.markers[1]!.at[0], link!.markers[0]!.at[1] - link!.markers[1]!.at[1])).toBeCloseTo(step * Math.sqrt(10), 6);
    expect(entry.get().said).toContain(link!.name);
  });

  it("a link gets an exact length, a pin to the ground and a spring", () => {
    chooseTool("link");
    pressed("R Enter R R 1 0 0 Enter");
    const [link] = model().bodies;
    expect(link!.markers[1]!.at[0] - link!.markers[0]!.at[0]).toBeCloseTo(0.1, 6);
    chooseTool("ground");
    pressed("L L Enter");
    expect(model().joints.map((one) => one.type)).toEqual(["revolute"]);
    chooseTool("spring");
    pressed("U U U Enter D D D R R Enter");
    expect(model().springs.length).toBe(1);
  });

  it("a plate takes corners, and ends at the last one", () => {
    chooseTool("plate");
    pressed("R Enter R R R Enter U U U Enter Enter");
    expect(model().bodies[0]?.markers.length).toBe(3);
  });

  it("the paper follows over its edge", () => {
    chooseTool("link");
    for (let i = 0; i < 100; i++) press("ArrowRight");
    expect(camera.x).toBeLessThan(0);
  });
});

describe("a hand at a link of a run", () => {
  const hand = (type: string, x: number, y: number) => svg.dispatchEvent(Object.assign(new Event(type), { clientX: x, clientY: y, button: 0, pointerId: 1 }));

  it("goes on pulling when the run becomes a live motion, and lets go when that ends", async () => {
    const { player } = await import("../play/player");
    chooseTool("link");
    pressed("R Enter R R R R Enter");
    chooseTool("select");
    const { x, y } = model().bodies[0]!.pose;
    const [u, v] = toScreen(camera, [x, y]);
    studio.set({ mode: "replay", playing: true });
    hand("pointerdown", u, v);
    expect(player.pulling?.body).toBe("link1");
    studio.set({ mode: "live" });
    hand("pointermove", u + 50, v);
    expect(player.pulling?.target[0]).toBeCloseTo(x + 0.05, 9);
    player.setPull(null);
    studio.set({ mode: "edit", playing: false });
    hand("pointermove", u + 90, v);
    expect(player.pulling).toBeNull();
  });
});

describe("a step of the keys", () => {
  it("goes from line to line, and to every point on the way and back to the row", () => {
    const points = [[0.013, 0.004]] as const;
    expect(nextPoint([0.002, 0.001], [1, 0], 0.01, points)).toEqual([0.01, 0]);
    expect(nextPoint([0.01, 0], [1, 0], 0.01, points)).toEqual([0.013, 0.004]);
    expect(nextPoint([0.013, 0.004], [1, 0], 0.01, points)).toEqual([0.02, 0]);
    expect(nextPoint([0.02, 0], [-1, 0], 0.01, points)).toEqual([0.013, 0.004]);
    expect(nextPoint([0, 0.03], [0, -1], 0.01, points)[1]).toBeCloseTo(0.02, 12);
  });
});

describe("a control with the focus", () => {
  it("keeps the keys that it needs and no others", async () => {
    const { isTyping, ownsKey } = await import("../controls");
    const [time, box, choice, field] = [new Control("INPUT", "range"), new Control("INPUT", "checkbox"), new Control("SELECT"), new Control("INPUT", "text")];
    expect([time, box, choice, field].map(isTyping)).toEqual([false, false, false, true]);
    expect([time, box, choice].map((one) => ownsKey(one, " "))).toEqual([false, true, true]);
    expect([time, box, choice].map((one) => ownsKey(one, "Delete"))).toEqual([false, false, false]);
    expect([time, choice].map((one) => ownsKey(one, "ArrowLeft"))).toEqual([true, true]);
  });
});

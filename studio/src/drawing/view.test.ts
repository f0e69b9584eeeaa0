// The camera of the drawing, with a scene that draws nothing and frames triggered by the test.
import "../../tests/page";
import { beforeEach, expect, it, vi } from "vitest";
import { edit, openText } from "../actions";
import type { RunAnswer } from "../kernel/protocol";
import { NO_RUN, studio } from "../state";

let frame = () => undefined as void;
let reach: { min: [number, number]; max: [number, number] } | null = null;
vi.mock("../play/player", () => ({
  player: {
    onFrame: (listener: () => void) => ((frame = listener), () => undefined),
    touch: () => undefined,
    frame: () => null,
    slides: () => null,
    curves: () => [],
    reachOfRun: () => reach,
    forceScale: 0,
    pulling: null,
  },
}));
vi.mock("./scene", () => ({
  Scene: class {
    layers = { grid: { replaceChildren: () => undefined }, overlay: { replaceChildren: () => undefined } };
    show() {}
    ghost = () => null;
    traces() {}
    mark() {}
    pan() {}
    place() {}
  },
}));
vi.stubGlobal("ResizeObserver", class { observe() {} });
const { View } = await import("./view");

const MODEL = `[body.a]\nmass = "1 kg"\nposition = [0, 0]\nmarkers.A = [-0.1, 0]\nmarkers.B = [0.1, 0]\n[simulate]\nduration = "2 s"\n`;
const view = new View({ getBoundingClientRect: () => ({ width: 800, height: 600 }) } as unknown as SVGSVGElement);

/** The run of the text is there, and covers more than the start. */
function run(): void {
  reach = { min: [-0.3, -0.3], max: [0.3, 0.3] };
  studio.set((now) => ({ run: { ...NO_RUN, status: "done", answer: {} as RunAnswer, serial: now.run.serial + 1 } }));
  frame();
}

beforeEach(() => {
  reach = null;
  studio.set((now) => ({ kernelState: "ready", show: { ...now.show, grid: false } }));
  openText(MODEL, "a.toml");
  frame();
});

it("shows the whole motion after the first run of an opened model", () => {
  const { scale } = view.camera;
  run();
  expect(view.camera.scale).toBeLessThan(0.8 * scale);
});

it.each([
  ["after an edit", () => void edit(MODEL.replace("1 kg", "2 kg"), "Set mass")],
  ["when the user has moved it", () => view.zoom(1.5)],
])("stays as it is %s", (_, change) => {
  change();
  frame();
  const { camera } = view;
  run();
  expect(view.camera).toBe(camera);
});

import "../../tests/page";
import { beforeEach, describe, expect, it } from "vitest";
import { chooseTool, edit, editText, openText } from "../actions";
import { EMPTY_MODEL, addBar } from "../model/operations";
import { readModel, worldPoint } from "../model/model";
import { studio } from "../state";
import { Gestures } from "./gestures";
import { looksOf } from "./looks";
import type { View } from "./view";

/** A drawing with a scale of a thousand pixels per metre, the origin in the middle of 1000 by 1000. */
function drawing() {
  const svg = Object.assign(new EventTarget(), {
    dataset: {} as Record<string, string>,
    style: {} as Record<string, string>,
    classList: { add: () => undefined, remove: () => undefined },
    getBoundingClientRect: () => ({ left: 0, top: 0, width: 1000, height: 1000 }),
    setPointerCapture: () => undefined,
  });
  const view = {
    svg,
    camera: { scale: 1000, x: 500, y: 500 },
    get looks() {
      return looksOf(studio.get().model, 0.2);
    },
    toWorld: ([x, y]: readonly [number, number]) => [(x - 500) / 1000, (500 - y) / 1000] as const,
    toScreen: ([x, y]: readonly [number, number]) => [500 + 1000 * x, 500 - 1000 * y] as const,
    metres: (pixels: number) => pixels / 1000,
    show: () => undefined,
    setCamera: () => undefined,
  };
  const gestures = new Gestures(view as unknown as View);
  const pointer = (type: string, x: number, y: number) =>
    svg.dispatchEvent(Object.assign(new Event(type), { clientX: 500 + 1000 * x, clientY: 500 - 1000 * y, button: 0, pointerId: 1, altKey: false, shiftKey: false }));
  return { gestures, pointer };
}

const free = (x: number, y: number) => ({ at: [x, y] as const, end: null, body: null });

describe("a drag of a point", () => {
  beforeEach(() => {
    studio.set({ tool: "select", mode: "edit", stale: false });
    openText(addBar(readModel(EMPTY_MODEL), free(0, 0), free(0.1, 0)).text, "a.toml");
    for (let i = 0; i < 20; i++) edit(`${studio.get().history.text}# ${i}\n`, "note");
  });

  it("is taken back alone when another tool is chosen meanwhile", () => {
    const { gestures, pointer } = drawing();
    const { text, past } = studio.get().history;
    pointer("pointerdown", 0.1, 0);
    pointer("pointermove", 0.15, 0.05);
    pointer("pointermove", 0.2, 0.1);
    expect(studio.get().history.text).not.toBe(text);
    chooseTool("link");
    expect(studio.get().history.text).toBe(text);
    expect(studio.get().history.past).toHaveLength(past.length);
    expect(studio.get().tool).toBe("link");
    gestures.close();
  });

  it("asks before it replaces a parameter, and writes nothing until then", () => {
    const { text } = studio.get().history;
    editText(`${text.replace(/markers\.B = .*/, 'markers.B = ["half", 0]')}[parameters]\nhalf = "50 mm"\n`, "Edit");
    const { gestures, pointer } = drawing();
    const parametric = studio.get().history.text;
    studio.set({ toasts: [] });
    for (const [type, x, y] of [["pointerdown", 0.1, 0], ["pointermove", 0.15, 0.05], ["pointermove", 0.2, 0.1], ["pointerup", 0.2, 0.1]] as const) pointer(type, x, y);
    expect(studio.get().history.text).toBe(parametric);
    const [toast] = studio.get().toasts;
    expect(toast?.text).toMatch(/body\.link1\.markers\.B.*parameters/);
    toast!.action!.run();
    expect(worldPoint(studio.get().model, { body: "link1", marker: "B" })[0]).toBeCloseTo(0.2, 9);
    gestures.close();
  });

  it("leaves a step that came after it alone", () => {
    const { gestures, pointer } = drawing();
    pointer("pointerdown", 0.1, 0);
    pointer("pointermove", 0.2, 0.1);
    edit(`${studio.get().history.text}# another\n`, "note");
    const { text } = studio.get().history;
    chooseTool("link");
    expect(studio.get().history.text).toBe(text);
    gestures.close();
  });
});

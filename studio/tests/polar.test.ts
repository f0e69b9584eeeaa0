// Polar load diagrams of pins of the native kernel's runs: the force in a marker's axes is that in world axes, turned by the body and its marker.
import { existsSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { ReadAnswer, RunAnswer } from "../src/kernel/protocol";
import { forcePath } from "../src/panels/results/polar";
import { answers, native, texts } from "./native-answers";

describe.skipIf(!existsSync(answers))("the axes of polar load diagrams", { timeout: 120_000 }, () => {
  it.each(["four_bar.toml", "quick_return.toml", "slider_crank.toml"])("turn with the bodies of %s", (file) => {
    const text = texts.get(file)!;
    const [{ resolved }, run] = native([{ call: "read", arguments: { text } }, { call: "run", arguments: { text } }]) as [ReadAnswer, RunAnswer];
    const pins = run.joints.filter((one) => one.type === "revolute");
    expect(pins.length).toBeGreaterThan(1);
    for (const pin of pins) {
      const joint = resolved!.joints.find((one) => one.name === pin.name)!;
      const world = forcePath(run, pin, "world")!;
      for (const side of ["first", "second"] as const) {
        const { body, marker } = joint[side];
        const { axis } = (body === "ground" ? resolved!.ground : resolved!.bodies.find((one) => one.name === body)!.markers).find((one) => one.name === marker)!;
        const turned = run.values[run.columns.findIndex((one) => one.kind === "body" && one.of === body && one.quantity === "angle")];
        const path = forcePath(run, pin, side)!, sign = side === "first" ? -1 : 1;
        let most = 0;
        path.x.forEach((fx, i) => {
          const angle = axis + (turned?.[i] ?? 0), [c, s] = [Math.cos(angle), Math.sin(angle)];
          most = Math.max(most, Math.hypot(fx - sign * (c * world.x[i]! + s * world.y[i]!), path.y[i]! - sign * (c * world.y[i]! - s * world.x[i]!)));
        });
        expect(most / pin.peak, `${pin.name}, ${side}`).toBeLessThan(1e-9);
      }
    }
  });
});

import { describe, expect, it } from "vitest";
import type { Column, PeakForce, RunAnswer } from "../../kernel/protocol";
import { type ForcePath, forcePath, longest, peakTip, ringsUpTo, rowNearestTo } from "./polar";

// A body that rotates about a pin on the ground; the force points along the arm, so it is constant in the axes of the marker on the body.
const ARM = 0.3;
const time = Float64Array.from({ length: 13 }, (_, i) => i / 12);
const angle = time.map((t) => 2 * Math.PI * t);
const [f1, f2] = [Math.cos, Math.sin].map((wave) => angle.map((turned) => -9 * wave(turned + ARM))) as [Float64Array, Float64Array];
const column = (quantity: string, frame = "", feels = ""): Column => ({ name: "", unit: "", about: "", kind: "joint", of: "A", quantity, frame, feels });
const other = column("f1", "joint", "ground");
const pin = { name: "A", type: "revolute", first_body: "ground", second_body: "bob", peak: 9, peak_time: 0.5 } as PeakForce;
const answer = {
  columns: [{ ...column("t"), kind: "time" }, other, column("fx", "world", "bob"), column("fy", "world", "bob"), column("f1", "joint", "bob"), column("f2", "joint", "bob"), column("angle")],
  values: [time, f1.map(() => 0), f1, f2, f1, f2, angle],
  joints: [pin],
} as unknown as RunAnswer;

describe("the polar load diagram of a pin", () => {
  it("has the force on the bush in its axes, and that on the pin in those that turn with it", () => {
    const [world, first, second] = (["world", "first", "second"] as const).map((axes) => forcePath(answer, pin, axes)!) as [ForcePath, ForcePath, ForcePath];
    time.forEach((_, i) => {
      expect([world.x[i], world.y[i]]).toEqual([f1[i], f2[i]]);
      expect([first.x[i], first.y[i]]).toEqual([-f1[i]!, -f2[i]!]);
      expect(second.x[i]).toBeCloseTo(-9 * Math.cos(ARM), 12);
      expect(second.y[i]).toBeCloseTo(-9 * Math.sin(ARM), 12);
    });
    expect(longest([world, second])).toBeCloseTo(9, 12);
  });

  it("is not there where the run lacks its columns", () => {
    expect(forcePath({ ...answer, columns: answer.columns.slice(0, -1) }, pin, "second")).toBeNull();
    expect(forcePath(answer, { ...pin, name: "B" }, "world")).toBeNull();
  });

  it("marks the largest force as it is, not as the rows have it, and no direction that the rows do not know", () => {
    const path = forcePath(answer, pin, "world")!;
    const [x, y] = peakTip(path, time, { ...pin, peak: 10 })!;
    expect([x, y]).toEqual([expect.closeTo(10 * Math.cos(ARM), 12), expect.closeTo(10 * Math.sin(ARM), 12)]);
    expect(peakTip(path, time, { ...pin, peak: 100 })).toBeNull();
    expect(peakTip({ x: f1.map(() => 0), y: f1.map(() => 0) }, time, { ...pin, peak: 0 })).toBeNull();
  });

  it.each([
    [180.7, [50, 100, 150]],
    [100, [20, 40, 60, 80, 100]],
    [6, [2, 4, 6]],
    [0.3, [0.1, 0.2, 0.3]],
    [4.4e4, [1e4, 2e4, 3e4, 4e4]],
    [0, []],
    [Number.NaN, []],
  ])("has round rings up to %f N", (largest, rings) => {
    expect(ringsUpTo(largest).map((ring) => Number(ring.toPrecision(12)))).toEqual(rings);
  });

  it("leads to the row that is pointed at", () => {
    expect(rowNearestTo(forcePath(answer, pin, "world")!, [f1[4]! * 0.9, f2[4]! * 0.9])).toBe(4);
  });
});

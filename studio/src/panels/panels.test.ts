import { describe, expect, it } from "vitest";
import type { Column, PeakForce, RunAnswer } from "../kernel/protocol";
import { quantity } from "../model/units";
import { estimateOf } from "./results/estimate";
import { type ForceOf, chosenSeries, seriesOf } from "./results/series";

const peak = (error_estimate: number, unique = true) => ({ peak: 100, error_estimate, relative_error_estimate: error_estimate / 100, unique }) as PeakForce;
// JSON turns a NaN into this.
const nothing = null as unknown as number;

describe("the estimated error of a peak", () => {
  it.each([
    ["completed", 0.5, "± 500 mN", "0.5 % of the peak"],
    ["completed", 0, "± 0 N", "0 % of the peak"],
    ["failed", 0, "–", null],
    ["interrupted", 0, "–", null],
    ["failed", 0.5, "± 500 mN", "0.5 % of the peak"],
    ["completed", nothing, "–", null],
  ] as const)("of a %s run with %f is %s", (outcome, error, text, share) => {
    expect(estimateOf(peak(error), { outcome })).toMatchObject({ text, share });
  });
  it("is not told where the force is not unique", () => {
    expect(estimateOf(peak(0.5, false), { outcome: "completed" })).toMatchObject({ text: "not unique", share: null });
  });
});

it("a quantity that is no number is a dash, not 0 of something", () => {
  expect(quantity(nothing, "N")).toBe("–");
  expect(quantity(Number.NaN, "N*m")).toBe("–");
});

describe("what is on the plot", () => {
  const column = (quantity: string): Column => ({ name: `joint.A.${quantity}`, unit: "N", about: "", kind: "joint", of: "A", quantity, frame: "world", feels: "b" });
  const answer = { columns: [column("fx"), column("fy")], values: [Float64Array.of(3), Float64Array.of(4)], joints: [{ name: "A", second_body: "b", peak: 5 }] } as unknown as RunAnswer;
  it("has live values of forces, on either body, and of nothing else", () => {
    const more = [{ ...column("fy"), name: "joint.A.fy_first", feels: "ground" }, column("slide"), { ...column("fx"), name: "joint.A.f1", quantity: "f1", frame: "joint" }];
    const series = seriesOf({ ...answer, columns: [...answer.columns, ...more] });
    const values = (forceOf: ForceOf) => Object.fromEntries(series.map((one) => [one.id, one.live?.(forceOf)]));
    expect(values((joint) => (joint === "A" ? [30, -40] : null))).toEqual({ "joint.A.|F|": 50, "joint.A.fx": 30, "joint.A.fy": -40, "joint.A.fy_first": 40, "joint.A.slide": undefined, "joint.A.f1": undefined });
    expect(Object.values(values(() => null)).filter((value) => value !== undefined)).toEqual([]);
  });

  const ids = (plotted: string[] | null) => chosenSeries(seriesOf(answer), plotted, answer).map((one) => one.id);

  it("is the largest force until one chooses, and nothing when all was taken off", () => {
    expect(ids(null)).toEqual(["joint.A.|F|"]);
    expect(ids(["joint.A.fx", "joint.gone.fx"])).toEqual(["joint.A.fx"]);
    expect(ids(["joint.gone.fx"])).toEqual(["joint.A.|F|"]);
    expect(ids([])).toEqual([]);
  });
});

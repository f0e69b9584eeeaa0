import { expect, it } from "vitest";
import { openText } from "../../actions";
import { valueProblem } from "../../model/dimensions";
import { studio } from "../../state";
import { entered, unitsOf } from "./entry";

const length = { unit: "mm", refuse: (text: string) => valueProblem(text, "m", true, studio.get().model) };

it.each([
  ["25", { literal: "25 mm" }],
  ["1 in", { literal: "1 in" }],
  ["2*r", { literal: "2*r" }],
  ["1 kg", { wrong: "A length [m] is expected here, not a mass [kg]." }],
  ["-50", { wrong: "This must be greater than 0 m." }],
  ["0", { wrong: "This must be greater than 0 m." }],
  ["2*s", { wrong: '"2*s" is neither a number nor an expression of the model\'s parameters.' }],
])("a length typed as %s", (text, found) => {
  openText('[parameters]\nr = "40 mm"\n', "a.toml");
  expect(entered(text, length)).toEqual(found);
});

it("a number without a unit stays one, and names of variables are left to the kernel", () => {
  expect(entered("3", { unit: "" })).toEqual({ literal: 3 });
  expect(entered("sin(t)", { unit: "N", variables: true })).toEqual({ literal: "sin(t)" });
});

it("a unit chosen for an empty field is that of the next number, and of the default shown there", () => {
  expect(unitsOf(undefined, "N/m", undefined, "")).toMatchObject({ now: "N/m", usual: "" });
  const { now, choices } = unitsOf(undefined, "N/m", undefined, "kN/mm");
  expect(choices).toEqual(["N/m", "N/mm", "kN/mm"]);
  expect(entered("5", { unit: now })).toEqual({ literal: "5 kN/mm" });
  expect(unitsOf(undefined, "N/m", "1e8", "kN/mm")).toMatchObject({ now: "kN/mm", usual: "100" });
  expect(unitsOf(undefined, "N/m", "2*k", "kN/mm")).toMatchObject({ now: "kN/mm", usual: "" });
});

it("a field with a number has that number's unit, whatever was chosen before, and none of another quantity", () => {
  expect(unitsOf("5 N/mm", "N/m", undefined, "kN/mm").now).toBe("N/mm");
  expect(unitsOf(5, "N/m", undefined, "kN/mm").now).toBe("N/m");
  expect(unitsOf("2*k", "N/m", undefined, "kN/mm").now).toBe("N/m");
  expect(unitsOf(undefined, "N*m/rad", undefined, "kN/mm").now).toBe("N*m/rad");
  expect(unitsOf(undefined, "m", "3 in", "").now).toBe("in");
});

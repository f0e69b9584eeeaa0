import { expect, it } from "vitest";
import { openText } from "../../actions";
import { valueProblem } from "../../model/dimensions";
import { studio } from "../../state";
import { entered } from "./entry";

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

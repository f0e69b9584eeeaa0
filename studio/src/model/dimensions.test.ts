import { expect, it } from "vitest";
import { valueProblem } from "./dimensions";
import { readModel } from "./model";

const model = readModel('[parameters]\nr = "40 mm"\nm = "2 kg"\nratio = 3\nslope = "r/(100 mm)"\n');

it.each([
  ["1 kg", "m", "A length [m] is expected here, not a mass [kg]."],
  ["2*m", "m", "A length [m] is expected here, not a mass [kg]."],
  ["30 deg", "m", "A length [m] is expected here, not an angle [rad]."],
  ["r*r", "m", "A length [m] is expected here, not an area [m^2]."],
  ["1 m*kg", "m", "A length [m] is expected here, not a quantity in [m*kg]."],
  ["r + m", "m", "A length [m] is expected here, not a sum of different quantities."],
  ["10 mm", "rad", "An angle [rad] is expected here, not a length [m]."],
  ["10 rpm", "rad", "An angle [rad] is expected here, not an angular speed [rad/s]."],
  ["-50 mm", "m", "This must be greater than 0 m."],
  ["0", "m", "This must be greater than 0 m."],
  ["r - 40 mm", "m", "This must be greater than 0 m."],
] as const)("refuses %s in %s", (text, unit, reason) => {
  expect(valueProblem(text, unit, unit === "m", model)).toBe(reason);
});

it.each([
  ["10 mm", "m"],
  ["0.01", "m"],
  ["ratio*r + 0.01", "m"],
  ["r*cos(60 deg)", "m"],
  ["sqrt(r^2 + (30 mm)^2)", "m"],
  ["-30 deg", "rad"],
  ["0", "rad"],
  ["atan(slope)", "rad"],
  ["atan2(r, 0.1 m)", "rad"],
] as const)("takes %s in %s", (text, unit) => {
  expect(valueProblem(text, unit, unit === "m", model)).toBe("");
});

// Dimensions of values that the studio computes with, and what is wrong with them: in the words of the kernel, which never sees them as typed.
import { evaluate } from "./expression";
import { type Model, readParameters } from "./model";
import { type Dimension, UNITS } from "./units";

const DOUBLED: readonly Dimension[] = [[2, 1, 1, 1], [1, 2, 1, 1], [1, 1, 2, 1], [1, 1, 1, 2]];

/** Exponents of m, kg, s and rad; null for one by which the terms of a sum differ. A bare number has none, and fits everywhere. */
function powersOf(text: string, model: Model): (number | null)[] {
  const value = evaluate(text, (name) => model.parameters.get(name));
  return DOUBLED.map((sizes) => {
    const parameters = readParameters(model.document, sizes);
    const other = evaluate(text, (name) => parameters.get(name), sizes);
    const power = value === other ? 0 : Math.log2((other ?? Number.NaN) / (value ?? Number.NaN));
    return Math.abs(power - Math.round(power)) < 1e-9 ? Math.round(power) : null;
  });
}

/** Named dimensions, each with its unit in factors of m, kg, s and rad. */
const NAMES: readonly [string, string, Dimension][] = [
  ["a length", "m", [1, 0, 0, 0]],
  ["an angle", "rad", [0, 0, 0, 1]],
  ["a mass", "kg", [0, 1, 0, 0]],
  ["a time", "s", [0, 0, 1, 0]],
  ["an area", "m^2", [2, 0, 0, 0]],
  ["a volume", "m^3", [3, 0, 0, 0]],
  ["a speed", "m/s", [1, 0, -1, 0]],
  ["an acceleration", "m/s^2", [1, 0, -2, 0]],
  ["a frequency", "1/s", [0, 0, -1, 0]],
  ["an angular speed", "rad/s", [0, 0, -1, 1]],
  ["a moment of inertia", "kg*m^2", [2, 1, 0, 0]],
  ["a force", "N", [1, 1, -2, 0]],
  ["a torque or an energy", "N*m", [2, 1, -2, 0]],
  ["an angular stiffness", "N*m/rad", [2, 1, -2, -1]],
  ["a power", "W", [2, 1, -3, 0]],
  ["a pressure", "Pa", [-1, 1, -2, 0]],
  ["a stiffness", "N/m", [0, 1, -2, 0]],
  ["a damping", "N*s/m", [0, 1, -1, 0]],
];

function inWords(dimension: Dimension): string {
  const known = NAMES.find(([, , one]) => one.every((power, i) => power === dimension[i]));
  if (known) return `${known[0]} [${known[1]}]`;
  const powers = ["m", "kg", "s", "rad"].map((unit, i) => (dimension[i] === 0 ? "" : dimension[i] === 1 ? unit : `${unit}^${dimension[i]}`));
  return `a quantity in [${powers.filter(Boolean).join("*")}]`;
}

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** Why a value is not one in this unit, or not positive where it must be; empty if it is. */
export function valueProblem(text: string, unit: "m" | "rad", positive: boolean, model: Model): string {
  const wanted = UNITS[unit]!.dimension;
  const powers = powersOf(text, model);
  // Radians do not count: an angle may be inside a function. Where lengths are wanted, a bare number may be added to one.
  const found = powers.map((power, i) => power ?? (i === 3 ? 0 : wanted[i])) as unknown as Dimension;
  const expected = capital(`${inWords(wanted)} is expected here`);
  if (powers.some((power, i) => power === null && i < 3 && wanted[i] === 0)) return `${expected}, not a sum of different quantities.`;
  if (found.some((power) => power !== 0) && found.some((power, i) => i < 3 && power !== wanted[i])) return `${expected}, not ${inWords(found)}.`;
  const value = evaluate(text, (name) => model.parameters.get(name));
  return positive && value !== null && value <= 0 ? `This must be greater than 0 ${unit}.` : "";
}

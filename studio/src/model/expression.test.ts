import { describe, expect, it } from "vitest";
import { evaluate, namesIn } from "./expression";

const scope = (name: string) => ({ crank: 0.1, crankshaft: 7, speed: 10 })[name];

describe("expressions", () => {
  it.each([
    ["25 mm", 0.025],
    ["2*crank + 5 mm", 0.205],
    ["3000 N*s/m", 3000],
    ["60 rpm", 2 * Math.PI],
    ["0.5 m * cos(60 deg)", 0.25],
    ["2*pi/speed", Math.PI / 5],
    ["-2^2", -4],
    ["2^-1", 0.5],
    ["1 kg*mm^2", 1e-6],
    ["(20 kg + 50 kg)*9.80665 m/s^2", 686.4655],
    ["min(3, 2, 5) + if(1 < 2, 10, 20)", 12],
    ["5 N * crankshaft", 35],
    ["0.4 N*s/rad", 0.4],
    ["1e3*1.5e-3", 1.5],
  ])("%s is %f", (text, value) => {
    expect(evaluate(text, scope)).toBeCloseTo(value, 12);
  });

  it.each(["", "2 +", "unknown", "2 furlongs", "sin(", "1 2", "(1", "1)", "1/0", "10^400", "log(0)", "0/0"])("%j has no value", (text) => {
    expect(evaluate(text, scope)).toBeNull();
  });

  it("tells the names it uses from units", () => {
    expect(namesIn("2*crank + 5 mm*sin(speed)", new Set(["crank", "speed", "other"]))).toEqual(["crank", "speed"]);
  });
});

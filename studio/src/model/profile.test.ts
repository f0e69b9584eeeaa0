import { expect, it } from "vitest";
import { readModel } from "./model";

const cam = (keys: string) => readModel(`[parameters]\nr = "40 mm"\n[joint.J]\ntype = "cam"\nbetween = ["a.O", "b.P"]\nbase_radius = "r"\n${keys}`).joints[0]!.profile!;

// A circle of 40 mm, eccentric by 10 mm, under a roller of 12 mm and under a flat face.
it("draws the surface of a cam", () => {
  const roller = cam('roller_radius = "12 mm"\nlift = "10 mm*cos(angle) + sqrt((52 mm)^2 - (10 mm*sin(angle))^2) - 52 mm"\n');
  const flat = cam('follower = "flat"\nlift = "10 mm*cos(angle)"\n');
  expect(roller.roller).toBe(0.012);
  expect(flat.roller).toBeNull();
  for (const { outline } of [roller, flat]) for (const [x, y] of outline) expect(Math.hypot(x - 0.01, y)).toBeCloseTo(0.04, 8);
});

it("draws the base circle where the lift is not known", () => {
  for (const [x, y] of cam('lift = "table(angle)"\n').outline) expect(Math.hypot(x, y)).toBeCloseTo(0.04, 8);
});

// A hill of 10 cm; the upper side of the band is the edge.
it("draws a band below a curved edge", () => {
  const { outline, roller } = readModel(`[joint.J]\ntype = "edge"\nbetween = ["ground.O", "b.P"]\nheight = "0.1 m - x^2/(1 m)"\nfrom = -0.3\nto = "30 cm"\nroller_radius = 0.05\n`).joints[0]!.profile!;
  expect(roller).toBe(0.05);
  expect(outline[0]).toEqual([-0.3, expect.closeTo(0.01, 12)]);
  expect(Math.max(...outline.map(([, y]) => y))).toBeCloseTo(0.1, 12);
  expect(outline.at(-1)).toEqual([-0.3, expect.closeTo(0.01 - 0.012, 12)]);
});

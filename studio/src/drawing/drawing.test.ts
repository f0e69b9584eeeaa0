import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { describe, expect, it } from "vitest";
import { extent, readModel, worldPoint } from "../model/model";
import { EMPTY_MODEL, addBar, addGroundPin, addMotor } from "../model/operations";
import { fitTo, fromScreen, gridStep, toScreen, zoomAt } from "./camera";
import { hitTest, snap } from "./hit";
import { looksOf } from "./looks";
import { bend, groundGuide, rackTeeth } from "./symbols";
import { finish } from "./tools";

const four = () => readModel(readFileSync(fileURLToPath(new URL("../../../mechanisms/four_bar.toml", import.meta.url)), "utf8"));

describe("the camera", () => {
  it("leads to the screen and back, and keeps the point under a zoom", () => {
    const camera = fitTo({ min: [-1, -2], max: [3, 4] }, { width: 800, height: 600 });
    const there = toScreen(camera, [0.3, -0.7]);
    expect(fromScreen(camera, there)[0]).toBeCloseTo(0.3, 12);
    expect(toScreen(zoomAt(camera, there, 3), [0.3, -0.7])[1]).toBeCloseTo(there[1], 9);
    expect(toScreen(camera, [3, 4])[1]).toBeGreaterThan(0);
  });
  it.each([10, 37, 1462, 9e4])("has a grid of 12 to 30 pixels at %f pixels per metre", (scale) => {
    const pixels = gridStep({ scale, x: 0, y: 0 }) * scale;
    expect(pixels).toBeGreaterThanOrEqual(12 - 1e-9);
    expect(pixels).toBeLessThanOrEqual(30 + 1e-9);
  });
});

describe("blades of flexures", () => {
  const joints = (name: string) => readModel(readFileSync(fileURLToPath(new URL(`../../../mechanisms/${name}.toml`, import.meta.url)), "utf8")).joints;
  it("are one from marker to marker in a leaf spring, two that cross in a cross-spring pivot, none in a pin", () => {
    expect(joints("parallel_spring_stage")[0]?.blades).toEqual([{ length: 0.1, angle: 0, from: 0, to: 0 }]);
    const crossed = joints("cross_spring_pendulum")[0]?.blades ?? [];
    expect(crossed.map((blade) => blade.angle)).toEqual([Math.PI / 4, -Math.PI / 4]);
    for (const blade of crossed) expect(blade.to - blade.from).toBeCloseTo(blade.length, 12);
    expect(joints("four_bar").flatMap((joint) => joint.blades)).toEqual([]);
  });
  it("leave and reach their ends in the directions of the clamps", () => {
    expect(bend([0, 0], 0, [90, 10], 0, 30)).toBe("M0 0C30 0 60 10 90 10");
    expect(bend([0, 0], Math.PI / 2, [0, -90], Math.PI / 2, 30)).toBe("M0 0C0 -30 0 -60 0 -90");
  });
});

describe("what is under the pointer", () => {
  const model = four();
  const looks = looksOf(model, extent(model).size);
  it("is a joint at its pin, a link on its bar, nothing on the paper", () => {
    expect(hitTest(model, looks, [0.02, 0.01], 0.1)?.thing).toEqual({ kind: "joint", name: "O2" });
    expect(hitTest(model, looks, [0.25, 0.433], 0.05)?.thing).toEqual({ kind: "body", name: "crank" });
    expect(hitTest(model, looks, [3, -2], 0.1)).toBeNull();
  });
  it("snaps to points, to bars, to the grid, and to points by way of the grid", () => {
    const at = worldPoint(model, { body: "coupler", marker: "A" });
    expect(snap(model, looks, [at[0] + 0.03, at[1]], 0.1, 0.5).at).toEqual(at);
    expect(snap(model, looks, [0.26, 0.43], 0.1, 0.5).body).toBe("crank");
    expect(snap(model, looks, [3.1, -1.9], 0.1, 0.5)).toEqual({ at: [3, -2], end: null, body: null });
    expect(snap(model, looks, [5.8, 0.15], 0.1, 0.5).end?.marker).toBe("O4");
  });
});

describe("numbers without an end", () => {
  it.each(['"1/0"', "inf", "nan", '"1e300 m * 1e300"'])("%s at a marker leaves the mechanism its size", (value) => {
    const model = readModel(`[body.a]\nposition = [0, 0]\nangle = 0\nmarkers.A = [0, 0]\nmarkers.B = [${value}, 0.2]\n`);
    expect(extent(model).size).toBeLessThan(1);
    expect(readModel(`[parameters]\np = ${value}\n[body.a]\nmass = "p*1 kg"\n`).body.get("a")?.mass).toBe(0);
  });
  it.each([1e8, 1e300, Infinity])("a guide and a rack that reach %f pixels are drawn at once", (reach) => {
    expect(groundGuide(reach, 12).length).toBeLessThan(1e6);
    expect(rackTeeth(reach).length).toBeLessThan(2e6);
  });
});

describe("tools", () => {
  it("say why they cannot", () => {
    const model = readModel(EMPTY_MODEL);
    const context = { model, looks: looksOf(model, 1), reach: 0.01 };
    const nowhere = { at: [0, 0] as const, end: null, body: null };
    for (const tool of ["ground", "pin", "weld", "motor", "torsion", "force", "torque", "trace", "slot"] as const) {
      const made = finish(tool, [nowhere], context);
      expect(typeof made === "string" && made.length > 10, tool).toBe(true);
    }
  });
  it("put a motor on the pin of the ground, and only one", () => {
    let model = readModel(addBar(readModel(EMPTY_MODEL), { at: [0, 0], end: null, body: null }, { at: [0.1, 0], end: null, body: null }).text);
    model = readModel(addGroundPin(model, { at: [0, 0], end: { body: "link1", marker: "A" }, body: "link1" }, "revolute").text);
    const click = { at: [0, 0] as const, end: { body: "link1", marker: "A" }, body: "link1" };
    const made = finish("motor", [click], { model, looks: looksOf(model, 0.1), reach: 0.01 });
    expect(typeof made === "object" && made.made).toEqual([{ kind: "motor", name: "motor1" }]);
    model = readModel(addMotor(model, "A").text);
    expect(finish("motor", [click], { model, looks: looksOf(model, 0.1), reach: 0.01 })).toMatch(/already has a motor/);
  });
});

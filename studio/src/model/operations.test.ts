import { readFileSync, readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { describe, expect, it } from "vitest";
import { distance } from "./geometry";
import { type Body, type Model, readModel, worldPoint } from "./model";
import { EMPTY_MODEL, type Target, addBar, addConnector, addDisc, addForce, addGroundPin, addMesh, addMotor, addPin, addSlider, addSlot, meshFault, toggleTrace } from "./operations";
import { copyThings, pasteThings, removeThings, renameThing } from "./removal";
import { overwritten } from "./placing";
import { keepPoses, movePoint, setBarLength } from "./reshape";
import { massProperties } from "./shape";

const free = (x: number, y: number): Target => ({ at: [x, y], end: null, body: null });
const on = (model: Model, body: string, marker: string): Target => ({ at: worldPoint(model, { body, marker }), end: { body, marker }, body });

function fourBar(): Model {
  let model = readModel(EMPTY_MODEL);
  model = readModel(addBar(model, free(0, 0), free(0.05, 0.1)).text);
  model = readModel(addBar(model, on(model, "link1", "B"), free(0.3, 0.2)).text);
  model = readModel(addBar(model, on(model, "link2", "C"), free(0.3, 0)).text);
  model = readModel(addGroundPin(model, on(model, "link1", "A"), "revolute").text);
  model = readModel(addGroundPin(model, on(model, "link3", "D"), "revolute").text);
  return readModel(addMotor(model, "A").text);
}

/** The largest distance between the two ends of a pin. */
const openness = (model: Model) => Math.max(...model.joints.map((joint) => distance(worldPoint(model, joint.first), worldPoint(model, joint.second))));

describe("drawing", () => {
  it("makes a closed four-bar with letters at its points", () => {
    const model = fourBar();
    expect(model.document.faults).toEqual([]);
    expect(model.joints.map((joint) => joint.name).sort()).toEqual(["A", "B", "C", "D"]);
    expect(openness(model)).toBeLessThan(1e-6);
    expect(model.motors).toEqual([{ name: "motor1", joint: "A", kind: "speed" }]);
  });

  it("gives bars the mass of their shape", () => {
    const body = fourBar().body.get("link1")!;
    const { mass, inertia } = massProperties(body.shape!, [[0, 0], [0.05, 0.1]]);
    expect(body.mass).toBeCloseTo(mass, 5);
    expect(body.inertia / inertia).toBeCloseTo(1, 4);
    const { width: w, thickness } = body.shape!;
    const length = Math.hypot(0.05, 0.1);
    expect(mass / (7850 * thickness * (length * w + (Math.PI * w * w) / 4))).toBeCloseTo(1, 2);
  });

  it("moves a point with all bodies there, and keeps the rest closed", () => {
    const model = readModel(movePoint(fourBar(), { body: "link1", marker: "B" }, [0.07, 0.12]));
    expect(worldPoint(model, { body: "link2", marker: "B" })[0]).toBeCloseTo(0.07, 6);
    expect(openness(model)).toBeLessThan(1e-6);
  });

  it("sets a bar's length exactly", () => {
    const model = readModel(setBarLength(fourBar(), "link1", 0.25));
    const [a, b] = model.body.get("link1")!.markers;
    expect(distance(a!.at, b!.at)).toBeCloseTo(0.25, 9);
  });

  it("adds sliders, slots, discs, springs, forces and traces", () => {
    let model = fourBar();
    model = readModel(addSlider(model, on(model, "link2", "C"), 0, "ground", 0.3).text);
    model = readModel(addSlot(model, { at: [0.1, 0.12], end: null, body: "link2" }, 0.3, "ground").text);
    model = readModel(addDisc(model, free(0.5, 0), 0.1, null).text);
    model = readModel(addDisc(model, free(0.65, 0), 0.05, "gear1").text);
    model = readModel(addConnector(model, "spring", free(0.1, 0.4), on(model, "link2", "C")).text);
    model = readModel(addForce(model, { at: [0.2, 0.15], end: null, body: "link2" }, [3, -4]).text);
    model = readModel(toggleTrace(model, on(model, "link2", "C")).text);
    model = readModel(addPin(model, { at: [0.1, 0.1], end: null, body: "link1" }, { at: [0.1, 0.1], end: null, body: "link3" }, "fixed").text);
    expect(model.document.faults).toEqual([]);
    expect(model.joints.map((joint) => joint.type).sort()).toEqual(["fixed", "gear", "prismatic", "revolute", "revolute", "revolute", "revolute", "revolute", "revolute", "revolute", "slot"]);
    expect(model.joints.find((joint) => joint.type === "gear")?.radii).toEqual([0.1, 0.05]);
    expect(model.body.get("link2")!.markers.find((marker) => marker.name === "C")?.traced).toBe(true);
    expect(openness({ ...model, joints: model.joints.filter((joint) => joint.type === "revolute" && joint.first.body !== "slider1") })).toBeLessThan(1e-5);
  });
});

describe("removing, renaming, copying", () => {
  it("takes along what cannot be without it", () => {
    const model = readModel(removeThings(fourBar(), [{ kind: "body", name: "link1" }]));
    expect(model.joints.map((joint) => joint.name)).toEqual(["C", "D"]);
    expect(model.motors).toEqual([]);
    expect(model.ground.map((marker) => marker.name)).not.toContain("E");
  });

  it("renames with all references", () => {
    const model = readModel(renameThing(renameThingOnce(fourBar()), "joint", "A", "drive"));
    expect(model.motors[0]!.joint).toBe("drive");
    expect(model.joints.every((joint) => [joint.first, joint.second].every((end) => end.body === "ground" || model.body.has(end.body)))).toBe(true);
  });

  it("pastes a copy under fresh names, closed again", () => {
    const model = fourBar();
    const copied = copyThings(model, model.bodies.map((body) => ({ kind: "body" as const, name: body.name })));
    const twice = readModel(pasteThings(model, copied, [0.1, 0.1]).text);
    expect(twice.document.faults).toEqual([]);
    expect(twice.bodies).toHaveLength(6);
    expect(twice.joints).toHaveLength(8);
    expect(openness(twice)).toBeLessThan(1e-5);
  });
});

describe("two gears that are there", () => {
  const apart = () => readModel(addDisc(readModel(addDisc(readModel(EMPTY_MODEL), free(0, 0), 0.1, null).text), free(0.24, 0), 0.05, null).text);

  it("mesh with radii that share their distance, and are as large", () => {
    const model = apart();
    const [a, b] = model.bodies as [Body, Body];
    expect(meshFault(model, a, b)).toBe("");
    const meshed = readModel(addMesh(model, a, b).text);
    expect(meshed.document.faults).toEqual([]);
    expect(meshed.joints.find((one) => one.type === "gear")?.radii).toEqual([0.16, 0.08]);
    expect(meshed.bodies.map((body) => [body.shape?.width, body.massFromShape])).toEqual([[0.32, true], [0.16, true]]);
    expect(meshed.bodies[0]!.mass / a.mass).toBeCloseTo(2.56, 3);
    expect(meshFault(meshed, meshed.bodies[0]!, meshed.bodies[1]!)).toMatch(/already/);
  });

  it("do not where one is none", () => {
    const model = readModel(addBar(apart(), free(0, 1), free(1, 1)).text);
    expect(meshFault(model, model.bodies[0]!, model.bodies[2]!)).toMatch(/link1 is not a gear/);
  });
});

describe("a copy", () => {
  const all = (model: Model) => model.bodies.map((body) => ({ kind: "body" as const, name: body.name }));

  it("has the shapes, what follows from them, and the traces", () => {
    let model = fourBar();
    model = readModel(toggleTrace(model, on(model, "link2", "C")).text);
    const twice = readModel(pasteThings(model, copyThings(model, all(model)), [0.1, 0.1]).text);
    const told = (name: string) => {
      const { shape, massFromShape, inertiaFromShape, markers } = twice.body.get(name)!;
      return { shape, massFromShape, inertiaFromShape, traced: markers.map((marker) => marker.traced) };
    };
    expect(["link1_2", "link2_2", "link3_2"].map(told)).toEqual(["link1", "link2", "link3"].map(told));
    expect(told("link2_2")).toMatchObject({ massFromShape: true, traced: [false, true] });
  });

  it("of a gear is as large as the gear, without the mesh too", () => {
    let model = readModel(addDisc(readModel(EMPTY_MODEL), free(0, 0), 0.1, null).text);
    model = readModel(addDisc(model, free(0.15, 0), 0.05, "gear1").text);
    const bare = readModel(model.document.text.replace(/ *# (shape|from).*/g, ""));
    const copied = readModel(pasteThings(bare, copyThings(bare, [{ kind: "body", name: "gear2" }]), [0.1, 0.1]).text);
    expect(copied.body.get("gear2_2")?.shape).toMatchObject({ kind: "disc", width: 0.1 });
    expect(copied.body.get("gear2_2")?.massFromShape).toBe(false);
  });
});

describe("places in the text", () => {
  const mechanism = (file: string) => readModel(readFileSync(fileURLToPath(new URL(`../../../mechanisms/${file}`, import.meta.url)), "utf8"));
  const changed = (a: string, b: string) => b.split("\n").filter((line, i) => line !== a.split("\n")[i]);

  it("change only where something has moved", () => {
    const text = `${EMPTY_MODEL}
[parameters]
half = "40 mm"
[ground.markers]
P = ["half", "2*half", "30 deg"]
[body.plate]
mass = "1 kg"
inertia = "1 kg*m^2"
position = ["123.4567891 mm", 0]
angle = "half/half*0.1"
markers.A = ["half", 0]
markers.B = ["-half", "20.12345678 mm"]
markers.C = { r = "half", xi = "90 deg" }
markers.D.x = "12 mm"
markers.D.y = 0
`;
    const model = readModel(text);
    const at = worldPoint(model, { body: "plate", marker: "B" });
    const moved = movePoint(model, { body: "plate", marker: "B" }, [at[0] + 0.01, at[1]]);
    expect(changed(text, moved)).toHaveLength(1);
    expect(overwritten(model, moved)).toEqual(["body.plate.markers.B"]);
    const ground = movePoint(model, { body: "ground", marker: "P" }, [0.04, 0.1]);
    expect(changed(text, ground)).toEqual(['P = ["half", "100 mm", "30 deg"]']);
    for (const marker of ["C", "D"]) {
      const to = [0.2, 0.1] as const;
      const again = readModel(movePoint(model, { body: "plate", marker }, to));
      expect(again.document.faults).toEqual([]);
      expect(distance(worldPoint(again, { body: "plate", marker }), to)).toBeLessThan(1e-9);
    }
    expect(keepPoses(model, new Map([["plate", model.body.get("plate")!.pose]]))).toBe(text);
  });

  it("are asked about where they are written with parameters", () => {
    const model = mechanism("quick_return.toml");
    const end = { body: "lever", marker: "B" };
    const [x, y] = worldPoint(model, end);
    expect(overwritten(model, movePoint(model, end, [x + 0.05, y]))).toEqual(["body.lever.markers.B", "body.link.markers.B", "body.link.markers.C"]);
    expect(overwritten(model, movePoint(model, end, [x, y])).filter((path) => path.startsWith("body.lever"))).toEqual([]);
  });

  it("are as exact in a mechanism of micrometres as in one of metres", () => {
    for (const size of [1e-5, 0.1, 10]) {
      const model = readModel(addBar(readModel(EMPTY_MODEL), free(0, 0), free(0.8123456 * size, 0.51234567 * size)).text);
      const again = readModel(movePoint(model, { body: "link1", marker: "B" }, [0.7654321 * size, 0.3 * size]));
      expect(distance(worldPoint(again, { body: "link1", marker: "A" }), [0, 0])).toBeLessThan(1e-8 * size);
      expect(distance(worldPoint(again, { body: "link1", marker: "B" }), [0.7654321 * size, 0.3 * size])).toBeLessThan(1e-8 * size);
    }
  });
});

const renameThingOnce = (model: Model) => readModel(renameThing(model, "body", "link1", "crank"));

describe("the collection", () => {
  const folder = fileURLToPath(new URL("../../../mechanisms/", import.meta.url));
  const files = readdirSync(folder).filter((name) => name.endsWith(".toml"));
  it.each(files)("%s is read whole, and edits keep its comments", (file) => {
    const text = readFileSync(folder + file, "utf8");
    const model = readModel(text);
    expect(model.document.faults).toEqual([]);
    expect(model.bodies.length).toBeGreaterThan(0);
    for (const body of model.bodies) {
      expect(body.mass).toBeGreaterThan(0);
      expect(body.inertia).toBeGreaterThan(0);
    }
    for (const joint of model.joints) for (const end of [joint.first, joint.second]) expect(worldPoint(model, end).every(Number.isFinite)).toBe(true);
    const moved = readModel(keepPoses(model, new Map(model.bodies.map((body) => [body.name, { ...body.pose, x: body.pose.x + 1 }]))));
    expect(moved.document.text.match(/^#.*$/gm)).toEqual(text.match(/^#.*$/gm));
    moved.bodies.forEach((body, i) => expect(body.pose.x).toBeCloseTo(model.bodies[i]!.pose.x + 1, 5));
  });
});

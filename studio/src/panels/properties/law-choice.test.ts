// The choice of a law, with a simulated kernel: what is written, kept and removed. tests/law_choice.test.ts uses the real kernel.
import { beforeEach, expect, it, vi } from "vitest";
import { edit, openText, undo } from "../../actions";
import type { Catalog, CatalogKey } from "../../kernel/protocol";
import { studio } from "../../state";

let missed: (text: string) => Record<string, string> = () => ({});
let gate: Promise<void> = Promise.resolve();
vi.mock("../../play/kernel-session", () => ({
  kernel: {
    read: async (text: string) => {
      await gate;
      return { ok: false, complaints: Object.entries(missed(text)).map(([key, hint]) => ({ severity: "error", key: `joint.A.${key}`, hint, message: "", line: 1, column: 1, length: 1 })) };
    },
  },
}));
const { chooseDefaultFriction, chooseLaw } = await import("./law-choice");

const key = (name: string, more: Partial<CatalogKey> = {}): CatalogKey => ({ name, unit: "m", meaning: "", ...more });
const CATALOG: Catalog = {
  joint_types: [],
  methods: [],
  laws: [
    { word: "linear", meaning: "", role: "law", keys: [key("stiffness", { default: 1e8 })] },
    { word: "clearance", meaning: "", role: "law", keys: [key("clearance"), key("pin_radius", { default: 0.01 }), key("restitution", { default: 0.8 })] },
    { word: "lugre", meaning: "", role: "friction", keys: [key("pin_radius", { default: 0 }), key("static_friction", { default: 0.15 })] },
    { word: "hard", meaning: "", role: "stops", keys: [key("lower_stop", { otherwise: "none" }), key("upper_stop", { otherwise: "none" }), key("stop_stiffness", { angular_unit: "N*m/rad" }), key("own", { minimum: 2, angular_unit: "rad" })] },
  ],
};
const MODEL = `[joint.A]\ntype = "revolute"\n`;
const text = () => studio.get().history.text;
const choose = (role: "law" | "friction" | "stops", word: string) => chooseLaw(CATALOG, studio.get().model.joints[0]!, role, word);
const without = (...names: string[]) => (now: string) => Object.fromEntries(names.filter((name) => !now.includes(`${name} =`)).map((name) => [name, ""]));

beforeEach(() => {
  gate = Promise.resolve();
  missed = () => ({});
  openText(MODEL, "a.toml");
});

it("a law comes with what it must have, in one step, and goes with what only it knew", async () => {
  missed = without("clearance");
  await choose("law", "clearance");
  expect(text()).toBe(`${MODEL}law = "clearance"\nclearance = "0.5 mm"\n`);
  undo();
  expect(text()).toBe(MODEL);
  await choose("law", "clearance");
  missed = () => ({});
  await choose("law", "linear");
  expect(text()).toBe(`${MODEL}law = "linear"\n`);
});

it("friction of a pin has the pin's radius, which the kernel misses in pins only", async () => {
  missed = without("pin_radius");
  await choose("friction", "lugre");
  expect(text()).toBe(`${MODEL}friction = "lugre"\npin_radius = "10 mm"\n`);
  await choose("friction", "");
  expect(text()).toBe(MODEL);
  missed = () => ({});
  await choose("friction", "lugre");
  expect(text()).toBe(`${MODEL}friction = "lugre"\n`);
});

it("friction of all joints has what any of them misses, and leaves keys that a joint's law shares", async () => {
  openText(`${MODEL}law = "clearance"\nclearance = "1 mm"\n`, "a.toml");
  missed = without("pin_radius");
  await chooseDefaultFriction(CATALOG, "lugre");
  const defaults = text().replace(`${MODEL}law = "clearance"\nclearance = "1 mm"\n`, "");
  expect(defaults.trim()).toBe(`[defaults.joint]\nfriction = "lugre"\npin_radius = "10 mm"`);
  await chooseDefaultFriction(CATALOG, "");
  expect(text()).toContain(`pin_radius = "10 mm"`); // the law with clearance reads it
  expect(text()).not.toContain("lugre");
  undo();
  expect(text()).toContain(`friction = "lugre"`);
});

it("friction of the defaults keeps a joint's radius when its law goes", async () => {
  openText(`[defaults.joint]\nfriction = "lugre"\n\n${MODEL}law = "clearance"\nclearance = "1 mm"\npin_radius = "7 mm"\n`, "a.toml");
  await choose("law", "linear");
  expect(text()).toBe(`[defaults.joint]\nfriction = "lugre"\n\n${MODEL}law = "linear"\npin_radius = "7 mm"\n`);
  await choose("friction", "none");
  expect(text()).toContain(`friction = "none"`);
});

it("a key that another law of the joint knows too keeps its value", async () => {
  openText(`${MODEL}law = "clearance"\nclearance = "1 mm"\npin_radius = "7 mm"\nfriction = "lugre"\n`, "a.toml");
  await choose("law", "linear");
  expect(text()).toBe(`${MODEL}law = "linear"\npin_radius = "7 mm"\nfriction = "lugre"\n`);
});

it("what is missed after other keys are there is stated too, with the units of a pin", async () => {
  const stops = (now: string): Record<string, string> => (now.includes("upper_stop") ? {} : { stops: "lower_stop, upper_stop or both" });
  missed = (now) => (now.includes("stop_stiffness") ? { ...without("own")(now), ...stops(now) } : without("stop_stiffness")(now));
  await choose("stops", "hard");
  expect(text()).toBe(`${MODEL}stops = "hard"\nstop_stiffness = "1e4 N*m/rad"\nupper_stop = "90 deg"\nown = "2 rad"\n`);
});

it("a default that does not go with another value stays, for the user to see what is wrong", async () => {
  missed = () => ({ static_friction: "not below friction_coefficient", friction: "friction_coefficient, and no friction" });
  await choose("friction", "lugre");
  expect(text()).toBe(`${MODEL}friction = "lugre"\n`);
});

it("writes nothing over a text that has changed in the meantime", async () => {
  let open = () => undefined as void;
  gate = new Promise((resolve) => (open = resolve));
  const chosen = choose("law", "clearance");
  edit(`${MODEL}damping = 1\n`, "damping");
  open();
  await chosen;
  expect(text()).toBe(`${MODEL}damping = 1\n`);
});

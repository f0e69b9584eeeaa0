import { page } from "../tests/page";
import { beforeEach, expect, it, vi } from "vitest";
import { openText } from "./actions";
import { copySelection, duplicate, paste } from "./clipboard";
import { EMPTY_MODEL, addBar } from "./model/operations";
import { readModel } from "./model/model";
import { studio } from "./state";

const bar = addBar(readModel(EMPTY_MODEL), { at: [0, 0], end: null, body: null }, { at: [0.1, 0], end: null, body: null }).text;
let system = "";
const places = () => studio.get().model.bodies.map((body) => `${body.pose.x.toFixed(3)} ${body.pose.y.toFixed(3)}`);

beforeEach(() => {
  vi.stubGlobal("navigator", { clipboard: { writeText: async (text: string) => void (system = text), readText: async () => system } });
  openText(bar, "a.toml");
  studio.set({ selection: [{ kind: "body", name: "link1" }] });
});

it("puts each further copy a step farther", async () => {
  copySelection();
  for (let i = 0; i < 3; i++) await paste();
  expect(new Set(places()).size).toBe(4);
});

it("pastes what another tab has copied meanwhile", async () => {
  copySelection();
  await paste();
  page.dispatchEvent(new Event("blur"));
  system = '[body.wheel]\nmass = "1 kg"\ninertia = "1 kg*m^2"\nposition = [0, 0]\nangle = 0\n';
  await paste();
  expect(studio.get().model.bodies.map((body) => body.name)).toEqual(["link1", "link1_2", "wheel"]);
});

it("pastes its own copy where the clipboard may not be read", async () => {
  vi.stubGlobal("navigator", { clipboard: { writeText: () => Promise.reject(new Error("no")), readText: () => Promise.reject(new Error("no")) } });
  duplicate();
  page.dispatchEvent(new Event("blur"));
  await paste();
  expect(studio.get().model.bodies).toHaveLength(3);
});

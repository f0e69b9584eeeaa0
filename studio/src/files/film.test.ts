import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, it, vi } from "vitest";
import { looksOf } from "../drawing/looks";
import type { View } from "../drawing/view";
import type { RunAnswer } from "../kernel/protocol";
import { extent, readModel } from "../model/model";
import type { StudioState } from "../state";

/** As much of an element as an invisible drawing needs. */
class Element {
  children: Element[] = [];
  attributes = new Map<string, string>();
  textContent = "";
  constructor(readonly name: string) {}
  appendChild(one: Element) {
    this.children.push(one);
  }
  append(...more: Element[]) {
    this.children.push(...more);
  }
  replaceChildren(...more: Element[]) {
    this.children = more;
  }
  setAttribute(key: string, value: string) {
    this.attributes.set(key, value);
  }
  cloneNode() {
    return Object.assign(new Element(this.name), { attributes: new Map(this.attributes) });
  }
  get places(): string[] {
    return [this.attributes.get("transform") ?? "", ...this.children.flatMap((one) => one.places)];
  }
}

it("a film moves by the run and takes nothing from the page but how it looks", async () => {
  vi.stubGlobal("document", { createElementNS: (_: string, name: string) => new Element(name) });
  const { Film } = await import("./film");
  const model = readModel(readFileSync(fileURLToPath(new URL("../../../mechanisms/four_bar.toml", import.meta.url)), "utf8"));
  const column = (quantity: string) => ({ name: quantity, unit: "", about: "", kind: "body", of: "crank", quantity, frame: "", feels: "" });
  const answer = {
    columns: [{ ...column("t"), kind: "time" }, column("x"), column("y"), column("angle")],
    values: [[0, 1, 2], [0, 0.5, 1], [0, 0, 0], [0, 1, 2]].map((values) => Float64Array.from(values)),
    joints: [],
  } as unknown as RunAnswer;
  const layers = Object.fromEntries(["grid", "trace"].map((name) => [name, Object.assign(new Element("g"), { children: [new Element(name)] })]));
  const view = { scene: { layers }, looks: looksOf(model, extent(model).size), camera: { scale: 100, x: 0, y: 0 } } as unknown as View;
  const now = { model, show: { labels: true, forces: true, grid: true, traces: true, centres: false }, ghost: { on: true, answer } } as unknown as StudioState;
  const film = new Film(view, now, answer);
  const places = (t: number) => {
    film.show(t);
    return (film.svg as unknown as Element).places;
  };
  expect(film.end).toBe(2);
  const begin = places(0);
  const moved = places(1).filter((place, i) => place !== begin[i]);
  expect(moved).toContain("translate(50 0) rotate(-57.3)");
  expect(moved.length).toBeGreaterThan(2);
  expect(places(0)).toEqual(begin);
  expect((film.svg as unknown as Element).children[0]?.children.map((one) => one.name)).toEqual(["grid"]);
});

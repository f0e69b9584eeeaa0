import { describe, expect, it } from "vitest";
import { lineColumn, nodeAt, parseToml, plain } from "./toml";

describe("reading TOML with places", () => {
  it("reads tables, dotted keys, inline tables, lists and comments", () => {
    const { root, faults } = parseToml(`format = 1 # head
[body.crank]
mass = "1 kg"
markers.A = [1, 0.5e-1]
markers.B = { r = "2 m", xi = '3 deg' }
[joint]
O = { type = "revolute", between = ["ground.O",
  "crank.A"] }
`);
    expect(faults).toEqual([]);
    expect(plain(root)).toEqual({
      format: 1,
      body: { crank: { mass: "1 kg", markers: { A: [1, 0.05], B: { r: "2 m", xi: "3 deg" } } } },
      joint: { O: { type: "revolute", between: ["ground.O", "crank.A"] } },
    });
  });

  it("keeps the place of every value", () => {
    const text = 'a = 1\n[t]\nlong_name = "x \\" y"  # why\n';
    const node = nodeAt(parseToml(text).root, ["t", "long_name"])!;
    expect(text.slice(node.from, node.to)).toBe('"x \\" y"');
    expect(lineColumn(text, node.from)).toEqual({ line: 3, column: 13 });
  });

  it("says where it is wrong and reads on", () => {
    const text = 'a = 1\nb = 2 m\nc = "open\n[t]\nd = 4\nd = 5\n[t]\ne = 1\n';
    const { root, faults } = parseToml(text);
    expect(faults.map((fault) => lineColumn(text, fault.from).line)).toEqual([2, 3, 6, 7]);
    expect(plain(root)).toMatchObject({ a: 1, t: { d: 4 } });
  });

  it.each(["[", "a", "a =", "=", "[[x]]", "a = [1,", 'a = """', "a = {b", "\u0000", "[a]\n[a.b]\n[a]"])("survives %j", (text) => {
    expect(parseToml(text).faults.length).toBeGreaterThan(0);
  });
});

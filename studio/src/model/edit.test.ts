import { describe, expect, it } from "vitest";
import { Draft, writeNumber } from "./edit";
import { parseToml, plain } from "./toml";

const TEXT = `# A model.
format = 1

[ground.markers]
O = [0, 0]  # the pin

# The crank turns.
[body.crank]
mass = "1 kg"
markers.A = [1, 0]

[joint]
O = { type = "revolute" }
`;

describe("edits of a text", () => {
  it("changes a value and nothing else", () => {
    expect(new Draft(TEXT).set(["body", "crank", "mass"], "2 kg").apply()).toBe(TEXT.replace('"1 kg"', '"2 kg"'));
  });

  it("adds a key behind its table's last", () => {
    const text = new Draft(TEXT).set(["body", "crank", "inertia"], 3).set(["body", "crank", "markers", "B"], [2, 0]).apply();
    expect(text).toContain('markers.A = [1, 0]\ninertia = 3\nmarkers.B = [2, 0]\n');
    expect(text).toContain("# The crank turns.");
  });

  it("adds to an inline table, and makes tables that are not there, in order", () => {
    const text = new Draft(TEXT).set(["joint", "O", "stiffness"], 5).set(["simulate", "duration"], "1 s").set(["motor", "m", "joint"], "O").apply();
    expect(text).toContain('O = { type = "revolute", stiffness = 5 }');
    expect(text.indexOf("[simulate]")).toBeLessThan(text.indexOf("[ground.markers]"));
    expect(text.indexOf("[motor.m]")).toBeGreaterThan(text.indexOf("[joint]"));
    expect(parseToml(text).faults).toEqual([]);
  });

  it("makes a body with its markers in one table", () => {
    const text = new Draft(TEXT).set(["body", "rod", "mass"], 1).set(["body", "rod", "markers", "A"], [0, 0]).set(["body", "rod", "markers", "B"], [1, 0]).apply();
    expect(text).toContain("[body.rod]\nmass = 1\nmarkers.A = [0, 0]\nmarkers.B = [1, 0]\n");
  });

  it("removes a table with its comment, a line, an inline entry", () => {
    const text = new Draft(TEXT).remove(["body", "crank"]).remove(["ground", "markers", "O"]).remove(["joint", "O", "type"]).apply();
    expect(text).not.toContain("crank");
    expect(text).not.toContain("the pin");
    expect(plain(parseToml(text).root)).toEqual({ format: 1, ground: { markers: {} }, joint: { O: {} } });
  });

  it("renames headers and keys", () => {
    const text = new Draft(TEXT).rename(["body", "crank"], "wheel").rename(["joint", "O"], "P").apply();
    expect(text).toContain("[body.wheel]");
    expect(text).toContain('P = { type = "revolute" }');
  });

  it("sets and clears remarks", () => {
    const text = new Draft(TEXT).remark(["body", "crank", "markers", "A"], "trace").remark(["ground", "markers", "O"], "").apply();
    expect(text).toContain("markers.A = [1, 0]  # trace\n");
    expect(text).toContain("O = [0, 0]\n");
  });

  it("writes numbers short", () => {
    expect([0.1 + 0.2, 1e-9, 12345678, 1e21, -0].map(writeNumber)).toEqual(["0.3", "1e-9", "12345678", "1e21", "0"]);
  });
});

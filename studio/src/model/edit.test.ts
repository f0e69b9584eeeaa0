import { describe, expect, it } from "vitest";
import { Draft, unfolded, writeNumber } from "./edit";
import { readModel } from "./model";
import { toggleTrace } from "./operations";
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

  it("sets and clears its own remarks, and leaves the author's comments", () => {
    const marked = new Draft(TEXT).remark(["body", "crank", "markers", "A"], "trace").remark(["ground", "markers", "O"], "trace").remark(["body", "crank", "mass"], "").apply();
    expect(marked).toContain("markers.A = [1, 0]  # trace\n");
    expect(marked).toContain("O = [0, 0]  # the pin  # trace\n");
    const model = readModel(marked);
    expect([model.ground[0]!.traced, model.body.get("crank")!.markers[0]!.traced]).toEqual([true, true]);
    expect(new Draft(marked).remark(["body", "crank", "markers", "A"], "").remark(["ground", "markers", "O"], "").apply()).toBe(TEXT);
  });

  it("keeps the comment behind a mass that is typed", () => {
    const weighed = TEXT.replace('"1 kg"', '"2 kg"  # weighed, 3 May');
    expect(new Draft(weighed).set(["body", "crank", "mass"], "3 kg").remark(["body", "crank", "mass"], "").apply()).toBe(weighed.replace("2 kg", "3 kg"));
    const own = TEXT.replace('"1 kg"', '"2 kg"  # from its shape  # weighed');
    expect(new Draft(own).remark(["body", "crank", "mass"], "").apply()).toBe(own.replace("  # from its shape", ""));
    const crlf = TEXT.replace(/\n/g, "\r\n");
    expect(new Draft(crlf).remark(["body", "crank", "mass"], "from its shape").apply()).toBe(crlf.replace('"1 kg"', '"1 kg"  # from its shape'));
  });

  it("does not write a remark into a line that goes on, and unfolds it for one", () => {
    const folded = TEXT.replace("markers.A = [1, 0]", "markers = { A = [0, 0], B = [1, 0] }  # both ends");
    expect(new Draft(folded).remark(["body", "crank", "markers", "A"], "trace").apply()).toBe(folded);
    expect(readModel(folded.replace("both ends", "trace")).body.get("crank")!.markers.map((one) => one.traced)).toEqual([false, false]);
    const traced = toggleTrace(readModel(folded), { at: [0, 0], end: { body: "crank", marker: "A" }, body: "crank" }).text;
    expect(traced).toContain("markers.A = [0, 0]  # trace\nmarkers.B = [1, 0]  # both ends\n");
    expect(plain(parseToml(traced).root)).toEqual(plain(parseToml(folded).root));
    const another = readModel(toggleTrace(readModel(folded), { at: [0.5, 0], end: null, body: "crank" }).text);
    expect(another.document.faults).toEqual([]);
    expect(another.body.get("crank")!.markers.map((one) => [one.name, one.traced])).toEqual([["A", false], ["B", false], ["C", true]]);
    const deep = 'body = { bar = { mass = 1, markers = { A = [0, 0], B.x = 1, B.y = 2 } } }';
    expect(unfolded(deep, ["body", "bar", "markers", "A"])).toBe("body.bar.mass = 1\nbody.bar.markers.A = [0, 0]\nbody.bar.markers.B.x = 1\nbody.bar.markers.B.y = 2");
  });

  it("writes numbers short", () => {
    expect([0.1 + 0.2, 1e-9, 12345678, 1e21, -0].map(writeNumber)).toEqual(["0.3", "1e-9", "12345678", "1e21", "0"]);
  });
});

// The WebAssembly kernel against the native one: the same calls, answered by both. PINTLE_ANSWERS is the native program
// (build/test/bin/pintle-answers), PINTLE_WASM the module; without them there is nothing to compare, and make studio-test sets both.
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, describe, expect, it } from "vitest";
import { startModule, type KernelModule } from "../src/kernel/module";
import type { AssemblyAnswer, CheckReport, LiveFrame, ReadAnswer, RunAnswer } from "../src/kernel/protocol";
import { answers, type Call, files, native, root, texts } from "./native-answers";

const wasm = process.env.PINTLE_WASM ?? join(root, "build/web/bin/pintle.wasm");
const demanded = process.env.PINTLE_ANSWERS !== undefined;

/** Of what is computed from the same numbers by a few operations. */
const kSame = 1e-12;
/** Of the forces at the start: its slow motion is looked for over a time that follows from a few rough steps, whose number the last bits can change. */
const kStart = 5e-5;
/** Of the stated errors: they are estimates (docs/theory/time.md, section 6), which docs/battery.md holds to a third of the true error. */
const kPromised = 3;

// Those whose whole run is a matter of a second.
const runs = [...texts.keys()].filter((name) => !/andrews|n_four_bar_40|n_four_bar_10|n_four_bar_2|five_bar/.test(name));

let module: KernelModule;

function inWasm(calls: Call[]): unknown[] {
  return calls.map((each) => module.call(each.call, { ...each.arguments, files }).value);
}

/** The largest difference over the largest size, entry by entry of both lists. */
function difference(a: Float64Array, b: Float64Array): number {
  expect(a.length).toBe(b.length);
  let most = 0, size = 1e-300;
  a.forEach((x, i) => {
    most = Math.max(most, Math.abs(x - (b[i] ?? NaN)));
    size = Math.max(size, Math.abs(x));
  });
  return most === 0 ? 0 : most / size;
}

/** The same, but for the last bits of numbers: of a tangent, the two libraries differ there. */
function expectSame(a: unknown, b: unknown, at = "") {
  if (typeof a === "number" && typeof b === "number" && !Object.is(a, b)) expect(Math.abs(a - b), at).toBeLessThanOrEqual(4 * Number.EPSILON * Math.abs(b));
  else if (typeof a === "object" && typeof b === "object" && a !== null && b !== null) {
    expect(Object.keys(a), at).toEqual(Object.keys(b));
    for (const [key, value] of Object.entries(a)) expectSame(value, (b as Record<string, unknown>)[key], `${at}.${key}`);
  } else expect(a, at).toEqual(b);
}

function pairs<T>(calls: Call[]): [T, T][] {
  const a = native(calls) as T[], b = inWasm(calls) as T[];
  return a.map((value, i) => [value, b[i] as T]);
}

const ready = existsSync(answers) && existsSync(wasm);
if (demanded && !ready) throw new Error(`${answers} or ${wasm} is missing`);

describe.skipIf(!ready)("the same numbers", { timeout: 120_000 }, () => {
  beforeAll(async () => {
    module = await startModule(readFileSync(wasm));
  });

  it("reads every model to the last bits", () => {
    for (const [a, b] of pairs<ReadAnswer>([...texts.values()].map((text) => ({ call: "read", arguments: { text } })))) {
      expect(a.ok).toBe(true);
      expectSame(b, a); // expressions evaluated, units converted
    }
  });

  it("makes the same complaints", () => {
    const folder = join(root, "tests/broken");
    const broken = readdirSync(folder).filter((name) => name.endsWith(".toml") && name !== "expected.toml");
    const calls = broken.map((name) => ({ call: "read", arguments: { text: readFileSync(join(folder, name), "utf8") } }));
    const both = pairs<ReadAnswer>(calls);
    both.forEach(([a, b], i) => expect(b, broken[i]).toEqual(a));
    expect(both.length).toBeGreaterThan(50);
  });

  it("finds the same positions and the same mobility", () => {
    for (const name of texts.keys()) {
      const text = texts.get(name) ?? "";
      const bodies = (inWasm([{ call: "open_drag", arguments: { text } }])[0] as { id: number; bodies: string[] });
      inWasm([{ call: "close_drag", arguments: { id: bodies.id } }]);
      const before = module.call("open_drag", { text, files }).value as { id: number };
      const answer = module.call("drag", { id: before.id }).value as AssemblyAnswer;
      const [, b] = native([{ call: "open_drag", arguments: { text } }, { call: "drag", arguments: { id: 1 } }]) as [unknown, AssemblyAnswer];
      expect(answer.ok, name).toBe(b.ok);
      expect(difference(b.poses, answer.poses), name).toBeLessThan(kSame);
    }
    const checks = pairs<CheckReport>(runs.map((name) => ({ call: "check", arguments: { text: texts.get(name) ?? "" } })));
    checks.forEach(([a, b], i) => {
      expect(b.mobility.mobility, runs[i]).toBe(a.mobility.mobility);
      expect(b.mobility.redundant, runs[i]).toBe(a.mobility.redundant);
      expect(b.passed, runs[i]).toBe(a.passed);
      expect(b.warnings, runs[i]).toEqual(a.warnings);
    });
  });

  // A run chooses its steps by what it computes, so a last bit (of a sine: two libraries) can become another step. What holds is what
  // a run promises: its forces, within the errors that it states.
  it("gives the same forces within what the stated errors promise", () => {
    const both = pairs<RunAnswer>(runs.map((name) => ({ call: "run", arguments: { text: texts.get(name) ?? "" } })));
    both.forEach(([a, b], i) => {
      expect(b.outcome, runs[i]).toBe(a.outcome);
      expect(b.columns, runs[i]).toEqual(a.columns);
      if (a.outcome === "horizon") return; // a chaotic motion: its peaks are beyond what is promised
      const largest = Math.max(...a.joints.map((joint) => joint.peak));
      a.joints.forEach((joint, j) => {
        const other = b.joints[j];
        if (!other) throw new Error("a joint is missing");
        const allowed = kPromised * (joint.error_estimate + other.error_estimate) + kSame * largest + (joint.peak_time === 0 ? kStart * joint.peak : 0);
        expect(Math.abs(joint.peak - other.peak), `${runs[i]} ${joint.name}`).toBeLessThanOrEqual(allowed);
      });
    });
  });

  it("plays the same motion", () => {
    const text = texts.get("four_bar.toml") ?? "";
    const calls: Call[] = [{ call: "open_live", arguments: { text } }];
    for (let i = 0; i < 60; ++i) calls.push({ call: "advance", arguments: { id: 1, dt: 1 / 60, pull: null, budget: 0 } });
    const a = native(calls) as LiveFrame[];
    const id = (module.call("open_live", { text }).value as { id: number }).id;
    for (let i = 1; i < calls.length; ++i) {
      const b = module.call("advance", { id, dt: 1 / 60, pull: null, budget: 0 }).value as LiveFrame;
      const frame = a[i];
      if (!frame) throw new Error("a frame is missing");
      expect(difference(frame.poses, b.poses)).toBeLessThan(1e-9);
      expect(difference(frame.joint_forces, b.joint_forces)).toBeLessThan(1e-5);
    }
  });
});

// Laws chosen in the form of a joint, as the native kernel takes them: whatever is chosen can be run, and makes a difference.
import { existsSync } from "node:fs";
import { describe, expect, it, vi } from "vitest";
import { openText } from "../src/actions";
import type { Catalog, ReadAnswer, RunAnswer } from "../src/kernel/protocol";
import { Draft } from "../src/model/edit";
import type { Role } from "../src/panels/properties/law-choice";
import { studio } from "../src/state";
import { answers, native, texts } from "./native-answers";

const ask = <T>(call: string, text = "") => native([{ call, arguments: { text } }])[0] as T;
const read = (text: string) => ask<ReadAnswer>("read", text);
// The program is waited for; between two of its answers the test runner has its turn.
vi.mock("../src/play/kernel-session", () => ({ kernel: { read: (text: string) => new Promise((answered) => setImmediate(() => answered(read(text)))) } }));
const { chooseDefaultFriction, chooseLaw } = await import("../src/panels/properties/law-choice");

const ready = existsSync(answers);
const catalog = ready ? ask<Catalog>("catalog") : ({ joint_types: [], laws: [], methods: [] } satisfies Catalog);
const jointNamed = (name: string) => studio.get().model.joints.find((one) => one.name === name)!;

/** The text with another law of the joint. */
async function chosen(joint: string, role: Role, word: string): Promise<string> {
  await chooseLaw(catalog, jointNamed(joint), role, word);
  return studio.get().history.text;
}

const complaints = (text: string) => read(text).complaints.map((one) => `${one.key}: ${one.message}`);
const linesOnlyIn = (text: string, other: string) => text.split("\n").filter((line) => !other.split("\n").includes(line));

describe.skipIf(!ready)("a law that is chosen", { timeout: 120_000 }, () => {
  it("changes its key and those that it must have, and the force that is computed", async () => {
    const first = texts.get("four_bar.toml")!;
    openText(first, "four_bar.toml");
    const peak = (text: string) => ask<RunAnswer>("run", text).joints.find((one) => one.name === "A")!;
    let [before, force] = [first, peak(first)];
    const steps: [Role, string, RegExp][] = [
      ["law", "clearance", /^law = "clearance";clearance = "0.5 mm"$/],
      ["law", "maxwell", /^law = "maxwell";branch_ratio = \[1\];branch_time = \["0.1 s"\]$/],
      ["friction", "lugre", /^friction = "lugre";pin_radius = "10 mm"$/],
    ];
    for (const [role, word, added] of steps) {
      const text = await chosen("A", role, word), lines = linesOnlyIn(text, before);
      expect(lines.join(";")).toMatch(added);
      expect(complaints(text)).toEqual([]);
      // None of them could have been left out.
      for (const line of lines.slice(1)) expect(read(text.replace(`${line}\n`, "")).ok, line).toBe(false);
      const now = peak(text);
      expect(Math.abs(now.peak - force.peak), word).toBeGreaterThan(now.error_estimate + force.error_estimate);
      [before, force] = [text, now];
    }
    await chosen("A", "friction", "");
    const last = await chosen("A", "law", "linear");
    expect([linesOnlyIn(last, first), linesOnlyIn(first, last)]).toEqual([['law = "linear"'], []]);
    expect(peak(last).peak).toBe(peak(first).peak);
  });

  it("is friction of all joints, of which one says otherwise", async () => {
    const first = texts.get("four_bar.toml")!;
    openText(first, "four_bar.toml");
    await chooseDefaultFriction(catalog, "coulomb");
    const everywhere = studio.get().history.text;
    expect(linesOnlyIn(everywhere, first)).toEqual(['friction = "coulomb"', 'pin_radius = "10 mm"']);
    expect(complaints(everywhere)).toEqual([]);
    const friction = (text: string) => complaints(text).length === 0 && ask<RunAnswer>("run", text).joints.map((one) => one.peak);
    const none = await chosen("A", "friction", "none");
    expect(linesOnlyIn(none, everywhere)).toEqual(['friction = "none"']);
    expect(friction(none)).not.toEqual(friction(everywhere));
    await chosen("A", "friction", "");
    await chooseDefaultFriction(catalog, "");
    expect(linesOnlyIn(studio.get().history.text, first)).toEqual([]);
  });

  // From a joint with nothing but a linear law.
  it.each(catalog.joint_types)("is complete in a $word joint", async (type) => {
    const pattern = new RegExp(`\\[joint\\.([\\w-]+)\\][^[]*\\btype = "${type.word}"`);
    const [file, name] = [...texts].map(([file, text]) => [file, pattern.exec(text)?.[1]] as const).find(([, found]) => found)!;
    openText(texts.get(file)!, file);
    for (const role of ["friction", "stops", "detent"] as const) await chosen(name!, role, "");
    await chosen(name!, "law", "linear");
    const plain = new Draft(studio.get().history.text).remove(["joint", name!, "ideal"]).apply();
    const before = complaints(plain); // of a cylinder that has no stops
    for (const law of catalog.laws.filter((one) => type.laws.includes(one.word) && (one.role !== "law" || type.gap.length > 0))) {
      openText(plain, file);
      const text = await chosen(name!, law.role, law.word);
      expect(text, law.word).toContain(`${law.role} = "${law.word}"`);
      expect(complaints(text).filter((one) => !before.includes(one)), `${law.word} in ${file}`).toEqual([]);
    }
  });
});

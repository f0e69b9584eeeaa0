// A four-bar from an empty canvas, with the mouse, and its forces held against the native program.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { drag, onPage, pintle, settled, shot, state } from "../browser.mjs";

async function drawFourBar(page) {
  const at = {};
  for (const [name, x, y] of [["A", -0.1, -0.04], ["B", -0.09, 0], ["C", 0.08, 0.09], ["D", 0.1, -0.04]]) at[name] = await onPage(page, x, y);
  await page.keyboard.press("l");
  await drag(page, at.A, at.B);
  await drag(page, at.B, at.C);
  await shot(page, "draw-1-links");
  await drag(page, at.C, at.D);
  await page.keyboard.press("g");
  await page.mouse.click(...at.A);
  await page.mouse.click(...at.D);
  await page.keyboard.press("m");
  await page.mouse.click(...at.A);
  return at;
}

export const tests = {
  async "a four-bar from an empty canvas in a minute; its peak force is the native one"(world) {
    const page = await world.visit();
    await shot(page, "draw-0-empty");
    const begin = performance.now();
    await drawFourBar(page);
    await settled(page);
    const seconds = (performance.now() - begin) / 1e3;
    await page.keyboard.press("2");
    await page.locator("[data-joint]").first().waitFor();
    await shot(page, "draw-2-forces");
    assert(seconds < 60, `${seconds} s`);
    assert.deepEqual(await state(page, "(now) => [now.model.bodies.length, now.model.joints.length, now.model.motors.length]"), [3, 4, 1]);
    const shown = await page.locator('[data-joint="B"] [data-peak]').getAttribute("data-peak");
    const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save" }).click()]);
    const folder = mkdtempSync(`${tmpdir()}/studio-`);
    await file.saveAs(`${folder}/drawn.toml`);
    const summary = JSON.parse(execFileSync(pintle(), ["run", `${folder}/drawn.toml`, "--json", "--quiet", "--out", `${folder}/run`], { encoding: "utf8" }));
    const native = summary.joints.find((joint) => joint.name === "B");
    const difference = Math.abs(Number(shown) - native.peak) / native.peak;
    assert(difference < 1e-9, `browser ${shown} N, native ${native.peak} N`);
    assert.deepEqual(page.faults, []);
    await page.context().close();
    return `${seconds.toFixed(1)} s, ${Number(shown).toFixed(3)} N, relative difference ${difference.toExponential(1)}`;
  },

  async "a link is drawn by keys alone, and tools have their keys while the time scale has the focus"(world) {
    const page = await world.visit();
    for (const key of ["l", "ArrowRight", "Enter", "ArrowRight", "ArrowRight", "ArrowRight", "Enter"]) await page.keyboard.press(key);
    assert.equal(await state(page, "(now) => now.model.bodies.length"), 1);
    assert.match(await page.locator(".canvas .visually-hidden[role=status]").textContent(), /link1/);
    await page.getByLabel("Time", { exact: true }).focus();
    await page.keyboard.press("g");
    assert.equal(await state(page, "(now) => now.tool"), "ground");
    assert.deepEqual(page.faults, []);
    await page.context().close();
  },

  async "lengths and angles are typed exactly, while drawing and afterwards"(world) {
    const page = await world.visit();
    const from = await onPage(page, -0.08, -0.05);
    await page.keyboard.press("l");
    await page.mouse.click(...from);
    await page.mouse.move(from[0] + 90, from[1] - 40, { steps: 4 });
    await page.keyboard.type("123.4");
    await page.keyboard.press("Tab");
    await page.keyboard.type("30");
    await shot(page, "draw-3-typed");
    await page.keyboard.press("Enter");
    const bar = await state(page, "(now) => { const b = now.model.bodies[0]; return [Math.hypot(b.markers[1].at[0] - b.markers[0].at[0], b.markers[1].at[1] - b.markers[0].at[1]), b.pose.angle]; }");
    assert(Math.abs(bar[0] - 0.1234) < 1e-9 && Math.abs(bar[1] - Math.PI / 6) < 1e-9, String(bar));
    await page.keyboard.press("Escape");
    const length = page.getByLabel("Length", { exact: true });
    await page.keyboard.press("]");
    await length.fill("50");
    await length.press("Enter");
    const after = await state(page, "(now) => now.model.bodies[0].markers.map((m) => m.at[0])");
    assert(Math.abs(after[1] - after[0] - 0.05) < 1e-9, String(after));
    await page.context().close();
  },

  async "every tool draws, and undo leads back to the empty canvas and forth"(world) {
    const page = await world.visit();
    const at = await drawFourBar(page);
    const click = async (key, ...points) => {
      await page.keyboard.press(key);
      if (points.length === 1) await page.mouse.click(...points[0]);
      else await drag(page, points[0], points[1]);
      await page.waitForTimeout(60);
    };
    const free = await onPage(page, 0.02, -0.08);
    const mid = [(at.B[0] + at.C[0]) / 2, (at.B[1] + at.C[1]) / 2];
    await click("q", at.C, free);
    await click("e", mid, [free[0] - 60, free[1]]);
    await click("f", mid, [mid[0] + 30, mid[1] - 50]);
    await click("t", mid);
    await click("u", at.D);
    await click("r", mid);
    await click("d", [at.D[0] + 150, at.D[1] - 60], [at.D[0] + 190, at.D[1] - 60]);
    await click("i", at.B, [free[0] - 120, free[1]]);
    await click("j", at.C, [free[0] + 60, free[1] - 20]);
    await click("s", [mid[0] + 12, mid[1] - 4], [mid[0] + 70, mid[1] - 4]);
    await page.keyboard.press("Escape");
    await shot(page, "draw-4-all-tools");
    const text = await state(page, "(now) => now.history.text");
    const counts = await state(page, "(now) => [now.model.springs.length, now.model.loads.length, now.model.joints.length, now.complaints.filter((c) => c.severity === 'error')]");
    assert.deepEqual([counts[0], counts[1]], [3, 2]);
    assert(counts[2] >= 9, `${counts[2]} joints`);
    assert.deepEqual(counts[3], []);
    const steps = await state(page, "(now) => now.history.past.length");
    for (let i = 0; i < steps; i++) await page.keyboard.press("Control+z");
    assert.equal(await state(page, "(now) => now.model.bodies.length"), 0);
    for (let i = 0; i < steps; i++) await page.keyboard.press("Control+Shift+z");
    assert.equal(await state(page, "(now) => now.history.text"), text);
    assert.deepEqual(page.faults, []);
    await page.context().close();
    return `${steps} steps`;
  },

  async "copies and pastes, moves by keys, deletes"(world) {
    const page = await world.visit();
    await drawFourBar(page);
    await page.keyboard.press("Escape");
    await page.keyboard.press("Control+a");
    await page.keyboard.press("Control+c");
    await page.keyboard.press("Control+v");
    assert.deepEqual(await state(page, "(now) => [now.model.bodies.length, now.model.joints.length, now.model.motors.length]"), [6, 8, 2]);
    await page.keyboard.press("ArrowRight");
    await settled(page);
    await shot(page, "draw-5-pasted");
    await page.keyboard.press("Delete");
    assert.deepEqual(await state(page, "(now) => [now.model.bodies.length, now.model.joints.length]"), [3, 4]);
    await page.context().close();
  },

  async "a share link carries the drawing to another visitor"(world) {
    const page = await world.visit();
    await drawFourBar(page);
    await page.evaluate(() => Object.defineProperty(navigator, "clipboard", { value: { writeText: async (link) => void (window.copiedLink = link) } }));
    await page.keyboard.press("Control+Shift+L");
    await page.waitForFunction(() => window.copiedLink);
    const hash = new URL(await page.evaluate(() => window.copiedLink)).hash;
    assert.equal(await page.evaluate(() => location.hash), "");
    const text = await state(page, "(now) => now.history.text");
    const other = await world.visit({ hash });
    await other.waitForFunction(() => window.pintleStudio.get().model.bodies.length === 3);
    assert.equal(await state(other, "(now) => now.history.text"), text);
    await page.context().close();
    await other.context().close();
    return `${hash.length} characters`;
  },
};


// What is broken is said where it is; nothing is lost; a large model opens.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { ROOT, openTemplate, settled, shot, state } from "../browser.mjs";

const replaceText = (page, from, to) => page.evaluate(([a, b]) => window.pintleEdit(window.pintleStudio.get().history.text.replace(a, b), "test"), [from, to]);

export const tests = {
  async "a broken model is said with line and hint, and one click mends it"(world) {
    const page = await world.visit();
    await openTemplate(page, "four_bar.toml");
    await settled(page);
    await page.keyboard.press("7");
    await page.locator(".cm-content").waitFor();
    await replaceText(page, 'type = "revolute"', 'type = "revolut"');
    await page.waitForFunction(() => window.pintleStudio.get().complaints.length > 0);
    await page.locator(".scene").first().focus();
    await page.keyboard.press("4");
    const problem = page.locator(".problems .error").first();
    assert.match(await problem.textContent(), /joint\.O2\.type.*revolut/);
    await shot(page, "safe-complaint");
    assert((await page.locator(".cm-lintRange-error").count()) > 0, "the place is not marked in the text");
    await problem.getByRole("button", { name: 'Write "revolute"' }).click();
    await settled(page);
    assert.deepEqual(await state(page, "(now) => now.complaints"), []);
    await page.context().close();
  },

  async "text that is no TOML keeps the drawing, and says where"(world) {
    const page = await world.visit();
    await openTemplate(page, "four_bar.toml");
    await settled(page);
    await replaceText(page, "[body.crank]", "[body.crank");
    assert.equal(await state(page, "(now) => now.stale"), true);
    assert((await page.locator(".canvas .body").count()) === 3, "the drawing is gone");
    await page.keyboard.press("Control+z");
    await settled(page);
    assert.equal(await state(page, "(now) => now.run.status"), "done");
    await page.context().close();
  },

  async "typing in the text draws, drawing writes the text"(world) {
    const page = await world.visit();
    await page.keyboard.press("7");
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+End");
    await page.keyboard.type('\n[ground.markers]\nO = [0, 0]\n[body.bar]\nmass = "1 kg"\ninertia = "0.01 kg*m^2"\nposition = ["100 mm", 0]\nangle = 0\nmarkers.O = ["-100 mm", 0]\nmarkers.P = ["100 mm", 0]\n[joint.O]\ntype = "revolute"\nbetween = ["ground.O", "bar.O"]\n');
    await settled(page);
    assert.equal(await state(page, "(now) => now.model.bodies.length"), 1);
    await page.keyboard.press("Escape");
    await page.locator(".scene").first().focus();
    await page.evaluate(() => window.pintleStudio.set({ selection: [{ kind: "joint", name: "O" }] }));
    await page.keyboard.press("Delete");
    await page.waitForFunction(() => !document.querySelector(".cm-content").textContent.includes("[joint.O]"));
    assert.deepEqual(page.faults, []);
    await page.context().close();
  },

  async "a mechanism that cannot move, close or is not driven says so, with the joint"(world) {
    const page = await world.visit();
    await openTemplate(page, "four_bar.toml");
    await settled(page);
    await replaceText(page, 'O4 = ["6 m", 0]', 'O4 = ["16 m", 0]');
    await page.waitForFunction(() => window.pintleStudio.get().obstacle !== null);
    await page.keyboard.press("4");
    await shot(page, "safe-open");
    assert.match(await page.locator(".problems").textContent(), /close|assembl/i);
    await page.context().close();
  },

  async "a reload loses nothing: text, undo, settings"(world) {
    const page = await world.visit();
    await openTemplate(page, "trammel.toml");
    await replaceText(page, 'name = "Trammel of Archimedes"', 'name = "Mine"');
    await page.keyboard.press("Shift+D");
    const text = await state(page, "(now) => now.history.text");
    const theme = await state(page, "(now) => now.theme");
    await page.waitForTimeout(400);
    await page.reload();
    await page.locator(".scene").first().waitFor();
    assert.equal(await state(page, "(now) => now.history.text"), text);
    assert.equal(await state(page, "(now) => now.theme"), theme);
    await page.keyboard.press("Control+z");
    assert.match(await state(page, "(now) => now.history.text"), /Trammel of Archimedes/);
    await page.context().close();
  },

  async "two tabs keep their own drawing, and a third offers what is left"(world) {
    const page = await world.visit();
    const other = await page.context().newPage();
    for (const [tab, name] of [[page, "One"], [other, "Two"]]) {
      await tab.goto(world.server.url);
      await tab.locator(".scene").first().waitFor();
      await openTemplate(tab, "trammel.toml");
      await replaceText(tab, 'name = "Trammel of Archimedes"', `name = "${name}"`);
      await tab.waitForTimeout(400);
    }
    await page.reload();
    await page.locator(".scene").first().waitFor();
    assert.equal(await state(page, "(now) => now.model.name"), "One");
    await page.evaluate(() => window.pintleStudio.set({ dialog: "drafts" }));
    await page.locator("dialog").getByText("Two, trammel.toml").click();
    assert.equal(await state(page, "(now) => now.model.name"), "Two");
    assert.deepEqual(page.faults, []);
    await page.context().close();
  },

  async "drawing waits while the text is faulty"(world) {
    const page = await world.visit();
    await openTemplate(page, "four_bar.toml");
    await settled(page);
    await replaceText(page, "[body.crank]", "[body.crank");
    const text = await state(page, "(now) => now.history.text");
    await page.evaluate(() => window.pintleStudio.set({ selection: [{ kind: "body", name: "coupler" }] }));
    await page.locator(".scene").first().focus();
    await page.keyboard.press("Delete");
    assert.match(await page.locator(".toasts").textContent(), /Fix the text first/);
    assert.equal(await state(page, "(now) => now.history.text"), text);
    await page.context().close();
  },

  async "another model that is opened does not lose the one before"(world) {
    const page = await world.visit();
    await openTemplate(page, "trammel.toml");
    await replaceText(page, 'name = "Trammel of Archimedes"', 'name = "Mine"');
    await openTemplate(page, "pendulum.toml");
    await page.locator(".scene").first().focus();
    await page.keyboard.press("Control+z");
    assert.equal(await state(page, "(now) => now.fileName + ' ' + now.model.name"), "trammel.toml Mine");
    await page.keyboard.press("Control+Shift+z");
    assert.equal(await state(page, "(now) => now.fileName + ' ' + now.model.name"), "pendulum.toml Pendulum");
    await page.context().close();
  },

  async "files that are no models never show a blank page"(world) {
    const page = await world.visit();
    const drop = (name, text) =>
      page.evaluate(
        ([file, content]) => {
          const data = new DataTransfer();
          data.items.add(new File([content], file));
          window.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
        },
        [name, text],
      );
    for (const [name, text] of [["a.toml", "[[[["], ["b.toml", ""], ["c.json", "{"], ["d.toml", "\u0000\u0001"], ["e.toml", "body = 3\njoint = []\n[ground]\nmarkers = 1\n"], ["f.toml", 'format = 1\n[joint.x]\ntype = "gear"\nbetween = ["a", 3]\n[body.b]\n[motor.m]\njoint = "x"\n']]) {
      await drop(name, text);
      await page.waitForTimeout(400);
      assert(await page.locator(".canvas .scene").isVisible(), `${name}: no drawing`);
      assert.equal(await page.locator(".fence").count(), 0, name);
    }
    await shot(page, "safe-no-model");
    await page.context().close();
  },

  async "a model of 2,000 bodies opens and plays"(world) {
    const page = await world.visit();
    const text = execFileSync("python3", [`${ROOT}mechanisms/n_four_bar.py`, "1000"], { encoding: "utf8", maxBuffer: 64e6 }).replace(/duration = .*/, 'duration = "0.2 s"');
    await page.evaluate((model) => window.pintleOpen(model, "large.toml"), text);
    await page.waitForFunction(() => document.querySelectorAll(".canvas .body").length > 1900, null, { timeout: 60_000 });
    const bodies = await state(page, "(now) => now.model.bodies.length");
    await page.keyboard.press("Space");
    await page.waitForTimeout(3000);
    await shot(page, "safe-large");
    assert.deepEqual(page.faults, []);
    await page.context().close();
    return `${bodies} bodies`;
  },
};

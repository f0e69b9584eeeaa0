// How much is sent, how soon something is seen, and that a reader of screens can read it.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { openTemplate, settled, shot } from "../browser.mjs";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

async function violations(page) {
  await page.addScriptTag({ path: AXE });
  // Colours on their way from one to another are nobody's; only animations that end are waited for.
  await page.evaluate(() =>
    Promise.allSettled(document.getAnimations().filter((one) => one.effect.getComputedTiming().endTime < 2000).map((one) => one.finished)),
  );
  const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  return found.violations.map((one) => `${one.id} (${one.impact}): ${one.nodes.slice(0, 3).map((node) => `${node.target} ${node.failureSummary}`).join(" | ")}`);
}

/** In the page: controls and words of its bars that overlap each other or stick out of their bar. */
function crowded() {
  const found = [];
  for (const bar of [".head", ".transport", ".dock .tabs", ".side .tabs"].map((one) => document.querySelector(one))) {
    const room = bar.getBoundingClientRect();
    const all = [...bar.querySelectorAll("button, select, input, h1, .file, .clock, .mode-badge, .state")];
    const seen = all.map((one) => ({ one, name: one.ariaLabel ?? one.textContent, box: one.getBoundingClientRect() })).filter(({ box }) => box.width > 0 && box.height > 0);
    for (const { name, box } of seen) if (box.left < room.left - 1 || box.right > room.right + 1 || box.bottom > room.bottom + 1) found.push(`${name} sticks out`);
    seen.forEach((a, i) => {
      for (const b of seen.slice(i + 1)) {
        const overlap = Math.min(Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left), Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top));
        if (overlap > 1 && !a.one.contains(b.one)) found.push(`${a.name} on ${b.name}`);
      }
    });
  }
  return found;
}

export const tests = {
  async "first paint under a second, all under 1.5 MB compressed"(world) {
    world.server.sent.clear();
    const page = await world.visit();
    const paint = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime ?? Number.NaN);
    await page.keyboard.press("7");
    await page.locator(".cm-content").waitFor();
    await openTemplate(page, "four_bar.toml");
    await settled(page);
    await page.keyboard.press("?");
    await page.locator("dialog").waitFor();
    const bytes = [...world.server.sent.values()].reduce((sum, size) => sum + size, 0);
    await page.context().close();
    assert(paint < 1000, `first paint after ${paint} ms`);
    assert(bytes < 1.5e6, `${bytes} bytes`);
    return `${Math.round(paint)} ms, ${Math.round(bytes / 1e3)} kB`;
  },

  async "asks nothing of any other host"(world) {
    const page = await world.visit();
    const foreign = [];
    page.on("request", (request) => request.url().startsWith(world.server.url) || /^(data|blob):/.test(request.url()) || foreign.push(request.url()));
    await openTemplate(page, "six_bar.toml");
    await settled(page);
    await page.context().close();
    assert.deepEqual(foreign, []);
  },

  async "controls neither overlap nor leave the window, however narrow"(world) {
    for (const [width, side] of [[640, "properties"], [860, "text"], [1000, "properties"], [1100, "text"], [1280, null]]) {
      const page = await world.visit({ viewport: { width, height: 700 } });
      // The answer to the empty text would replace the state that is set here.
      await page.waitForFunction(() => window.pintleStudio.get().kernelState !== "starting");
      await page.evaluate((side) => {
        const progress = { fraction: 0.42, t: 1, duration: 2, pass: 1, wall_seconds: 4, seconds_left: 12 };
        window.pintleStudio.set((now) => ({ side, dock: "problems", run: { ...now.run, status: "running", progress } }));
      }, side);
      await page.locator(".run-line .state.busy").waitFor();
      assert.deepEqual(await page.evaluate(crowded), [], `${width} px`);
      await page.context().close();
    }
  },

  async "axe finds nothing, light and dark, in every panel"(world) {
    for (const colorScheme of ["light", "dark"]) {
      const page = await world.visit({ colorScheme });
      assert.deepEqual(await violations(page), [], `${colorScheme}, empty`);
      await openTemplate(page, "slider_crank.toml");
      await settled(page);
      for (const key of ["1", "2", "3", "4"]) {
        // A second press of the open tab's key would close it.
        if ((await page.evaluate(() => window.pintleStudio.get().dock)) !== { 1: "plots", 2: "forces", 3: "energy", 4: "problems" }[key]) await page.keyboard.press(key);
        await page.waitForTimeout(250);
        assert.deepEqual(await violations(page), [], `${colorScheme}, dock ${key}`);
      }
      for (const select of ["]", "joint", "motor"]) {
        if (select === "]") await page.keyboard.press("]");
        else await page.evaluate((kind) => window.pintleStudio.set({ dock: "plots", selection: [{ kind, name: window.pintleStudio.get().model[`${kind}s`][0].name }] }), select);
        await page.waitForTimeout(200);
        assert.deepEqual(await violations(page), [], `${colorScheme}, properties of ${select}`);
      }
      for (const key of ["6", "7"]) {
        await page.keyboard.press(key);
        await page.waitForTimeout(500);
        assert.deepEqual(await violations(page), [], `${colorScheme}, side ${key}`);
        await page.locator(".scene").first().focus();
      }
      for (const chord of ["?", "Control+k", "Control+Shift+O"]) {
        await page.keyboard.press(chord);
        await page.locator("dialog").waitFor();
        await page.waitForTimeout(400);
        await shot(page, `axe-${colorScheme}-${chord.replace(/\W/g, "_")}`);
        assert.deepEqual(await violations(page), [], `${colorScheme}, ${chord}`);
        await page.keyboard.press("Escape");
      }
      assert.deepEqual(page.faults, []);
      await page.context().close();
    }
  },
};

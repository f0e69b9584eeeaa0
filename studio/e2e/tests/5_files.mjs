// What leaves the page as a file.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { SHOTS, openTemplate, settled, state } from "../browser.mjs";

async function exported(page, words) {
  const [file] = await Promise.all([page.waitForEvent("download", { timeout: 90_000 }), (async () => {
    await page.getByRole("button", { name: "Export" }).click();
    await page.getByRole("menuitem", { name: words }).click();
  })()]);
  const path = `${SHOTS}${file.suggestedFilename()}`;
  await file.saveAs(path);
  return readFileSync(path);
}

export const tests = {
  async "CSV, SVG, report and GIF are whole"(world) {
    const page = await world.visit();
    await openTemplate(page, "four_bar.toml");
    await settled(page);
    const csv = (await exported(page, "CSV")).toString().trim().split("\n");
    const columns = await state(page, "(now) => now.run.answer.columns.length");
    assert.equal(csv.length, 361 + 2);
    assert(csv.every((line) => line.split(",").length === columns));
    const svg = (await exported(page, "SVG")).toString();
    assert.match(svg, /^<svg[^>]*viewBox/);
    assert(!svg.includes("var(--"), "colours of the page in the SVG");
    const report = (await exported(page, "report")).toString();
    assert.match(report, /: Pintle report<\/title>/);
    assert.match(report, /674\.08 N/);
    await page.getByRole("button", { name: "Play", exact: true }).click();
    const gif = await exported(page, "GIF");
    assert.equal(gif.subarray(0, 6).toString(), "GIF89a");
    assert.equal(gif[gif.length - 1], 0x3b);
    assert.deepEqual(await state(page, "(now) => [now.mode, now.playing]"), ["replay", true], "the film stopped what played");
    assert.deepEqual(page.faults, []);
    await page.context().close();
    return `GIF of ${Math.round(gif.length / 1e3)} kB`;
  },
};

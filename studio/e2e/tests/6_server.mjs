// pintle studio: models of a folder, and long runs with the native kernel.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { BUILT, ROOT, pintle, settled, state } from "../browser.mjs";

/** A server in a folder of its own with one model of the collection, and a page that visits it. */
async function withStudio(world, model, use) {
  const folder = mkdtempSync(`${tmpdir()}/pintle-studio-`);
  copyFileSync(`${ROOT}mechanisms/${model}`, `${folder}/${model}`);
  const server = spawn(pintle(), ["studio", model, "--no-browser", "--port", "0", "--pages", BUILT], { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });
  const context = await world.browser.newContext({ viewport: { width: 1280, height: 800 } });
  try {
    const address = await new Promise((found, failed) => {
      let said = "";
      server.stdout.on("data", (text) => {
        said += text;
        const match = /http:\S+/.exec(said);
        if (match) found(match[0]);
      });
      server.on("exit", (code) => failed(new Error(`pintle studio ended with ${code}`)));
    });
    const page = await context.newPage();
    page.asked = [];
    page.on("response", (response) => /\/api\/runs/.test(response.url()) && page.asked.push(`${response.request().method()} ${response.url().replace(/.*\/api/, "").replace(/\d+/, "N")} ${response.status()}`));
    await page.goto(address);
    await page.waitForFunction((name) => window.pintleStudio?.get().fileName === name, model, { timeout: 20_000 });
    return await use(page, `${folder}/${model}`);
  } finally {
    await context.close();
    server.kill("SIGINT");
    rmSync(folder, { recursive: true });
  }
}

const append = (page, words) => page.evaluate((more) => window.pintleEdit(`${window.pintleStudio.get().history.text}${more}\n`, "x"), words);

async function eventually(check, what) {
  for (let i = 0; i < 100; i++) {
    if (await check()) return;
    await new Promise((done) => setTimeout(done, 100));
  }
  assert.fail(what);
}

export const tests = {
  async "pintle studio opens and saves the model of its folder, and never over somebody else's change"(world) {
    return withStudio(world, "four_bar.toml", async (page, file) => {
      await settled(page);
      await append(page, "# by hand");
      await page.keyboard.press("Control+s");
      await eventually(() => readFileSync(file, "utf8").includes("# by hand"), "the file was not saved");
      writeFileSync(file, "format = 1\n# of somebody else\n");
      await append(page, "# by hand again");
      await page.keyboard.press("Control+s");
      await eventually(() => state(page, "(now) => now.toasts.some((one) => /changed/.test(one.text))"), "nothing was said");
      assert.equal(readFileSync(file, "utf8"), "format = 1\n# of somebody else\n");
    });
  },

  async "a long run is computed by the native kernel"(world) {
    return withStudio(world, "n_four_bar_40.toml", async (page) => {
      await settled(page, 180_000);
      assert.equal(await state(page, "(now) => now.run.status"), "done");
      assert(page.asked.includes("POST /runs 200"), page.asked.join(", ") || "the server was not asked");
      assert(page.asked.includes("GET /runs/N/result 200"), page.asked.join(", "));
      return `${page.asked.filter((one) => one === "GET /runs/N 200").length} questions after its progress`;
    });
  },
};

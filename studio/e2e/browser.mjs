// A page of the studio in a real browser, and the few words that the tests use of it.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { serve } from "./serve.mjs";

export const ROOT = fileURLToPath(new URL("../../", import.meta.url));
export const SHOTS = `${ROOT}build/studio-shots/`;
export const BUILT = process.env.STUDIO ?? `${ROOT}build/studio`;

function chromiumPath() {
  return process.env.CHROMIUM ?? execFileSync("which", ["chromium"], { encoding: "utf8" }).trim();
}

/** The native program, to hold the browser's numbers against. */
export function pintle() {
  const places = [process.env.PINTLE, `${ROOT}build/release/bin/pintle`, `${ROOT}build/test/bin/pintle`];
  const found = places.find((path) => path && existsSync(path));
  assert(found, "no pintle program: make build, or set PINTLE");
  return found;
}

export async function startBrowser() {
  assert(existsSync(`${BUILT}/index.html`), `no studio in ${BUILT}: make studio`);
  mkdirSync(SHOTS, { recursive: true });
  const server = await serve(BUILT);
  const browser = await chromium.launch({ executablePath: chromiumPath(), args: ["--no-sandbox", "--disable-dev-shm-usage"] });
  return {
    server,
    browser,
    /** A fresh visitor. `faults` collects what the page complained of. */
    async visit(options = {}) {
      const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true, ...options });
      const page = await context.newPage();
      // Without the system's file dialogs, saving is a download.
      await page.addInitScript(() => {
        delete window.showSaveFilePicker;
        delete window.showOpenFilePicker;
      });
      page.faults = [];
      page.on("pageerror", (error) => page.faults.push(`${error.message}\n${error.stack ?? ""}`));
      page.on("console", (message) => message.type() === "error" && !/favicon/.test(message.location().url ?? "") && page.faults.push(message.text()));
      await page.goto(server.url + (options.hash ?? ""));
      await page.locator(".scene").first().waitFor();
      return page;
    },
    async close() {
      await browser.close();
      server.close();
    },
  };
}

export const shot = (page, name) => page.screenshot({ path: `${SHOTS}${name}.png` });

/** Waits until the run of the text as it stands is done. */
export async function settled(page, timeout = 60_000) {
  await page.waitForFunction(() => {
    const now = window.pintleStudio.get();
    return !now.stale && (now.run.status === "done" || now.run.status === "failed") && now.model.document.text === now.history.text;
  }, null, { timeout });
}

export const state = (page, part) => page.evaluate(`(() => { const now = window.pintleStudio.get(); return (${part})(now); })()`);

/** Where a point of the world is on the page; through the drawing's own camera. */
export async function onPage(page, x, y) {
  return page.evaluate(([wx, wy]) => {
    const svg = document.querySelector(".canvas .scene");
    const box = svg.getBoundingClientRect();
    const camera = window.pintleView().camera;
    return [box.left + camera.x + wx * camera.scale, box.top + camera.y - wy * camera.scale];
  }, [x, y]);
}

export async function drag(page, from, to, steps = 8) {
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(...to, { steps });
  await page.mouse.up();
}

export async function openTemplate(page, file) {
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+Shift+O");
  await page.locator(`[data-template="${file}"]`).click();
  await page.waitForFunction((name) => window.pintleStudio.get().fileName === name, file);
}

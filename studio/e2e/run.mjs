// The browser tests, one after the other: node e2e/run.mjs [words of names]
import { readdirSync } from "node:fs";
import { startBrowser } from "./browser.mjs";

const wanted = process.argv.slice(2);
const files = readdirSync(new URL("./tests/", import.meta.url)).filter((name) => name.endsWith(".mjs")).sort();
const world = await startBrowser();
let failed = 0;
for (const file of files) {
  const { tests } = await import(`./tests/${file}`);
  for (const [name, test] of Object.entries(tests)) {
    if (wanted.length > 0 && !wanted.some((word) => `${file} ${name}`.includes(word))) continue;
    const begin = performance.now();
    try {
      const said = await test(world);
      console.log(`  ok    ${name}${said ? `: ${said}` : ""} (${((performance.now() - begin) / 1e3).toFixed(1)} s)`);
    } catch (error) {
      failed++;
      console.log(`  FAIL  ${name}\n${error.stack ?? error}`);
    }
  }
}
await world.close();
console.log(failed ? `${failed} failed` : "all passed");
process.exit(failed ? 1 : 0);

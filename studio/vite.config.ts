import react from "@vitejs/plugin-react";
import { readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { promisify } from "node:util";
import { brotliCompress, constants } from "node:zlib";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

const compress = promisify(brotliCompress);
const OUT = "../build/studio";

/** Beside each file of the built studio the same compressed, `.br`: what servers send to a browser that accepts it. */
function compressed(): Plugin {
  return {
    name: "compressed",
    apply: "build",
    async closeBundle() {
      const folder = join(import.meta.dirname, OUT);
      const files = readdirSync(folder, { recursive: true, encoding: "utf8" }).map((name) => join(folder, name));
      const packed = files.filter((file) => !/\.(map|br)$/.test(file) && statSync(file).isFile());
      await Promise.all(
        packed.map(async (file) => {
          const plain = readFileSync(file);
          const params = { [constants.BROTLI_PARAM_LGWIN]: constants.BROTLI_MAX_WINDOW_BITS, [constants.BROTLI_PARAM_SIZE_HINT]: plain.length };
          writeFileSync(`${file}.br`, await compress(plain, { params }));
        }),
      );
    },
  };
}

export default defineConfig({
  base: "./", // a static folder that works at any address
  plugins: [react(), compressed()],
  worker: { format: "es" },
  build: {
    target: "es2022",
    outDir: OUT,
    emptyOutDir: true,
  },
  test: {
    include: ["src/**/*.test.{ts,tsx}", "tests/**/*.test.{ts,tsx}"],
  },
});

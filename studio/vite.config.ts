import react from "@vitejs/plugin-react";
import { readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { promisify } from "node:util";
import { brotliCompress, constants } from "node:zlib";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

const compress = promisify(brotliCompress);

/** Beside each file of the built studio the same compressed, `.br`: what servers send to a browser that accepts it. */
function compressed(): Plugin {
  let folder = "";
  return {
    name: "compressed",
    apply: "build",
    configResolved(config) {
      folder = resolve(config.root, config.build.outDir);
    },
    async closeBundle() {
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
  server: { fs: { allow: [".", "../mechanisms"] } },
  build: {
    target: "es2022",
    outDir: "../build/studio",
    emptyOutDir: true,
  },
  test: {
    include: ["src/**/*.test.{ts,tsx}", "tests/**/*.test.{ts,tsx}"],
  },
});

import react from "@vitejs/plugin-react";
import { defineConfig } from "vitest/config";

export default defineConfig({
  base: "./", // a static folder that works at any address
  plugins: [react()],
  worker: { format: "es" },
  build: {
    target: "es2022",
    outDir: "../build/studio",
    emptyOutDir: true,
  },
  test: {
    include: ["src/**/*.test.{ts,tsx}", "tests/**/*.test.{ts,tsx}"],
  },
});

import "../../tests/page";
import { expect, it } from "vitest";
import { openText } from "../actions";
import { studio } from "../state";

it("brings each template's tables with it, and leaves those of the open model alone", async () => {
  openText('[table.p]\nfile = "gas_pressure.csv"\n', "mine.toml", { files: { "gas_pressure.csv": "mine" } });
  const { TEMPLATES } = await import("./templates");
  expect(studio.get().files).toEqual({ "gas_pressure.csv": "mine" });
  const tablesOf = (file: string) => TEMPLATES.find((one) => one.file === file)?.files;
  expect(Object.keys(tablesOf("engine.toml")!)).toEqual(["gas_pressure.csv"]);
  expect(tablesOf("four_bar.toml")).toEqual({});
});

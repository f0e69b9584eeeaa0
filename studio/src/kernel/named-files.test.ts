import { expect, it } from "vitest";
import { filesNamedIn, keepNamedFile, withNamedFiles } from "./named-files";

keepNamedFile("gas.csv", "0,1\n");
keepNamedFile("data/f.csv", "2,3\n");

it("gives the files that a text names and the page has", () => {
  expect(filesNamedIn('[table.p]\nfile = "gas.csv"\n[table.q]\nfile = \'data/f.csv\'\n[table.r]\nfile="none.csv"\n')).toEqual({ "gas.csv": "0,1\n", "data/f.csv": "2,3\n" });
  expect(filesNamedIn('{"table": {"p": {"file": "gas.csv"}}}')).toEqual({ "gas.csv": "0,1\n" });
  expect(filesNamedIn('profile = "gas.csv"\n')).toEqual({});
});

it("adds them to calls with a model's text", () => {
  expect(withNamedFiles({ text: 'file = "gas.csv"', set: {} })).toEqual({ text: 'file = "gas.csv"', set: {}, files: { "gas.csv": "0,1\n" } });
  expect(withNamedFiles({ id: 3 })).toEqual({ id: 3 });
  expect(withNamedFiles(null)).toBeNull();
});

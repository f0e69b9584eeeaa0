import { expect, it } from "vitest";
import { filesNamedIn, withNamedFiles } from "./named-files";

const known = { "gas.csv": "0,1\n", "data/f.csv": "2,3\n" };

it("gives the files that a text names and the page has", () => {
  expect(filesNamedIn('[table.p]\nfile = "gas.csv"\n[table.q]\nfile = \'data/f.csv\'\n[table.r]\nfile="none.csv"\n', known)).toEqual(known);
  expect(filesNamedIn('{"table": {"p": {"file": "gas.csv"}}}', known)).toEqual({ "gas.csv": "0,1\n" });
  expect(filesNamedIn('profile = "gas.csv"\n', known)).toEqual({});
  expect(filesNamedIn('file = "toString"\n', known)).toEqual({});
});

it("adds them to calls with a model's text", () => {
  expect(withNamedFiles({ text: 'file = "gas.csv"', set: {} }, known)).toEqual({ text: 'file = "gas.csv"', set: {}, files: { "gas.csv": "0,1\n" } });
  expect(withNamedFiles({ id: 3 }, known)).toEqual({ id: 3 });
  expect(withNamedFiles(null, known)).toBeNull();
});

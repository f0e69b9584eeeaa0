// The native kernel, asked by pintle-answers (PINTLE_ANSWERS, else build/test/bin/pintle-answers), and the models of the collection.
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { unpacked } from "../src/kernel/packed";

export const root = resolve(__dirname, "../..");
export const answers = process.env.PINTLE_ANSWERS ?? join(root, "build/test/bin/pintle-answers");

const collected = (ending: string) =>
  readdirSync(join(root, "mechanisms"))
    .filter((name) => name.endsWith(ending))
    .map((name) => [name, readFileSync(join(root, "mechanisms", name), "utf8")] as const);

export const texts = new Map(collected(".toml"));
export const files = Object.fromEntries(collected(".csv"));

export interface Call {
  call: string;
  arguments: Record<string, unknown>;
}

/** The answers of one program to all of these, one after the other. */
export function native(calls: Call[]): unknown[] {
  const input = calls.map((call) => JSON.stringify({ ...call, arguments: { ...call.arguments, files } })).join("\n") + "\n";
  const out = execFileSync(answers, { input, maxBuffer: 1 << 30 });
  const values: unknown[] = [];
  for (let at = 0; at < out.length; ) {
    const size = Number(out.readBigUInt64LE(at));
    values.push(unpacked(new Uint8Array(out.subarray(at + 8, at + 8 + size)).buffer).value);
    at += 8 + size;
  }
  return values;
}

import { describe, expect, it } from "vitest";
import { EMPTY_MODEL } from "../model/operations";
import { GifWriter, lzw } from "./gif";
import { decodeModel, encodeModel } from "./share";

describe("share links", () => {
  it("carry any text there and back, in letters an address may have", async () => {
    for (const text of [EMPTY_MODEL, "", "µ°·\n".repeat(5000)]) {
      const code = await encodeModel(text);
      expect(code).toMatch(/^[\w-]*$/);
      expect(await decodeModel(code)).toBe(text);
    }
  });
  it("are refused when cut off or made up", async () => {
    const code = await encodeModel(EMPTY_MODEL.repeat(20));
    for (const wrong of [code.slice(0, code.length / 2), "!!!", "AAAA"]) expect(await decodeModel(wrong)).toBeNull();
  });
});

/** A decoder written from the format's description, to read back the output. */
function unpack(bytes: readonly number[], count: number): number[] {
  let table: number[][] = [];
  let width = 9;
  let at = 0;
  const reset = () => {
    table = Array.from({ length: 258 }, (_, i) => (i < 256 ? [i] : []));
    width = 9;
  };
  reset();
  const out: number[] = [];
  let before: number[] | null = null;
  for (;;) {
    let code = 0;
    for (let bit = 0; bit < width; bit++, at++) code |= ((bytes[at >> 3]! >> (at & 7)) & 1) << bit;
    if (code === 257 || out.length > count) return out;
    if (code === 256) {
      reset();
      before = null;
      continue;
    }
    const entry: number[] = table[code] ?? [...before!, before![0]!];
    out.push(...entry);
    if (before && table.length < 4096) table.push([...before, entry[0]!]);
    if (table.length === 1 << width && width < 12) width++;
    before = entry;
  }
}

describe("GIF", () => {
  it("packs pictures that unpack to the same", () => {
    let seed = 3;
    const indices = Uint8Array.from({ length: 60_000 }, (_, i) => (i % 1000 < 500 ? 7 : (seed = (seed * 48271) % 2147483647) % 200));
    expect(unpack(lzw(indices), indices.length)).toEqual([...indices]);
  });
  it("has a head, a size and an end", () => {
    const writer = new GifWriter(3, 2, 5);
    writer.add(new Uint8ClampedArray(24).fill(200));
    const bytes = writer.finish();
    expect(String.fromCharCode(...bytes.slice(0, 6))).toBe("GIF89a");
    expect([...bytes.slice(6, 10)]).toEqual([3, 0, 2, 0]);
    expect(bytes[bytes.length - 1]).toBe(0x3b);
  });
});

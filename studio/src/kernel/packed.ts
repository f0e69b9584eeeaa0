// Answers packed into one buffer, as the native kernel sends them: lengths, arrays, text. studio/kernel/calls.h
import { valueOf, type KernelAnswer } from "./module";

/** Throws `{fault}`. */
export function unpacked(buffer: ArrayBuffer): KernelAnswer {
  const view = new DataView(buffer);
  const textSize = view.getUint32(0, true), count = view.getUint32(4, true);
  let at = Math.ceil((8 + 4 * count) / 8) * 8;
  const arrays: Float64Array[] = [];
  for (let i = 0; i < count; ++i) {
    const size = view.getUint32(8 + 4 * i, true);
    arrays.push(new Float64Array(buffer.slice(at, at + 8 * size)));
    at += 8 * size;
  }
  return valueOf(new TextDecoder().decode(new Uint8Array(buffer, at, textSize)), arrays);
}

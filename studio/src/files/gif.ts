// A GIF with few colours: drawings have a background, some lines and some fills. The colours are those of the first picture; LZW.

/** Two colours closer than this (squared distance) count as equal. */
const SAME = 48;
/** Colours that the film needs later but the first picture may lack: the reds of force arrows. */
const ALWAYS = [0xcf2e2e, 0xe68080, 0xff6b63, 0x7f3531];

export class GifWriter {
  private readonly bytes: number[] = [];
  private before: Uint8Array | null = null;
  private colours: number[] = [];
  private readonly nearest = new Map<number, number>();

  constructor(
    private readonly width: number,
    private readonly height: number,
    /** Hundredths of a second between frames. */
    private readonly delay: number,
  ) {
    this.text("GIF89a");
    this.short(width);
    this.short(height);
    this.bytes.push(0xf7, 0, 0);
  }

  private begin(rgba: Uint8ClampedArray): void {
    this.colours = commonColours(rgba);
    for (let i = 0; i < 256; i++) {
      const colour = this.colours[i] ?? 0;
      this.bytes.push(colour >> 16, (colour >> 8) & 255, colour & 255);
    }
    this.bytes.push(0x21, 0xff, 11);
    this.text("NETSCAPE2.0");
    this.bytes.push(3, 1, 0, 0, 0); // loop forever
  }

  private indexOf(colour: number): number {
    const known = this.nearest.get(colour);
    if (known !== undefined) return known;
    let best = 0;
    this.colours.forEach((one, i) => {
      if (difference(one, colour) < difference(this.colours[best]!, colour)) best = i;
    });
    this.nearest.set(colour, best);
    return best;
  }

  private text(text: string): void {
    for (const char of text) this.bytes.push(char.charCodeAt(0));
  }

  private short(value: number): void {
    this.bytes.push(value & 255, value >> 8);
  }

  /** Adds a picture: RGBA, row by row. Unchanged pixels are left out. */
  add(rgba: Uint8ClampedArray): void {
    if (this.colours.length === 0) this.begin(rgba);
    const indices = new Uint8Array(this.width * this.height);
    for (let i = 0; i < indices.length; i++) indices[i] = this.indexOf((rgba[4 * i]! << 16) | (rgba[4 * i + 1]! << 8) | rgba[4 * i + 2]!);
    const shown = indices.slice();
    const { before } = this;
    if (before) for (let i = 0; i < shown.length; i++) if (shown[i] === before[i]) shown[i] = 255;
    this.before = indices;
    this.bytes.push(0x21, 0xf9, 4, before ? 0x05 : 0x04);
    this.short(this.delay);
    this.bytes.push(255, 0, 0x2c, 0, 0, 0, 0);
    this.short(this.width);
    this.short(this.height);
    this.bytes.push(0, 8);
    const packed = lzw(shown);
    for (let i = 0; i < packed.length; i += 255) {
      const block = packed.slice(i, i + 255);
      this.bytes.push(block.length);
      for (const byte of block) this.bytes.push(byte);
    }
    this.bytes.push(0);
  }

  finish(): Uint8Array {
    return Uint8Array.from([...this.bytes, 0x3b]);
  }
}

function difference(a: number, b: number): number {
  return ((a >> 16) - (b >> 16)) ** 2 + (((a >> 8) & 255) - ((b >> 8) & 255)) ** 2 + ((a & 255) - (b & 255)) ** 2;
}

// At most 255, most frequent first: index 255 means "unchanged".
function commonColours(rgba: Uint8ClampedArray): number[] {
  const counts = new Map<number, number>();
  for (let i = 0; i + 3 < rgba.length; i += 4) {
    const colour = (rgba[i]! << 16) | (rgba[i + 1]! << 8) | rgba[i + 2]!;
    counts.set(colour, (counts.get(colour) ?? 0) + 1);
  }
  const colours = [...ALWAYS];
  for (const [colour] of [...counts].sort((a, b) => b[1] - a[1])) {
    if (colours.length === 255) break;
    if (colours.every((one) => difference(one, colour) >= SAME)) colours.push(colour);
  }
  return colours;
}

/** Codes of variable width from 9 bits up, packed from the lowest bit. */
export function lzw(indices: Uint8Array): number[] {
  const CLEAR = 256;
  const END = 257;
  const out: number[] = [];
  let bits = 0;
  let held = 0;
  let width = 9;
  let next = 258;
  let table = new Map<number, number>();
  const emit = (code: number) => {
    held |= code << bits;
    bits += width;
    while (bits >= 8) {
      out.push(held & 255);
      held >>>= 8;
      bits -= 8;
    }
  };
  emit(CLEAR);
  let prefix = indices[0] ?? 0;
  for (let i = 1; i < indices.length; i++) {
    const key = (prefix << 8) | indices[i]!;
    const known = table.get(key);
    if (known !== undefined) {
      prefix = known;
      continue;
    }
    emit(prefix);
    if (next === 4096) {
      emit(CLEAR);
      table = new Map();
      next = 258;
      width = 9;
    } else {
      table.set(key, next);
      if (next === 1 << width) width++;
      next++;
    }
    prefix = indices[i]!;
  }
  emit(prefix);
  emit(END);
  if (bits > 0) out.push(held & 255);
  return out;
}

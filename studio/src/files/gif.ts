// A GIF of few colours: drawings have a paper, some lines and some fills. 216 colours of a cube and 39 greys; LZW.

const LEVELS = [0, 51, 102, 153, 204, 255];

export class GifWriter {
  private readonly bytes: number[] = [];
  private before: Uint8Array | null = null;

  constructor(
    private readonly width: number,
    private readonly height: number,
    /** Hundredths of a second between frames. */
    private readonly delay: number,
  ) {
    this.text("GIF89a");
    this.short(width);
    this.short(height);
    this.bytes.push(0xf7, 0, 0, ...palette());
    this.bytes.push(0x21, 0xff, 11);
    this.text("NETSCAPE2.0");
    this.bytes.push(3, 1, 0, 0, 0); // for ever
  }

  private text(text: string): void {
    for (const char of text) this.bytes.push(char.charCodeAt(0));
  }

  private short(value: number): void {
    this.bytes.push(value & 255, value >> 8);
  }

  /** Adds a picture: RGBA, row by row. Pixels that did not change are left out. */
  add(rgba: Uint8ClampedArray): void {
    const indices = new Uint8Array(this.width * this.height);
    for (let i = 0; i < indices.length; i++) indices[i] = nearestColour(rgba[4 * i]!, rgba[4 * i + 1]!, rgba[4 * i + 2]!);
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

function palette(): number[] {
  const colours: number[] = [];
  for (const r of LEVELS) for (const g of LEVELS) for (const b of LEVELS) colours.push(r, g, b);
  for (let i = 0; i < 40; i++) {
    const grey = Math.round((i * 255) / 39);
    colours.push(grey, grey, grey);
  }
  return colours;
}

// Index 255 stands for "as before", so greys end at 254.
function nearestColour(r: number, g: number, b: number): number {
  const spread = Math.max(r, g, b) - Math.min(r, g, b);
  if (spread < 14) return 216 + Math.min(Math.round((((r + g + b) / 3) * 39) / 255), 38);
  return 36 * Math.round(r / 51) + 6 * Math.round(g / 51) + Math.round(b / 51);
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

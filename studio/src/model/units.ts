// Units as people write them, and numbers as people read them. Internally everything is in SI and radians.

/** Exponents of m, kg, s, rad. */
export type Dimension = readonly [number, number, number, number];

export interface Unit {
  factor: number;
  dimension: Dimension;
}

const L: Dimension = [1, 0, 0, 0];
const M: Dimension = [0, 1, 0, 0];
const T: Dimension = [0, 0, 1, 0];
const ANGLE: Dimension = [0, 0, 0, 1];
const FORCE: Dimension = [1, 1, -2, 0];
const ENERGY: Dimension = [2, 1, -2, 0];
const POWER: Dimension = [2, 1, -3, 0];
const PRESSURE: Dimension = [-1, 1, -2, 0];
const INCH = 0.0254;
const FOOT = 12 * INCH;
const POUND = 0.45359237;
const POUND_FORCE = 9.80665 * POUND;
const TURN = 2 * Math.PI;

export const UNITS: Readonly<Record<string, Unit>> = {
  m: { factor: 1, dimension: L },
  mm: { factor: 1e-3, dimension: L },
  cm: { factor: 1e-2, dimension: L },
  dm: { factor: 1e-1, dimension: L },
  km: { factor: 1e3, dimension: L },
  um: { factor: 1e-6, dimension: L },
  µm: { factor: 1e-6, dimension: L },
  nm: { factor: 1e-9, dimension: L },
  in: { factor: INCH, dimension: L },
  ft: { factor: FOOT, dimension: L },
  kg: { factor: 1, dimension: M },
  g: { factor: 1e-3, dimension: M },
  mg: { factor: 1e-6, dimension: M },
  ug: { factor: 1e-9, dimension: M },
  µg: { factor: 1e-9, dimension: M },
  t: { factor: 1e3, dimension: M },
  lb: { factor: POUND, dimension: M },
  oz: { factor: POUND / 16, dimension: M },
  slug: { factor: POUND_FORCE / FOOT, dimension: M },
  s: { factor: 1, dimension: T },
  ms: { factor: 1e-3, dimension: T },
  us: { factor: 1e-6, dimension: T },
  µs: { factor: 1e-6, dimension: T },
  ns: { factor: 1e-9, dimension: T },
  min: { factor: 60, dimension: T },
  h: { factor: 3600, dimension: T },
  N: { factor: 1, dimension: FORCE },
  kN: { factor: 1e3, dimension: FORCE },
  MN: { factor: 1e6, dimension: FORCE },
  lbf: { factor: POUND_FORCE, dimension: FORCE },
  ozf: { factor: POUND_FORCE / 16, dimension: FORCE },
  kip: { factor: 1e3 * POUND_FORCE, dimension: FORCE },
  mN: { factor: 1e-3, dimension: FORCE },
  uN: { factor: 1e-6, dimension: FORCE },
  µN: { factor: 1e-6, dimension: FORCE },
  nN: { factor: 1e-9, dimension: FORCE },
  J: { factor: 1, dimension: ENERGY },
  kJ: { factor: 1e3, dimension: ENERGY },
  mJ: { factor: 1e-3, dimension: ENERGY },
  W: { factor: 1, dimension: POWER },
  kW: { factor: 1e3, dimension: POWER },
  mW: { factor: 1e-3, dimension: POWER },
  hp: { factor: 550 * FOOT * POUND_FORCE, dimension: POWER },
  Pa: { factor: 1, dimension: PRESSURE },
  kPa: { factor: 1e3, dimension: PRESSURE },
  MPa: { factor: 1e6, dimension: PRESSURE },
  GPa: { factor: 1e9, dimension: PRESSURE },
  bar: { factor: 1e5, dimension: PRESSURE },
  psi: { factor: POUND_FORCE / INCH ** 2, dimension: PRESSURE },
  ksi: { factor: (1e3 * POUND_FORCE) / INCH ** 2, dimension: PRESSURE },
  Hz: { factor: 1, dimension: [0, 0, -1, 0] },
  kHz: { factor: 1e3, dimension: [0, 0, -1, 0] },
  rad: { factor: 1, dimension: ANGLE },
  mrad: { factor: 1e-3, dimension: ANGLE },
  deg: { factor: TURN / 360, dimension: ANGLE },
  "°": { factor: TURN / 360, dimension: ANGLE },
  rev: { factor: TURN, dimension: ANGLE },
  rpm: { factor: TURN / 60, dimension: [0, 0, -1, 1] },
  mph: { factor: (5280 * FOOT) / 3600, dimension: [1, 0, -1, 0] },
};

/** Units to choose from in a field with this SI unit; the studio writes values in the first one. */
export const CHOICES: Readonly<Record<string, readonly string[]>> = {
  m: ["mm", "m", "cm", "in"],
  rad: ["deg", "rad"],
  kg: ["kg", "g", "lb"],
  "kg*m^2": ["kg*m^2", "kg*mm^2"],
  "N/m": ["N/m", "N/mm", "kN/mm"],
  "N*s/m": ["N*s/m", "N*s/mm"],
  "N*m/rad": ["N*m/rad", "N*m/deg"],
  "N*m*s/rad": ["N*m*s/rad"],
  "rad/s": ["rpm", "rad/s", "deg/s"],
  "m/s": ["m/s", "mm/s"],
  N: ["N", "kN", "mN", "lbf"],
  "N*m": ["N*m", "kN*m"],
  s: ["s", "ms", "min"],
  "m/s^2": ["m/s^2"],
};

/** The factor of "N*m/rad" and the like; null if a word in it is not a unit. */
export function unitFactor(text: string): number | null {
  let factor = 1;
  for (const part of text.split(/(?=[*/])/)) {
    const divides = part.startsWith("/");
    const [word, exponent] = part.replace(/^[*/]/, "").trim().split("^");
    const unit = UNITS[word ?? ""];
    if (!unit) return null;
    factor *= unit.factor ** ((divides ? -1 : 1) * Number(exponent ?? 1));
  }
  return factor;
}

/** Few digits, no trailing zeros, no scaling of thousands: what a person would write. */
export function shortNumber(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return value > 0 ? "∞" : value < 0 ? "−∞" : "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${Number(mantissa)}e${Number(exponent)}`;
  }
  return String(Number(value.toPrecision(digits)));
}

const PREFIXED: Readonly<Record<string, readonly [number, string][]>> = {
  N: [[1e6, "MN"], [1e3, "kN"], [1, "N"], [1e-3, "mN"]],
  m: [[1, "m"], [1e-3, "mm"], [1e-6, "µm"]],
  "N*m": [[1e3, "kN·m"], [1, "N·m"], [1e-3, "mN·m"]],
  J: [[1e6, "MJ"], [1e3, "kJ"], [1, "J"], [1e-3, "mJ"]],
  W: [[1e3, "kW"], [1, "W"], [1e-3, "mW"]],
  s: [[1, "s"], [1e-3, "ms"], [1e-6, "µs"]],
  kg: [[1, "kg"], [1e-3, "g"]],
};

/** "1.234 kN": a quantity with a suitable prefix. */
export function quantity(value: number, unit: string, digits = 4): string {
  if (!Number.isFinite(value)) return shortNumber(value);
  const steps = PREFIXED[unit];
  if (!steps || value === 0) return `${shortNumber(value, digits)} ${prettyUnit(unit)}`.trim();
  const size = Math.abs(value);
  const [factor, name] = steps.find(([least]) => size >= least * 0.9999) ?? steps[steps.length - 1]!;
  return `${shortNumber(value / factor, digits)} ${name}`;
}

/** "N*m*s/rad" in print: "N·m·s/rad". */
export function prettyUnit(unit: string): string {
  return unit.replace(/\*/g, "·").replace("^2", "²").replace(/^-$/, "");
}

/** Lengths that belong together, as the studio writes them into a model: to a billionth of the largest, in mm below ten metres. */
export function writeLengths(metres: readonly number[], digits = 9): (string | number)[] {
  const size = Math.max(...metres.map(Math.abs));
  const grain = Math.max(10 ** (Math.floor(Math.log10(size)) + 1 - digits), 1e-14);
  return metres.map((one) => {
    const mm = Number((Math.round(one / grain) * grain * 1e3).toPrecision(12));
    if (mm === 0) return 0;
    return Math.abs(mm) < 1e4 ? `${mm} mm` : `${Number((mm / 1e3).toPrecision(12))} m`;
  });
}

export function writeLength(metres: number, digits = 9): string | number {
  return writeLengths([metres], digits)[0]!;
}

export function writeAngle(radians: number, decimals = 7): string | number {
  const degrees = Number(((radians * 180) / Math.PI).toFixed(decimals));
  return degrees === 0 ? 0 : `${degrees} deg`;
}

// The numbers of the run, and how they are formatted.

const run = JSON.parse(document.getElementById("run").textContent);
const decoded = (text) => new Float64Array(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
for (const column of run.columns) {
  column.values = decoded(column.data);
  column.data = null;
}
const times = run.columns[0].values;

/** The value between two rows; `place` is the clock's. */
function valueAt(values, place) {
  const a = values[place.row];
  return place.share > 0 ? a + place.share * (values[place.row + 1] - a) : a;
}

/** The values of a curve: one column, or the length of two. */
function curveValues(curve) {
  const [a, b] = curve.of.map((i) => run.columns[i].values);
  return b ? a.map((x, i) => Math.hypot(x, b[i])) : a;
}

const raised = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
const superscript = (n) => String(n).replace(/./g, (c) => raised[c]);

function printedUnit(unit) {
  return unit.replace(/\^(-?\d+)/g, (_, n) => superscript(n)).replaceAll("*", "·");
}

const prefixes = { "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G" };
const prefixed = ["N", "N*m", "W", "J", "m", "m/s"];

/** Divisor that keeps numbers of a unit short, and the unit's name after the division. */
function scaleFor(largest, unit) {
  if (!(largest > 0) || !isFinite(largest) || (largest < 1e4 && largest >= 0.1)) return { factor: 1, unit: printedUnit(unit) };
  const exponent = 3 * Math.floor(Math.log10(largest) / 3);
  const shown = Math.min(9, Math.max(-9, exponent));
  if (prefixed.includes(unit) || (unit === "s" && exponent < 0)) return { factor: 10 ** shown, unit: prefixes[shown] + printedUnit(unit) };
  if (exponent === 0) return { factor: 1, unit: printedUnit(unit) };
  return { factor: 10 ** exponent, unit: `10${superscript(exponent)} ${printedUnit(unit)}` };
}

/** Ticks at multiples of 1, 2 or 5 times a power of ten. */
function ticksIn(low, high, wanted) {
  const rough = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(rough)), digit = rough / power;
  const step = power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
  const list = [], slack = 1e-9 * (high - low);
  for (let i = Math.ceil((low - slack) / step); i * step <= high + slack; ++i) list.push(i * step + 0);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return { list, text: (x) => fixed(x, decimals) };
}

function fixed(x, decimals) {
  const text = Math.abs(x).toFixed(Math.min(decimals, 12));
  return x < 0 && Number(text) !== 0 ? "−" + text : text;
}

/** Five significant digits. */
function digits(x) {
  if (!isFinite(x)) return String(x);
  const size = Math.abs(x);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) {
    const [mantissa, exponent] = x.toExponential(3).split("e");
    return `${mantissa.replace("-", "−")}·10${superscript(Number(exponent))}`;
  }
  return fixed(x, size === 0 ? 1 : Math.max(0, 4 - Math.floor(Math.log10(size))));
}

/** A time as the clock shows it: with enough decimals to distinguish consecutive rows. */
const timeText = (t) => `${fixed(t, run.scene.time_decimals)} s`;

const dark = matchMedia("(prefers-color-scheme: dark)");

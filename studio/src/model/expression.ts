// Values of expressions, for drawing before the kernel has answered. A unit binds to the number before it, and names of parameters take precedence over units.
import { type Dimension, UNITS } from "./units";

export type Scope = (name: string) => number | undefined;

const CONSTANTS: Readonly<Record<string, number>> = { pi: Math.PI, e: Math.E };
const NO_NAMES: Scope = () => undefined;
/** The sizes of m, kg, s and rad: in other sizes, a value changes as its dimension says. */
const SI: Dimension = [1, 1, 1, 1];

const FUNCTIONS: Readonly<Record<string, (...values: number[]) => number>> = {
  sin: Math.sin,
  cos: Math.cos,
  tan: Math.tan,
  asin: Math.asin,
  acos: Math.acos,
  atan: Math.atan,
  atan2: Math.atan2,
  sinh: Math.sinh,
  cosh: Math.cosh,
  tanh: Math.tanh,
  exp: Math.exp,
  log: Math.log,
  sqrt: Math.sqrt,
  abs: Math.abs,
  sign: Math.sign,
  min: Math.min,
  max: Math.max,
  pow: Math.pow,
  step: (x = 0) => (x > 0 ? 1 : 0),
  smoothstep: (a = 0, b = 1, x = 0) => {
    const s = Math.min(Math.max((x - a) / (b - a), 0), 1);
    return s * s * (3 - 2 * s);
  },
  if: (condition = 0, then = 0, otherwise = 0) => (condition !== 0 ? then : otherwise),
};

/** The value in SI units; null if the text is not an expression, contains an unknown name or has no finite value. */
export function evaluate(text: string, scope: Scope = NO_NAMES, sizes = SI): number | null {
  const value = new Evaluator(text, scope, sizes).all();
  return value !== null && Number.isFinite(value) ? value : null;
}

/** Which of the known names an expression uses. */
export function namesIn(text: string, known: ReadonlySet<string>): string[] {
  const names = new Set<string>();
  new Evaluator(text, (name) => {
    if (!known.has(name)) return undefined;
    names.add(name);
    return 1;
  }, SI).all();
  return [...names];
}

class Evaluator {
  private readonly tokens: string[];
  private at = 0;

  constructor(
    text: string,
    private readonly scope: Scope,
    private readonly sizes: Dimension,
  ) {
    this.tokens = text.match(/\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|[A-Za-z_µ°][\w.]*|<=|>=|[-+*/^()<>,·−×]|\S/g) ?? [];
  }

  all(): number | null {
    try {
      const value = this.comparison();
      return this.at === this.tokens.length ? value : null;
    } catch {
      return null;
    }
  }

  private peek(): string {
    return this.tokens[this.at] ?? "";
  }

  private take(token: string): boolean {
    if (this.peek() !== token) return false;
    this.at++;
    return true;
  }

  private comparison(): number {
    let value = this.sum();
    for (;;) {
      if (this.take("<")) value = value < this.sum() ? 1 : 0;
      else if (this.take(">")) value = value > this.sum() ? 1 : 0;
      else if (this.take("<=")) value = value <= this.sum() ? 1 : 0;
      else if (this.take(">=")) value = value >= this.sum() ? 1 : 0;
      else return value;
    }
  }

  private sum(): number {
    let value = this.product();
    for (;;) {
      if (this.take("+")) value += this.product();
      else if (this.take("-") || this.take("−")) value -= this.product();
      else return value;
    }
  }

  private product(): number {
    let value = this.unary();
    for (;;) {
      if (this.take("*") || this.take("·") || this.take("×")) value *= this.unary();
      else if (this.take("/")) value /= this.unary();
      else return value;
    }
  }

  private unary(): number {
    if (this.take("-") || this.take("−")) return -this.unary();
    if (this.take("+")) return this.unary();
    const base = this.primary();
    return this.take("^") ? base ** this.unary() : base;
  }

  private primary(): number {
    if (this.take("(")) {
      const value = this.comparison();
      if (!this.take(")")) throw new Error("unclosed");
      return value * this.unit();
    }
    const token = this.peek();
    if (/^[\d.]/.test(token)) {
      this.at++;
      return Number(token) * this.unit();
    }
    if (!/^[A-Za-z_]/.test(token)) throw new Error("unexpected");
    this.at++;
    if (this.peek() === "(") return this.call(token);
    const value = CONSTANTS[token] ?? this.scope(token);
    if (value === undefined) throw new Error("unknown");
    return value;
  }

  private call(name: string): number {
    const body = FUNCTIONS[name];
    if (!body) throw new Error("unknown");
    this.take("(");
    const values: number[] = [];
    do values.push(this.comparison());
    while (this.take(","));
    if (!this.take(")")) throw new Error("unclosed");
    return body(...values);
  }

  private unitHere(at: number): number | null {
    const word = this.tokens[at] ?? "";
    const unit = UNITS[word];
    return unit && this.tokens[at + 1] !== "(" ? unit.dimension.reduce((factor, power, i) => factor * this.sizes[i]! ** power, unit.factor) : null;
  }

  // symbol (('*' | '/') symbol)* with integer exponents, as far as the symbols are units.
  private unit(): number {
    const first = this.unitHere(this.at);
    if (first === null) return 1;
    this.at++;
    let factor = first ** this.exponent();
    for (;;) {
      const operator = this.peek();
      if (operator !== "*" && operator !== "/" && operator !== "·") return factor;
      const next = this.unitHere(this.at + 1);
      if (next === null || this.scope(this.tokens[this.at + 1] ?? "") !== undefined) return factor;
      this.at += 2;
      const power = this.exponent();
      factor *= next ** (operator === "/" ? -power : power);
    }
  }

  private exponent(): number {
    if (!this.take("^")) return 1;
    const sign = this.take("-") ? -1 : 1;
    const digits = this.peek();
    if (!/^\d+$/.test(digits)) throw new Error("exponent");
    this.at++;
    return sign * Number(digits);
  }
}

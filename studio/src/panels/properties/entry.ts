// What is typed into a field for a quantity, and what it means.
import type { Literal } from "../../model/edit";
import { evaluate } from "../../model/expression";
import type { Plain } from "../../model/toml";
import { CHOICES, unitFactor } from "../../model/units";
import { studio } from "../../state";

export const SIMPLE = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-zµ°][\w*/^°·-]*)?\s*$/;

export interface Parts {
  number: string;
  unit: string;
  /** More than a number with a unit. */
  expression: boolean;
}

export function partsOf(literal: Plain | undefined, si: string): Parts {
  if (literal === undefined) return { number: "", unit: "", expression: false };
  const text = String(literal);
  const simple = SIMPLE.exec(text);
  if (!simple) return { number: text, unit: "", expression: true };
  return { number: simple[1]!, unit: simple[2] ?? si, expression: false };
}

export function numberIn(text: string): number | null {
  return evaluate(text, (name) => studio.get().model.parameters.get(name));
}

/** A number in another unit; null if the units are not known. */
export function converted(number: string, from: string, to: string): string | null {
  const [before, after] = [unitFactor(from), unitFactor(to)];
  return before === null || after === null ? null : String(Number(((Number(number) * before) / after).toPrecision(10)));
}

interface Units {
  /** Of the field's number, or of the next one typed. */
  now: string;
  choices: string[];
  /** The number shown while there is none; empty if that is an expression. */
  usual: string;
}

/** `chosen` is the unit that was chosen while the field was empty. */
export function unitsOf(literal: Plain | undefined, si: string, fallback: string | undefined, chosen: string): Units {
  const usual = partsOf(fallback, si);
  const own = literal === undefined ? usual.unit : partsOf(literal, si).unit;
  const family = CHOICES[si] ?? Object.values(CHOICES).find((list) => own !== "" && list.includes(own)) ?? (si ? [si] : []);
  const choices = [...new Set([...(own ? [own] : []), ...family])];
  const first = own || (si ? (choices[0] ?? "") : "");
  const now = literal === undefined && choices.includes(chosen) ? chosen : first;
  const number = usual.expression ? "" : usual.number;
  return { now, choices, usual: number && now !== first ? (converted(number, first, now) ?? number) : number };
}

export interface Rules {
  /** Unit of a number without one. */
  unit: string;
  /** Names other than parameters may be used. */
  variables?: boolean;
  /** Why a value is refused; empty if it is not. */
  refuse?: (text: string) => string;
}

/** The literal to write, or what is wrong with the text. */
export function entered(text: string, { unit, variables, refuse }: Rules): { literal: Literal } | { wrong: string } {
  const simple = SIMPLE.exec(text);
  const plain = simple !== null && !simple[2];
  if (!plain && !variables && numberIn(text) === null) return { wrong: `"${text}" is neither a number nor an expression of the model's parameters.` };
  const literal = plain ? (unit ? `${simple[1]} ${unit}` : Number(simple[1])) : text;
  const wrong = refuse?.(String(literal));
  return wrong ? { wrong } : { literal };
}

// Fields with units. A number keeps its author's unit; an expression remains an expression and shows its value.
import { useEffect, useId, useState } from "react";
import { edit } from "../../actions";
import { valueProblem } from "../../model/dimensions";
import { Draft, type Literal } from "../../model/edit";
import { type Plain, nodeAt, plain } from "../../model/toml";
import { prettyUnit, shortNumber } from "../../model/units";
import { studio, useStudio } from "../../state";
import { SIMPLE, converted, entered, numberIn, partsOf, unitsOf } from "./entry";

/** The literal at a path as written in the text, or undefined. Compared by a key, so that React sees when it changes. */
export function useLiteral(path: readonly string[]): Plain | undefined {
  const key = useStudio((now) => {
    const node = nodeAt(now.model.document.root, path);
    return node ? JSON.stringify(plain(node)) : undefined;
  });
  return key === undefined ? undefined : (JSON.parse(key) as Plain);
}

export function setLiteral(path: readonly string[], value: Literal | null, label: string): void {
  const { model } = studio.get();
  const draft = new Draft(model.document);
  if (value === null) draft.remove(path);
  else draft.set(path, value);
  // A typed value is no longer derived from a shape.
  if (value !== null && path[0] === "body" && (path[2] === "mass" || path[2] === "inertia")) draft.remark(path, "");
  edit(draft.apply(), label);
}

interface QuantityProps {
  label: string;
  unit: string;
  literal: Plain | undefined;
  fallback?: string;
  meaning?: string;
  /** Names other than parameters that may be used: t, angle, rate. */
  variables?: boolean;
  required?: boolean;
  note?: React.ReactNode;
  /** Why a value is refused; empty if it is not. */
  refuse?: (text: string) => string;
  onChange: (literal: Literal | null) => void;
}

export function Quantity({ label, unit, literal, fallback, meaning, variables, required, note, refuse, onChange }: QuantityProps) {
  const id = useId();
  const parts = partsOf(literal, unit);
  const [typed, setTyped] = useState(parts.number);
  const [wrong, setWrong] = useState("");
  const [chosen, setChosen] = useState("");
  const shown = parts.number;
  useEffect(() => {
    setTyped(shown);
    setWrong("");
  }, [shown, parts.unit]);
  const { now, choices, usual } = unitsOf(literal, unit, fallback, chosen);

  const commit = (text: string) => {
    const value = text.trim();
    setWrong("");
    if (value === shown.trim()) return;
    if (value === "") return required ? setTyped(shown) : onChange(null);
    const found = entered(value, { unit: now, variables, refuse });
    if ("wrong" in found) setWrong(found.wrong);
    else onChange(found.literal);
  };
  const convert = (to: string) => {
    if (literal === undefined) return setChosen(to);
    const number = parts.expression ? null : converted(parts.number, now, to);
    if (number !== null) onChange(`${number} ${to}`);
  };
  const value = parts.expression && !variables ? numberIn(shown) : null;
  return (
    <div className="field">
      <label htmlFor={id} data-tip={meaning}>
        {label}
        {note}
      </label>
      <span className={wrong ? "quantity wrong" : "quantity"}>
        <input
          id={id}
          value={typed}
          placeholder={fallback !== undefined ? usual || fallback : required ? "required" : "–"}
          spellCheck={false}
          aria-invalid={wrong !== ""}
          aria-describedby={wrong ? `${id}-wrong` : undefined}
          onChange={(event) => setTyped(event.target.value)}
          onBlur={(event) => commit(event.target.value)}
          onKeyDown={(event) => {
            if (event.key === "Enter") commit(event.currentTarget.value);
            else if (event.key === "Escape") {
              setTyped(shown);
              setWrong("");
            }
            else if ((event.key === "ArrowUp" || event.key === "ArrowDown") && SIMPLE.test(typed)) {
              event.preventDefault();
              const next = stepped(Number(SIMPLE.exec(typed)![1]), event.key === "ArrowUp" ? 1 : -1);
              setTyped(next);
              commit(next);
            }
          }}
        />
        {now && !parts.expression && (
          <select aria-label={`Unit of ${label}`} value={now} onChange={(event) => convert(event.target.value)}>
            {choices.map((one) => (
              <option key={one} value={one}>
                {prettyUnit(one)}
              </option>
            ))}
          </select>
        )}
      </span>
      {parts.expression && <span className="worth">{value === null ? `in ${prettyUnit(unit)}` : `= ${shortNumber(value)} ${prettyUnit(unit)}`}</span>}
      {wrong && (
        <p className="field-wrong" id={`${id}-wrong`} role="alert">
          {wrong}
        </p>
      )}
    </div>
  );
}

// Increments or decrements the second digit.
function stepped(value: number, direction: number): string {
  const power = value === 0 ? 1 : 10 ** (Math.floor(Math.log10(Math.abs(value))) - 1);
  return String(Number((value + direction * power).toPrecision(10)));
}

interface ComputedProps extends Pick<QuantityProps, "label" | "literal" | "meaning"> {
  unit: "m" | "rad";
  positive?: boolean;
  onChange: (value: number) => void;
}

/** A quantity that the studio computes with: what it writes is not what was typed, so that the kernel cannot complain about that. */
export function ComputedQuantity({ unit, positive = false, onChange, ...rest }: ComputedProps) {
  const take = (literal: Literal | null) => {
    const value = numberIn(String(literal ?? ""));
    if (value !== null) onChange(value);
  };
  return <Quantity {...rest} unit={unit} required refuse={(text) => valueProblem(text, unit, positive, studio.get().model)} onChange={take} />;
}

/** A quantity of the model's text. */
export function TextQuantity(props: Omit<QuantityProps, "literal" | "onChange"> & { path: readonly string[] }) {
  const { path, ...rest } = props;
  const literal = useLiteral(path);
  return <Quantity {...rest} literal={Array.isArray(literal) ? literal.map(String).join(", ") : literal} onChange={(value) => setLiteral(path, value, `Set ${props.label.toLowerCase()}`)} />;
}

/** Two quantities in a list: gravity, a force, radii, a position. */
export function Pair({ label, unit, path, names, meaning, fallback, variables }: { label: string; unit: string; path: readonly string[]; names: readonly [string, string]; meaning?: string; fallback?: readonly [number, number]; variables?: boolean }) {
  const literal = useLiteral(path);
  const list = Array.isArray(literal) ? literal : [];
  const set = (i: number) => (value: Literal | null) => {
    const next: Literal[] = [0, 1].map((k) => (list[k] as Literal) ?? fallback?.[k] ?? 0);
    next[i] = value ?? 0;
    setLiteral(path, next, `Set ${label.toLowerCase()}`);
  };
  return (
    <fieldset className="pair">
      <legend data-tip={meaning}>{label}</legend>
      {names.map((name, i) => (
        <Quantity key={name} label={name} unit={unit} literal={list[i]} fallback={fallback ? String(fallback[i]) : "0"} variables={variables} onChange={set(i)} />
      ))}
    </fieldset>
  );
}

export function Choice({ label, value, options, meaning, onChange }: { label: string; value: string; options: readonly (string | { value: string; label: string })[]; meaning?: string; onChange: (value: string) => void }) {
  const id = useId();
  return (
    <div className="field">
      <label htmlFor={id} data-tip={meaning}>
        {label}
      </label>
      <select id={id} className="choice" value={value} onChange={(event) => onChange(event.target.value)}>
        {options.map((one) => {
          const option = typeof one === "string" ? { value: one, label: one } : one;
          return (
            <option key={option.value} value={option.value}>
              {option.label}
            </option>
          );
        })}
      </select>
    </div>
  );
}

/** A name that can be changed. */
export function NameField({ value, label, check, onChange }: { value: string; label: string; check: (name: string) => string; onChange: (name: string) => void }) {
  const id = useId();
  const [typed, setTyped] = useState(value);
  useEffect(() => setTyped(value), [value]);
  const wrong = typed === value ? "" : check(typed);
  const commit = () => {
    if (typed === value) return;
    if (wrong) setTyped(value);
    else onChange(typed);
  };
  return (
    <div className="field">
      <label htmlFor={id}>{label}</label>
      <span className={wrong ? "quantity wrong" : "quantity"}>
        <input id={id} value={typed} spellCheck={false} onChange={(event) => setTyped(event.target.value)} onBlur={commit} onKeyDown={(event) => event.key === "Enter" && commit()} />
      </span>
      {wrong && <p className="field-wrong">{wrong}</p>}
    </div>
  );
}

// The fields of a form, from the schema of the model format and the kernel's catalog: names, units, meanings, defaults.
import { useEffect, useState } from "react";
import type { Catalog } from "../../kernel/protocol";
import { catalog, schema } from "../../play/kernel-session";

export interface Field {
  name: string;
  unit: string;
  meaning: string;
  kind: "quantity" | "expression" | "pair" | "word" | "words" | "truth" | "text" | "name";
  words?: string[];
  /** Words also accepted in a file, with the entry of `words` that each stands for. */
  synonyms?: Record<string, string>;
  fallback?: string;
  required: boolean;
}

interface SchemaProperty {
  type?: string | string[];
  description?: string;
  enum?: string[];
  synonyms?: Record<string, string>;
  default?: unknown;
  items?: unknown;
  minItems?: number;
}

interface SchemaTable {
  properties?: Record<string, SchemaProperty & SchemaTable>;
  additionalProperties?: SchemaTable | boolean;
  required?: string[];
}

/** Keys of a table of the schema: ["spring"] for [spring.NAME], ["simulate"]; with `inner`, of a table in it: "bearing" for [joint.NAME.bearing].
 * Tables are not keys. Of two meanings, `slides` picks the one for sliding. */
export function fieldsOf(root: Record<string, unknown> | null, table: string, slides = false, inner = ""): Field[] {
  const at = (root as SchemaTable | null)?.properties?.[table];
  const outer: SchemaTable | undefined = typeof at?.additionalProperties === "object" ? at.additionalProperties : at;
  const home = inner ? outer?.properties?.[inner] : outer;
  const keys = Object.entries(home?.properties ?? {}).filter(([, property]) => property.type !== "object");
  return keys.map(([name, property]) => fieldOf(name, property, (home?.required ?? []).includes(name), slides));
}

function fieldOf(name: string, property: SchemaProperty, required: boolean, slides: boolean): Field {
  const meanings = (property.description ?? "").split(/; or: /);
  const meaning = (slides ? meanings[meanings.length - 1] : meanings[0]) ?? "";
  const unit = /\[([^\]]+)\]/.exec(meaning)?.[1] ?? "";
  const types = Array.isArray(property.type) ? property.type : [property.type ?? ""];
  const otherwise = /when absent: (.*)$/.exec(meaning)?.[1];
  const kind: Field["kind"] = property.enum
    ? "word"
    : types.includes("boolean")
      ? "truth"
      : types[0] === "array"
        ? unit
          ? "pair"
          : "words"
        : types.includes("number")
          ? /expression of/.test(meaning)
            ? "expression"
            : "quantity"
          : "text";
  return {
    name,
    unit,
    meaning: meaning.replace(/\s*\[[^\]]*\]/, "").replace(/; when absent: .*$/, ""),
    kind,
    words: property.enum?.filter((word) => !(word in (property.synonyms ?? {}))),
    synonyms: property.synonyms,
    fallback: property.default !== undefined ? String(property.default) : otherwise,
    required,
  };
}

export function useSchema(): Record<string, unknown> | null {
  const [answer, setAnswer] = useState<Record<string, unknown> | null>(null);
  useEffect(() => {
    void schema().then(setAnswer, () => undefined);
  }, []);
  return answer;
}

export function useCatalog(): Catalog | null {
  const [answer, setAnswer] = useState<Catalog | null>(null);
  useEffect(() => {
    void catalog().then(setAnswer, () => undefined);
  }, []);
  return answer;
}

/** The label for "free_length" and the like. */
export function labelOf(name: string): string {
  const words = name.replace(/_/g, " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

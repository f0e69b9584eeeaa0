// Completion from the schema: tables after "[", keys at the start of a line, words and names of the model in quotes.
import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import { fieldsOf } from "../panels/properties/form";
import { schema } from "../play/kernel-session";
import { studio } from "../state";
import { UNITS } from "../model/units";

const TABLES = ["parameters", "table.", "simulate", "defaults.joint", "ground.markers", "body.", "joint.", "spring.", "torsion_spring.", "force.", "motor.", "variation."];

export async function complete(context: CompletionContext): Promise<CompletionResult | null> {
  const line = context.state.doc.lineAt(context.pos);
  const before = line.text.slice(0, context.pos - line.from);
  const header = /^\s*\[([\w.]*)$/.exec(before);
  if (header) return { from: context.pos - header[1]!.length, options: TABLES.map((label) => ({ label, type: "namespace" })) };
  const table = tableAt(context.state.doc.toString(), line.from);
  const key = /^\s*([\w.]*)$/.exec(before);
  if (key && (key[1] || context.explicit)) return { from: context.pos - key[1]!.length, options: await keys(table) };
  const quoted = /"([^"]*)$/.exec(before);
  if (!quoted) return null;
  const name = /^\s*([\w.]+)\s*=/.exec(before)?.[1] ?? "";
  const unit = /\d\s+([A-Za-z*/^]*)$/.exec(quoted[1]!);
  if (unit) return { from: context.pos - unit[1]!.length, options: Object.keys(UNITS).map((label) => ({ label, type: "unit" })) };
  const options = await values(table, name);
  return options.length > 0 ? { from: context.pos - quoted[1]!.length, options } : null;
}

function tableAt(text: string, offset: number): string {
  const headers = [...text.slice(0, offset).matchAll(/^\s*\[([\w.]+)/gm)];
  return headers[headers.length - 1]?.[1] ?? "";
}

async function keys(table: string): Promise<Completion[]> {
  const root = await schema().catch(() => null);
  const [kind = "", , inner = ""] = table.split(".");
  const fields = table === "" ? [] : fieldsOf(root, kind, false, inner);
  const head: Completion[] = table === "" ? ["format", "name", "description", "space", "gravity"].map((label) => ({ label, type: "property" })) : [];
  const markers: Completion[] = kind === "body" ? [{ label: "markers.", type: "property", detail: "a point of the body" }] : [];
  return [...head, ...markers, ...fields.map((one): Completion => ({ label: one.name, type: "property", detail: one.unit, info: one.meaning, apply: `${one.name} = ` }))];
}

async function values(table: string, name: string): Promise<Completion[]> {
  const { model } = studio.get();
  const [kind = "", , inner = ""] = table.split(".");
  if (name === "between" || name === "on") {
    const ends = [
      ...model.ground.map((marker) => `ground.${marker.name}`),
      ...model.bodies.flatMap((body) => body.markers.map((marker) => `${body.name}.${marker.name}`)),
    ];
    return ends.map((label) => ({ label, type: "variable" }));
  }
  if (name === "joint" && kind === "motor") return model.joints.map((joint) => ({ label: joint.name, type: "variable", detail: joint.type }));
  const field = fieldsOf(await schema().catch(() => null), kind, false, inner).find((one) => one.name === name);
  if (field?.words) return field.words.map((label) => ({ label, type: "enum" }));
  return [...model.parameters.keys()].map((label) => ({ label, type: "variable" }));
}

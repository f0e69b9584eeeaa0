// What a file holds as a model's text, wherever it comes from.
import type { ModelTree } from "../kernel/protocol";
import { kernel } from "../play/kernel-session";

export interface ModelFile {
  text: string;
  fileName: string;
  /** It was JSON: the text is that of a new file. */
  converted: boolean;
}

export async function asModel(fileName: string, text: string): Promise<ModelFile> {
  if (!/\.json$/i.test(fileName)) return { text, fileName, converted: false };
  return { text: (await toml(text)) ?? text, fileName: tomlName(fileName), converted: true };
}

async function toml(json: string): Promise<string | undefined> {
  try {
    return (await kernel.write(JSON.parse(json) as ModelTree)).text;
  } catch {
    return undefined; // opened as it is, with what is wrong with it
  }
}

/** A name that a model may be saved under: what is written is TOML. */
export function tomlName(typed: string): string {
  return `${typed.trim().replace(/\.(toml|json)$/i, "") || "untitled"}.toml`;
}

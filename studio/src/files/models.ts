// The text of a model from the content of a file, whatever its source.
import type { ModelTree } from "../kernel/protocol";
import { kernel } from "../play/kernel-session";

export interface ModelFile {
  text: string;
  fileName: string;
  /** The file was JSON: its text counts as a new file. */
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
    return undefined; // opened unchanged, with its complaints
  }
}

/** A name for saving a model: the written format is TOML. */
export function tomlName(typed: string): string {
  return `${typed.trim().replace(/\.(toml|json)$/i, "") || "untitled"}.toml`;
}

// Copy and paste through the system's clipboard, so that links can be copied between tabs; without it, within the page.
import { drawn, say } from "./actions";
import { copyThings, pasteThings } from "./model/removal";
import { type Model, extent } from "./model/model";
import { studio } from "./state";

let copied = "";
/** Number of pastes: each copy is shifted one step further. */
let times = 0;
/** Something else may have been copied meanwhile, because the page has not had the focus all the time. */
let away = true;

export function copySelection(): string {
  const { model, selection, poses } = studio.get();
  if (!selection.some((thing) => thing.kind === "body")) {
    say("Select a link to copy it.");
    return "";
  }
  copied = copyThings(model, selection, poses ?? undefined);
  times = 0;
  away = false;
  window.addEventListener("blur", () => (away = true), { once: true });
  void navigator.clipboard?.writeText(copied).catch(() => undefined);
  return copied;
}

export async function paste(): Promise<void> {
  const found = away ? (await navigator.clipboard?.readText?.().catch(() => ""))?.replace(/\r\n/g, "\n") : "";
  if (isModel(found) && found !== copied) {
    copied = found;
    times = 0;
  }
  pasteCopied();
}

/** Makes a shifted copy of the selection. */
export function duplicate(): void {
  if (copySelection()) pasteCopied();
}

const isModel = (text: string | undefined): text is string => text !== undefined && /^\s*\[body\./m.test(text);

function pasteCopied(): void {
  if (!isModel(copied)) return say("Nothing to paste: copy a link first.");
  const { model } = studio.get();
  const step = ++times * stepOf(model);
  drawn(pasteThings(model, copied, [step, -step]), "Paste");
}

function stepOf(model: Model): number {
  return model.bodies.length > 0 ? 0.1 * extent(model).size : 0;
}

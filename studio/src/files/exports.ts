// Files that the page exports: the run as CSV, the drawing as SVG, the motion as GIF.
import { say } from "../actions";
import type { Size } from "../drawing/camera";
import { theView } from "../drawing/canvas";
import { kernel } from "../play/kernel-session";
import { isOutdated, studio } from "../state";
import sceneStyle from "../styles/scene.css?inline";
import { download } from "./disk";
import { Film, type Picture, filmAsGif } from "./film";

export type Export = "csv" | "svg" | "gif" | "report";

const stem = (fileName = studio.get().fileName) => fileName.replace(/\.(toml|json)$/, "");

export async function exportAs(kind: Export): Promise<void> {
  try {
    if (kind === "csv") exportCsv();
    else if (kind === "svg") exportSvg();
    else if (kind === "gif") await exportGif();
    else await exportReport();
  } catch (error) {
    say(`The export failed: ${error instanceof Error ? error.message : String(error)}`);
  }
}

// After a change of the text, its run takes time, or there will be none; the previous run is exported.
function sayIfOld(): void {
  const { run } = studio.get();
  if (isOutdated(run)) say(`This is the run before your last change; ${run.status === "running" ? "the new run is not computed yet" : "the model as it is now has no run, see Problems"}.`);
}

function exportCsv(): void {
  const { answer } = studio.get().run;
  if (!answer || answer.values.length === 0) return say("There is no run to export yet.");
  sayIfOld();
  const lines = [answer.columns.map((one) => one.name).join(","), answer.columns.map((one) => one.unit).join(",")];
  const rows = answer.values[0]!.length;
  for (let i = 0; i < rows; i++) lines.push(answer.values.map((column) => String(column[i])).join(","));
  download(new Blob([lines.join("\n") + "\n"], { type: "text/csv" }), `${stem()}.csv`);
}

/** The drawing as shown, with its colours included. */
export function drawingAsSvg(): Picture {
  const view = theView();
  if (!view) throw new Error("there is no drawing");
  return pictureOf(view.svg, view.size);
}

function pictureOf(svg: SVGSVGElement, size: Size, width?: number): Picture {
  const copy = svg.cloneNode(true) as SVGSVGElement;
  copy.querySelector(".layer-overlay")?.remove();
  copy.querySelectorAll(".hover, .selected").forEach((one) => one.classList.remove("hover", "selected"));
  const factor = width ? width / size.width : 1;
  for (const name of [...copy.getAttributeNames()]) if (name !== "class") copy.removeAttribute(name);
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("viewBox", `0 0 ${size.width} ${size.height}`);
  copy.setAttribute("width", String(Math.round(size.width * factor)));
  copy.setAttribute("height", String(Math.round(size.height * factor)));
  const style = document.createElementNS("http://www.w3.org/2000/svg", "style");
  style.textContent = withoutVariables(sceneStyle);
  copy.prepend(style);
  const back = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  back.setAttribute("width", "100%");
  back.setAttribute("height", "100%");
  back.setAttribute("fill", variable("--paper"));
  style.after(back);
  return { text: new XMLSerializer().serializeToString(copy), width: Math.round(size.width * factor), height: Math.round(size.height * factor) };
}

const variable = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function withoutVariables(css: string): string {
  let text = css;
  for (let depth = 0; depth < 3 && text.includes("var("); depth++) text = text.replace(/var\((--[\w-]+)\)/g, (_, name: string) => variable(name));
  return text;
}

function exportSvg(): void {
  download(new Blob([drawingAsSvg().text], { type: "image/svg+xml" }), `${stem()}.svg`);
}

async function exportGif(): Promise<void> {
  const now = studio.get();
  const view = theView();
  const { answer } = now.run;
  if (!answer || !view || (answer.values[0]?.length ?? 0) < 2) return say("There is no run to export yet.");
  sayIfOld();
  say("Making the film…");
  const { size } = view;
  const bytes = await filmAsGif(new Film(view, now, answer), now.speed, (svg, width) => pictureOf(svg, size, width));
  download(new Blob([bytes as BlobPart], { type: "image/gif" }), `${stem(now.fileName)}.gif`);
  say("The film is saved.");
}

async function exportReport(): Promise<void> {
  const { run, history } = studio.get();
  if (!run.answer) return say("There is no run to report on yet.");
  say("The report is saved, from a run of the current model.");
  download(new Blob([await kernel.report(history.text)], { type: "text/html" }), `${stem()}-report.html`);
}

// What leaves the page as a file: the run as CSV, the drawing as SVG, the motion as GIF.
import { say } from "../actions";
import { theView } from "../drawing/canvas";
import { kernel } from "../play/desk";
import { player } from "../play/player";
import { studio } from "../state";
import sceneStyle from "../styles/scene.css?inline";
import { download } from "./disk";
import { GifWriter } from "./gif";

export type Export = "csv" | "svg" | "gif" | "report";

const stem = () => studio.get().fileName.replace(/\.(toml|json)$/, "");

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

function exportCsv(): void {
  const { answer } = studio.get().run;
  if (!answer || answer.values.length === 0) return say("There is no run to export yet.");
  const lines = [answer.columns.map((one) => one.name).join(","), answer.columns.map((one) => one.unit).join(",")];
  const rows = answer.values[0]!.length;
  for (let i = 0; i < rows; i++) lines.push(answer.values.map((column) => String(column[i])).join(","));
  download(new Blob([lines.join("\n") + "\n"], { type: "text/csv" }), `${stem()}.csv`);
}

/** The drawing as it stands, with its colours inside. */
export function drawingAsSvg(width?: number): { text: string; width: number; height: number } {
  const view = theView();
  if (!view) throw new Error("there is no drawing");
  const copy = view.svg.cloneNode(true) as SVGSVGElement;
  copy.querySelector(".layer-overlay")?.remove();
  copy.querySelectorAll(".hover, .selected").forEach((one) => one.classList.remove("hover", "selected"));
  const size = view.size;
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

const GIF_WIDTH = 640;
const FRAMES_PER_SECOND = 20;

async function exportGif(): Promise<void> {
  const { run, speed } = studio.get();
  if (!run.answer) return say("There is no run to export yet.");
  const end = player.duration;
  // The film lasts as long as it does on the screen, within reason.
  const seconds = Math.min(Math.max(end / speed, 1), 12);
  const frames = Math.round(seconds * FRAMES_PER_SECOND);
  say("The film is being made…");
  const canvas = document.createElement("canvas");
  const first = drawingAsSvg(GIF_WIDTH);
  canvas.width = first.width;
  canvas.height = first.height;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) throw new Error("the browser has no canvas");
  const writer = new GifWriter(first.width, first.height, Math.round(100 / FRAMES_PER_SECOND));
  for (let i = 0; i < frames; i++) {
    player.seek((i / frames) * end);
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const picture = new Image();
    picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(drawingAsSvg(GIF_WIDTH).text)}`;
    await picture.decode();
    context.drawImage(picture, 0, 0, first.width, first.height);
    writer.add(context.getImageData(0, 0, first.width, first.height).data);
  }
  download(new Blob([writer.finish() as BlobPart], { type: "image/gif" }), `${stem()}.gif`);
  say("The film is saved.");
}

async function exportReport(): Promise<void> {
  const { run, history } = studio.get();
  if (!run.answer) return say("There is no run to report on yet.");
  say("The report is made, of a run of the model as it is now.");
  download(new Blob([await kernel.report(history.text)], { type: "text/html" }), `${stem()}-report.html`);
}

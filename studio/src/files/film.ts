// The motion of a run as a GIF: filmed from a separate replay and drawing, so that the page may play, be edited or be hidden meanwhile.
import type { View } from "../drawing/view";
import { Scene, type Frame } from "../drawing/scene";
import { make } from "../drawing/svg";
import type { RunAnswer } from "../kernel/protocol";
import { type Model, poseOf } from "../model/model";
import { Replay } from "../play/replay";
import type { StudioState } from "../state";
import { GifWriter } from "./gif";

const GIF_WIDTH = 640;
const FRAMES_PER_SECOND = 20;

export interface Picture {
  text: string;
  width: number;
  height: number;
}

/** Like the page at this moment: with its camera, grid, arrows, traces and ghost. */
export class Film {
  readonly svg = make("svg", { class: "scene" });
  private readonly scene = new Scene(this.svg);
  private readonly model: Model;
  private readonly replay: Replay;
  private readonly ghost: { replay: Replay; move: (frame: Frame) => void } | null = null;

  constructor(view: Pick<View, "scene" | "looks" | "camera">, now: Pick<StudioState, "model" | "show" | "ghost">, answer: RunAnswer) {
    this.model = now.model;
    this.replay = new Replay(answer);
    const { grid, trace } = this.scene.layers;
    this.scene.show(now.model, view.looks, view.camera, { ...now.show, forceScale: this.replay.typicalForce });
    for (const [from, to] of [[view.scene.layers.grid, grid], [view.scene.layers.trace, trace]] as const) for (const one of from.children) to.append(one.cloneNode(true));
    const move = this.scene.ghost(now.model, now.ghost.answer ? view.looks : null);
    if (move && now.ghost.answer) this.ghost = { replay: new Replay(now.ghost.answer), move };
  }

  get end(): number {
    return this.replay.end;
  }

  show(t: number): void {
    const still = (name: string) => poseOf(this.model, name);
    this.scene.place(this.replay.frame(t, this.model, still));
    this.ghost?.move(this.ghost.replay.frame(t, this.model, still));
  }
}

export async function filmAsGif(film: Film, speed: number, picture: (svg: SVGSVGElement, width: number) => Picture): Promise<Uint8Array> {
  // The film lasts as long as on the screen, within limits.
  const seconds = Math.min(Math.max(film.end / speed, 1), 12);
  const frames = Math.round(seconds * FRAMES_PER_SECOND);
  const { width, height } = picture(film.svg, GIF_WIDTH);
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) throw new Error("the browser has no canvas");
  const writer = new GifWriter(width, height, Math.round(100 / FRAMES_PER_SECOND));
  for (let i = 0; i < frames; i++) {
    film.show((i / frames) * film.end);
    context.drawImage(await loaded(picture(film.svg, GIF_WIDTH).text), 0, 0, width, height);
    writer.add(context.getImageData(0, 0, width, height).data);
  }
  return writer.finish();
}

// Does not wait for a frame of the page, since a hidden tab has none.
function loaded(svg: string): Promise<HTMLImageElement> {
  return new Promise((resolve, reject) => {
    const image = new Image();
    image.onload = () => resolve(image);
    image.onerror = () => reject(new Error("a picture could not be drawn"));
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  });
}

// The templates, each with a small picture that moves while the pointer is over it.
import { useEffect, useRef, useState } from "react";
import { openText } from "../actions";
import { fitTo } from "../drawing/camera";
import { looksOf } from "../drawing/looks";
import { Scene } from "../drawing/scene";
import type { Template } from "../files/templates";
import { extent, poseOf, readModel } from "../model/model";
import { EMPTY_MODEL } from "../model/operations";
import type { RunHandle } from "../kernel/kernel";
import type { NamedFiles } from "../kernel/named-files";
import { kernel } from "../play/kernel-session";
import { Replay } from "../play/replay";
import { studio } from "../state";
import { Dialog } from "./dialog";

export function Gallery() {
  const [templates, setTemplates] = useState<readonly Template[]>([]);
  useEffect(() => {
    void import("../files/templates").then((module) => setTemplates(module.TEMPLATES));
  }, []);
  const choose = (text: string, file: string, files: NamedFiles = {}) => {
    openText(text, file, { files });
    studio.set({ dialog: null });
  };
  return (
    <Dialog title="Start from a mechanism" wide>
      <p className="dialog-lead">Each one runs immediately and can be changed freely. Point at a picture to see it move.</p>
      <ul className="gallery">
        <li>
          <button className="card" onClick={() => choose(EMPTY_MODEL, "untitled.toml")}>
            <span className="thumb empty-thumb" aria-hidden="true">
              +
            </span>
            <span className="card-name">Empty drawing</span>
            <span className="card-about">Draw links, pin them, add a motor, press play.</span>
          </button>
        </li>
        {templates.map((template) => (
          <Card key={template.file} template={template} onChoose={choose} />
        ))}
      </ul>
    </Dialog>
  );
}

function Card({ template, onChoose }: { template: Template; onChoose: (text: string, file: string, files: NamedFiles) => void }) {
  const svg = useRef<SVGSVGElement>(null);
  const picture = useRef<Picture | null>(null);
  useEffect(() => {
    if (!svg.current) return;
    picture.current = new Picture(svg.current, template);
    return () => picture.current?.stop();
  }, [template]);
  return (
    <li>
      <button
        className="card"
        data-template={template.file}
        onClick={() => onChoose(template.text, template.file, template.files)}
        onPointerEnter={() => void picture.current?.play()}
        onPointerLeave={() => picture.current?.stop()}
        onFocus={() => void picture.current?.play()}
        onBlur={() => picture.current?.stop()}
      >
        <svg ref={svg} className="thumb scene" aria-hidden="true" />
        <span className="card-name">{template.name}</span>
        <span className="card-about">{template.about}</span>
      </button>
    </li>
  );
}

const replays = new Map<string, Replay>();

/** A mechanism in a small frame. */
class Picture {
  private readonly model;
  private readonly scene;
  private wanted = false;
  private computing: RunHandle | null = null;

  constructor(svg: SVGSVGElement, private readonly template: Template) {
    this.model = readModel(template.text);
    svg.replaceChildren();
    this.scene = new Scene(svg);
    const size = { width: 2 * 212, height: 2 * 128 };
    svg.setAttribute("viewBox", `0 0 ${size.width} ${size.height}`);
    const box = extent(this.model);
    this.scene.show(this.model, looksOf(this.model, box.size), fitTo(box, size, 0.19), { labels: false, forces: false, centres: false, forceScale: 0 });
    this.scene.place({ pose: (name) => poseOf(this.model, name), forces: null });
  }

  async play(): Promise<void> {
    this.wanted = true;
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    const { text, files } = this.template;
    let replay = replays.get(text);
    if (!replay) {
      this.computing = kernel.run(text, { set: { "simulate.tolerance": "1e-3" }, files });
      const answer = await this.computing.result.catch(() => null);
      this.computing = null;
      if (!answer || answer.outcome === "interrupted" || answer.values.length === 0) return;
      replay = new Replay(answer);
      replays.set(text, replay);
    }
    const begin = performance.now();
    const slow = Math.max(1, 1.5 / Math.max(replay.end, 1e-6));
    const tick = (now: number) => {
      if (!this.wanted || !replay) return;
      const t = ((now - begin) / 1e3 / slow) % replay.end;
      this.scene.place(replay.frame(t, this.model, (name) => poseOf(this.model, name)));
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  stop(): void {
    this.wanted = false;
    this.computing?.cancel();
    this.scene.place({ pose: (name) => poseOf(this.model, name), forces: null });
  }
}

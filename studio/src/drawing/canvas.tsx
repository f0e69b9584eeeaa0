// The canvas in the page: creates the view and its gestures, and shows the fields for exact values next to the pointer.
import { useEffect, useRef } from "react";
import { useStore } from "../store";
import { useStudio } from "../state";
import { shortNumber } from "../model/units";
import { Gestures, entry } from "./gestures";
import { toolOf } from "./tools";
import { View } from "./view";

let shown: View | null = null;

/** The view on the page, for zooming and export; null before the first paint. */
export const theView = (): View | null => shown;

export function Canvas() {
  const svg = useRef<SVGSVGElement>(null);
  useEffect(() => {
    if (!svg.current) return;
    const view = new View(svg.current);
    const gestures = new Gestures(view);
    shown = view;
    return () => {
      gestures.close();
      view.close();
      shown = null;
    };
  }, []);
  const name = useStudio((now) => now.model.name || now.fileName);
  const counts = useStudio((now) => `${now.model.bodies.length} links, ${now.model.joints.length} joints`);
  return (
    <div className="canvas">
      <svg ref={svg} className="scene" tabIndex={0} role="application" aria-label={`Drawing of ${name}: ${counts}. Every tool has a key; arrows move its point, Enter places it; press question mark for help.`} />
      <ExactFields />
      <KeyPoint />
      <ToolHint />
    </div>
  );
}

function ExactFields() {
  const now = useStore(entry, (e) => e);
  if (!now.open) return null;
  const field = (key: "length" | "angle", value: string, unit: string, label: string) => (
    <span className={now.field === key ? "exact-field active" : "exact-field"}>
      <span className="exact-label">{label}</span>
      {now.typed[key] ? <b>{now.typed[key]}</b> : value}
      <span className="unit">{/[a-z°]/.test(now.typed[key]) ? "" : unit}</span>
    </span>
  );
  return (
    <div className="exact" style={{ left: now.x + 18, top: now.y + 18 }} aria-live="polite">
      {field("length", shortNumber(now.length * 1e3), "mm", now.radius ? "r" : "l")}
      {!now.radius && field("angle", shortNumber((now.angle * 180) / Math.PI, 4), "°", "∠")}
      <span className="exact-tip">{now.radius ? "type · Enter" : "type · Tab · Enter"}</span>
    </div>
  );
}

/** States in words where the keys have moved the point. */
function KeyPoint() {
  const said = useStore(entry, (now) => now.said);
  return (
    <p className="visually-hidden" role="status">
      {said}
    </p>
  );
}

function ToolHint() {
  const tool = useStudio((state) => state.tool);
  const mode = useStudio((state) => state.mode);
  const empty = useStudio((state) => state.model.bodies.length === 0);
  if (empty && tool === "select") return null;
  const hint = mode === "edit" ? toolOf(tool).hint : "Drag a link: a soft spring pulls it. Stop (Esc) returns to drawing.";
  return (
    <p className="tool-hint" role="status">
      {hint}
    </p>
  );
}

// The polar load diagram of a pin, next to the plots: rings of equal force, the path of the force's tip, the largest force, and the current force.
import { useEffect, useMemo, useRef, useState } from "react";
import type { PeakForce, RunAnswer } from "../../kernel/protocol";
import { quantity } from "../../model/units";
import { player } from "../../play/player";
import { studio, useStudio } from "../../state";
import { Choice } from "../properties/fields";
import { type Axes, type ForcePath, direction, forcePath, longest, peakTip, ringsUpTo, rowNearestTo } from "./polar";
import { nearest } from "./series";

const SIDE = 200;
const RADIUS = 84;
const SPOKES = Array.from({ length: 12 }, (_, i) => (i * Math.PI) / 6);
const LESS = 0.4; // minimum distance between two drawn points of a path

/** The selected pin, if the run has one of that name. */
export function usePin(answer: RunAnswer | null): PeakForce | null {
  const selection = useStudio((now) => now.selection);
  const [only, more] = selection;
  if (only?.kind !== "joint" || more) return null;
  return answer?.joints.find((one) => one.name === only.name && one.type === "revolute") ?? null;
}

export function PolarDiagram({ answer, joint, kept }: { answer: RunAnswer; joint: PeakForce; kept: RunAnswer | null }) {
  const [axes, setAxes] = useState<Axes>("world");
  const options: { value: Axes; label: string }[] = [
    { value: "world", label: `${joint.second_body}, world axes` },
    { value: "first", label: `${joint.first_body}, bush's axes` },
    { value: "second", label: `${joint.second_body}, pin's axes` },
  ];
  const path = useMemo(() => forcePath(answer, joint, axes), [answer, joint, axes]);
  const keptPath = useMemo(() => {
    const other = kept?.joints.find((one) => one.name === joint.name && one.type === "revolute");
    return kept && other ? forcePath(kept, other, axes) : null;
  }, [kept, joint, axes]);
  if (!path) return null;
  const time = answer.values[0]!;
  const peak = { tip: peakTip(path, time, joint), words: quantity(joint.peak, "N", 5) };
  const words = peak.tip ? `${peak.words} at ${direction(peak.tip)}°` : peak.words;
  return (
    <section className="polar" aria-label={`Polar load diagram of joint ${joint.name}`}>
      <Choice label="Force on" value={axes} options={options} meaning="Path of the force's tip. Bush and pin: the markers of the joint's first and second body" onChange={(value) => setAxes(value as Axes)} />
      <Picture about={`Force on ${options.find((one) => one.value === axes)!.label}; largest ${words}`} {...{ path, keptPath, time }} peak={peak.tip} />
      <button className="link-button inline" data-tip="Go to this time" onClick={() => player.seek(joint.peak_time)}>
        peak {words}
      </button>
    </section>
  );
}

interface PictureProps {
  about: string;
  path: ForcePath;
  keptPath: ForcePath | null;
  time: Float64Array;
  peak: [number, number] | null;
}

function Picture({ about, path, keptPath, time, peak }: PictureProps) {
  const hand = useRef<SVGPathElement>(null);
  const largest = useMemo(() => Math.max(longest(keptPath ? [path, keptPath] : [path]), peak ? Math.hypot(...peak) : 0), [path, keptPath, peak]);
  const rings = ringsUpTo(largest);
  const scale = largest > 0 ? RADIUS / largest : 0;
  const lines = useMemo(() => [path, keptPath].map((one) => (one ? lineOf(one, scale) : "")), [path, keptPath, scale]);
  useEffect(
    () =>
      player.onFrame(() => {
        const { mode } = studio.get();
        const row = mode === "edit" ? 0 : nearest(time, player.t);
        hand.current?.setAttribute("d", mode === "live" ? "" : lineOf({ x: Float64Array.of(0, path.x[row]!), y: Float64Array.of(0, path.y[row]!) }, scale));
      }),
    [path, time, scale],
  );
  const seek = (event: React.MouseEvent<SVGSVGElement>) => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(event.currentTarget.getScreenCTM()!.inverse());
    if (scale > 0) player.seek(time[rowNearestTo(path, [at.x / scale, -at.y / scale])]!);
  };
  return (
    <svg viewBox={`${-SIDE / 2} ${-SIDE / 2} ${SIDE} ${SIDE}`} role="img" aria-label={about} onClick={seek}>
      <g className="rings">
        {SPOKES.map((angle) => (
          <path key={angle} d={`M0 0L${RADIUS * Math.cos(angle)} ${RADIUS * Math.sin(angle)}`} />
        ))}
        {rings.map((force) => (
          <circle key={force} r={force * scale} />
        ))}
        <path className="axes" d={`M0 0H${RADIUS + 6}M0 0V${-RADIUS - 6}`} />
      </g>
      {keptPath && <path className="series tone0 kept" d={lines[1]} />}
      <path className="series tone0" d={lines[0]} />
      <path className="hand" ref={hand} />
      {peak && <circle className="peak" r={3} cx={peak[0] * scale} cy={-peak[1] * scale} />}
      <text x={RADIUS + 8} y={3}>
        x
      </text>
      <text x={5} y={-RADIUS - 4}>
        y
      </text>
      {rings.map((force) => (
        <text key={force} className="ring" x={force * scale * Math.SQRT1_2} y={force * scale * Math.SQRT1_2 + 3}>
          {quantity(force, "N")}
        </text>
      ))}
    </svg>
  );
}

/** A line through the rows; a row without numbers interrupts it. */
function lineOf({ x, y }: ForcePath, scale: number): string {
  let line = "";
  let last: [number, number] | null = null;
  for (let i = 0; i < x.length; i++) {
    const here: [number, number] = [x[i]! * scale, -y[i]! * scale];
    const known = Number.isFinite(here[0] + here[1]);
    if (known && last && i + 1 < x.length && Math.hypot(here[0] - last[0], here[1] - last[1]) < LESS) continue;
    if (known) line += `${last ? "L" : "M"}${here[0].toFixed(2)} ${here[1].toFixed(2)}`;
    last = known ? here : null;
  }
  return line;
}

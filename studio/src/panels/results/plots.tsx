// Plots of any quantity over time: one axis per unit, values at the cursor; a click moves the mechanism to that time.
import { useEffect, useMemo, useRef, useState } from "react";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { prettyUnit, shortNumber } from "../../model/units";
import { player } from "../../play/player";
import { isOutdated, studio, useStudio } from "../../state";
import { Nothing } from "./forces";
import { Icon } from "../icons";
import { PolarDiagram, usePin } from "./polar-diagram";
import { type Series, chosenSeries, nearest, resample, seriesOf } from "./series";

export function PlotsPanel() {
  const answer = useStudio((now) => now.run.answer);
  const kept = useStudio((now) => now.kept);
  const plotted = useStudio((now) => now.plotted);
  const theme = useStudio((now) => now.theme);
  const all = useMemo(() => (answer ? seriesOf(answer) : []), [answer]);
  const chosen = useMemo(() => (answer ? chosenSeries(all, plotted, answer) : []), [all, plotted, answer]);
  const other = useMemo(() => (kept ? { time: kept.answer.values[0]!, series: seriesOf(kept.answer) } : null), [kept]);
  const pin = usePin(answer);
  const old = useStudio((now) => isOutdated(now.run));
  if (!answer || (answer.values[0]?.length ?? 0) < 2) return <Nothing />;
  const toggle = (id: string) => {
    const ids = chosen.map((one) => one.id);
    studio.set({ plotted: ids.includes(id) ? ids.filter((one) => one !== id) : [...ids, id] });
  };
  return (
    <div className={`plots${pin ? " with-polar" : ""}${old ? " old" : ""}`}>
      <Plot key={theme} series={chosen} time={answer.values[0]!} kept={other} />
      {pin && <PolarDiagram answer={answer} joint={pin} kept={kept?.answer ?? null} />}
      <Legend series={chosen} kept={other?.series ?? null} onRemove={toggle} />
      <Chooser all={all} chosen={chosen} onToggle={toggle} />
    </div>
  );
}

interface PlotProps {
  series: readonly Series[];
  time: Float64Array;
  kept: { time: Float64Array; series: Series[] } | null;
}

/** Colours of series, read from the theme. */
function tones(element: Element): string[] {
  const style = getComputedStyle(element);
  return [0, 1, 2, 3, 4, 5].map((i) => style.getPropertyValue(`--tone${i}`).trim());
}

function Plot({ series, time, kept }: PlotProps) {
  const home = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = home.current;
    if (!element) return;
    const plot = makePlot(element, series, time, kept);
    const lineOf = new Map([...series.map((one) => one.id), ...keptLines(series, kept).map(({ one }) => keptId(one.id))].map((id, i) => [id, i + 1]));
    const observer = new ResizeObserver(() => plot.setSize(sizeOf(element)));
    observer.observe(element);
    const line = document.createElement("div");
    line.className = "now-line";
    plot.over.appendChild(line);
    const end = player.onFrame(() => {
      const at = plot.valToPos(studio.get().mode === "edit" ? 0 : player.t, "x");
      line.style.transform = `translateX(${at}px)`;
      const { mode } = studio.get();
      line.hidden = mode === "live";
      // While live, only a pointer over the plot stands for a time of the run.
      const index = plot.cursor.idx ?? (mode === "live" ? null : mode === "edit" ? 0 : nearest(time, player.t));
      document.querySelectorAll<HTMLElement>("[data-now]").forEach((text) => {
        const id = text.dataset["now"] ?? "";
        const live = () => series.find((one) => one.id === id)?.live?.((joint) => player.liveForce(joint));
        const value = index === null ? live() : plot.data[lineOf.get(id) ?? -1]?.[index];
        text.textContent = typeof value === "number" ? shortNumber(value, 5) : "–";
      });
    });
    return () => {
      end();
      observer.disconnect();
      plot.destroy();
    };
  }, [series, time, kept]);
  return <div className="plot" ref={home} role="img" aria-label={`Plot of ${series.map((one) => one.label).join(", ") || "nothing"} over time`} />;
}

/** The lines that the kept run also has, in the order in which they follow the lines of the run itself. */
function keptLines(series: readonly Series[], kept: PlotProps["kept"]): { one: Series; i: number; values: Series["values"] }[] {
  return series.flatMap((one, i) => {
    const other = kept?.series.find((candidate) => candidate.id === one.id);
    return other ? [{ one, i, values: other.values }] : [];
  });
}

const keptId = (id: string) => `kept ${id}`;

const sizeOf = (element: Element) => ({ width: Math.max(element.clientWidth, 200), height: Math.max(element.clientHeight, 100) });

function makePlot(element: HTMLElement, series: readonly Series[], time: Float64Array, kept: PlotProps["kept"]): uPlot {
  const colours = tones(element);
  const style = getComputedStyle(element);
  const ink = style.getPropertyValue("--ink-soft").trim();
  const grid = style.getPropertyValue("--line").trim();
  const units = [...new Set(series.map((one) => one.unit))];
  const data: uPlot.AlignedData = [time, ...series.map((one) => one.values())] as uPlot.AlignedData;
  const lines: uPlot.Series[] = series.map((one, i) => ({ label: one.label, scale: one.unit, stroke: colours[i % 6], width: 1.6, pxAlign: 0, points: { show: false } }));
  for (const { one, i, values } of keptLines(series, kept)) {
    (data as unknown[]).push(resample(kept!.time, values(), time));
    lines.push({ label: `${one.label}, kept`, scale: one.unit, stroke: colours[i % 6], width: 1.4, dash: [5, 4], pxAlign: 0, points: { show: false } });
  }
  const font = "11px system-ui, sans-serif";
  const axis = (unit: string, i: number): uPlot.Axis => ({
    scale: unit,
    side: i % 2 === 0 ? 3 : 1,
    label: prettyUnit(unit) || "–",
    labelFont: font,
    labelSize: 16,
    size: 56,
    font,
    stroke: ink,
    grid: { show: i === 0, stroke: grid, width: 1 },
    ticks: { stroke: grid, width: 1, size: 4 },
    values: (_, splits) => splits.map((value) => shortNumber(value, 6)),
  });
  const options: uPlot.Options = {
    ...sizeOf(element),
    legend: { show: false },
    padding: [10, 20, 0, 4],
    scales: { x: { time: false } },
    cursor: { drag: { x: true, y: false, dist: 8 }, points: { size: 7 }, bind: { dblclick: (plot) => () => (plot.setData(data), null) } },
    series: [{ label: "t" }, ...lines],
    hooks: { draw: [(plot) => drawPeaks(plot, series, colours)] },
    axes: [{ font, stroke: ink, size: 30, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1, size: 4 }, values: (_, splits) => splits.map((value) => `${shortNumber(value, 5)} s`) }, ...(units.length > 0 ? units : [""]).slice(0, 4).map(axis)],
  };
  const plot = new uPlot(options, data, element);
  plot.over.addEventListener("click", () => plot.cursor.left !== undefined && plot.cursor.left >= 0 && player.seek(plot.posToVal(plot.cursor.left, "x")));
  plot.over.addEventListener("pointermove", () => player.touch());
  plot.over.addEventListener("pointerleave", () => player.touch());
  return plot;
}

/** A dot on every line whose peak is known. */
function drawPeaks(plot: uPlot, series: readonly Series[], colours: readonly string[]) {
  plot.ctx.save();
  series.forEach((one, i) => {
    if (!one.peak) return;
    plot.ctx.beginPath();
    plot.ctx.arc(plot.valToPos(one.peak.t, "x", true), plot.valToPos(one.peak.value, one.unit, true), 3 * devicePixelRatio, 0, 2 * Math.PI);
    plot.ctx.fillStyle = colours[i % 6]!;
    plot.ctx.fill();
  });
  plot.ctx.restore();
}

function Legend({ series, kept, onRemove }: { series: readonly Series[]; kept: readonly Series[] | null; onRemove: (id: string) => void }) {
  return (
    <ul className="legend" aria-label="Plotted">
      {series.map((one, i) => (
        <li key={one.id}>
          <span className={`swatch tone${i % 6}`} />
          <span className="legend-label" data-tip={one.about}>
            {one.label}
          </span>
          <span className="legend-value">
            <span data-now={one.id}>–</span> {prettyUnit(one.unit)}
            {kept?.some((other) => other.id === one.id) && (
              <span className="legend-kept">
                kept <span data-now={keptId(one.id)}>–</span>
              </span>
            )}
          </span>
          <button className="icon-button tiny" aria-label={`Remove ${one.label} from the plot`} onClick={() => onRemove(one.id)}>
            <Icon name="close" size={13} />
          </button>
        </li>
      ))}
    </ul>
  );
}

function Chooser({ all, chosen, onToggle }: { all: readonly Series[]; chosen: readonly Series[]; onToggle: (id: string) => void }) {
  const [sought, setSought] = useState("");
  const words = sought.toLowerCase().split(/\s+/).filter(Boolean);
  const found = all.filter((one) => words.every((word) => `${one.group} ${one.label} ${one.id}`.toLowerCase().includes(word))).slice(0, 120);
  const groups = [...new Set(found.map((one) => one.group))];
  return (
    <div className="chooser">
      <input type="search" aria-label="Find a quantity" placeholder="Add a quantity…" value={sought} onChange={(event) => setSought(event.target.value)} />
      <div className="chooser-list" tabIndex={0} role="group" aria-label="Quantities">
        {groups.map((group) => (
          <section key={group}>
            <h3>{group}</h3>
            {found
              .filter((one) => one.group === group)
              .map((one) => (
                <label key={one.id} className="check" title={one.about}>
                  <input type="checkbox" checked={chosen.some((other) => other.id === one.id)} onChange={() => onToggle(one.id)} />
                  <span>{one.label}</span>
                </label>
              ))}
          </section>
        ))}
        {found.length === 0 && <p className="quiet">No matching quantity.</p>}
      </div>
    </div>
  );
}

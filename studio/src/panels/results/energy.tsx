// The energy account: initial energy, energy supplied, energy lost, and the error of the balance.
import type { RunAnswer } from "../../kernel/protocol";
import { quantity, shortNumber } from "../../model/units";
import { isOutdated, useStudio } from "../../state";
import { Nothing } from "./forces";

export function EnergyPanel() {
  const answer = useStudio((now) => now.run.answer);
  const old = useStudio((now) => now.mode === "live" || isOutdated(now.run));
  if (!answer) return <Nothing />;
  const { energy } = answer;
  const scale = Math.max(energy.kinetic_peak, Math.abs(energy.supplied), energy.dissipated, 1e-300);
  return (
    <div className={old ? "energy old" : "energy"}>
      <table className="numbers">
        <caption className="visually-hidden">Energy account</caption>
        <thead>
          <tr>
            <td />
            <th scope="col" className="right" data-tip="Energy of motion">
              Kinetic
            </th>
            <th scope="col" className="right" data-tip="Gravity, springs and joints">
              Potential
            </th>
            <th scope="col" className="right" data-tip="Dissipated in joints and dampers">
              Dissipated
            </th>
            <th scope="col" className="right" data-tip="By motors and loads">
              Supplied
            </th>
          </tr>
        </thead>
        <tbody>
          <tr>
            <th scope="row">Start</th>
            <td className="right">{quantity(energy.kinetic_start, "J")}</td>
            <td className="right">{quantity(energy.potential_start, "J")}</td>
            <td className="right">0</td>
            <td className="right">0</td>
          </tr>
          <tr>
            <th scope="row">End</th>
            <td className="right">{quantity(energy.kinetic_end, "J")}</td>
            <td className="right">{quantity(energy.potential_end, "J")}</td>
            <td className="right">{quantity(energy.dissipated, "J")}</td>
            <td className="right">{quantity(energy.supplied, "J")}</td>
          </tr>
        </tbody>
      </table>
      <p>
        Kinetic + potential + dissipated − supplied drifts by <b>{quantity(energy.drift, "J", 2)}</b>,{" "}
        {shortNumber((energy.drift / scale) * 100, 2)} % of the largest entry.
      </p>
      <EnergyChart answer={answer} />
    </div>
  );
}

const KINDS: [string, string][] = [
  ["kinetic", "tone0"],
  ["potential", "tone1"],
  ["dissipated", "tone2"],
  ["supplied", "tone3"],
];

function EnergyChart({ answer }: { answer: RunAnswer }) {
  const time = answer.values[0];
  const series = KINDS.map(([word, tone]) => ({ word, tone, values: answer.values[answer.columns.findIndex((one) => one.kind === "energy" && one.name.includes(word))] }));
  if (!time || series.some((one) => !one.values)) return null;
  let low = 0;
  let high = 0;
  for (const { values } of series) for (const value of values!) (low = Math.min(low, value)), (high = Math.max(high, value));
  const width = 640;
  const height = 96;
  const end = time[time.length - 1] ?? 1;
  const line = (values: Float64Array) =>
    Array.from(values, (value, i) => `${((time[i]! / end) * width).toFixed(1)},${(height - ((value - low) / (high - low || 1)) * height).toFixed(1)}`).join(" ");
  return (
    <figure className="energy-chart">
      <svg viewBox={`0 -2 ${width} ${height + 4}`} preserveAspectRatio="none" role="img" aria-label="Energies over time">
        {series.map((one) => (
          <polyline key={one.word} className={`series ${one.tone}`} points={line(one.values!)} />
        ))}
      </svg>
      <figcaption>
        {series.map((one) => (
          <span key={one.word}>
            <span className={`swatch ${one.tone}`} /> {one.word}
          </span>
        ))}
      </figcaption>
    </figure>
  );
}

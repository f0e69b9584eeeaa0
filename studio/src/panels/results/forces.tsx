// Peak forces of joints and springs, with what is known of their errors; and the work of the motors.
import { select } from "../../actions";
import type { PeakForce } from "../../kernel/protocol";
import { quantity, shortNumber } from "../../model/units";
import { player } from "../../play/player";
import { isOutdated, useStudio } from "../../state";
import { type Estimate, estimateOf } from "./estimate";

export function ForcesPanel() {
  const answer = useStudio((now) => now.run.answer);
  const kept = useStudio((now) => now.kept?.answer ?? null);
  const old = useStudio((now) => now.mode === "live" || isOutdated(now.run));
  if (!answer) return <Nothing />;
  const largest = Math.max(...answer.joints.map((one) => one.peak), 1e-300);
  const moments = answer.joints.some((one) => one.has_moment);
  return (
    <div className={old ? "table-wrap old" : "table-wrap"}>
      <table className="numbers">
        <caption className="visually-hidden">Peak forces of the joints, with error estimates</caption>
        <thead>
          <tr>
            <th scope="col">Joint</th>
            <th scope="col">On</th>
            <th scope="col" className="right">
              Peak force
            </th>
            <th scope="col" className="right" data-tip="From two runs with different tolerances: how far the value can be trusted">
              ± estimate
            </th>
            <th scope="col" className="right">
              At
            </th>
            <th scope="col" className="right" data-tip="Root mean square over the run">
              RMS
            </th>
            {moments && (
              <th scope="col" className="right">
                Peak moment
              </th>
            )}
            {kept && (
              <th scope="col" className="right">
                Kept run
              </th>
            )}
            <th scope="col">
              <span className="visually-hidden">Size</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {answer.joints.slice(0, 500).map((one) => (
            <Row key={one.name} one={one} estimate={estimateOf(one, answer)} largest={largest} moments={moments} kept={kept ? (kept.joints.find((other) => other.name === one.name) ?? null) : undefined} />
          ))}
        </tbody>
      </table>
      {answer.springs.length > 0 && (
        <table className="numbers">
          <caption>Springs</caption>
          <tbody>
            {answer.springs.map((one) => (
              <tr key={one.name}>
                <th scope="row">{one.name}</th>
                <td className="right">{quantity(one.peak, one.has_moment ? "N*m" : "N")}</td>
                <td className="right">at {quantity(one.peak_time, "s")}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {answer.motors.length > 0 && (
        <table className="numbers">
          <caption>Motors</caption>
          <tbody>
            {answer.motors.map((one) => (
              <tr key={one.name}>
                <th scope="row">{one.name}</th>
                <td className="right">
                  {quantity(one.peak_effort, one.unit)} peak
                  {one.effort_error !== null && ` ± ${quantity(one.effort_error, one.unit, 2)}`}
                </td>
                <td className="right">{quantity(one.peak_power, "W")} peak</td>
                <td className="right">{quantity(one.work, "J")} of work</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </div>
  );
}

interface RowProps {
  one: PeakForce;
  estimate: Estimate;
  largest: number;
  moments: boolean;
  kept?: PeakForce | null;
}

function Row({ one, estimate, largest, moments, kept }: RowProps) {
  const selected = useStudio((now) => now.selection.some((thing) => thing.kind === "joint" && thing.name === one.name));
  const change = kept && kept.peak > 0 ? (one.peak / kept.peak - 1) * 100 : null;
  return (
    <tr className={selected ? "selected" : ""} data-joint={one.name}>
      <th scope="row">
        <button className="link-button inline" onClick={() => select([{ kind: "joint", name: one.name }])}>
          {one.name}
        </button>
      </th>
      <td>{one.second_body}</td>
      <td className="right strong" data-peak={one.peak}>
        {quantity(one.peak, "N", 5)}
      </td>
      <td className="right quiet" title={estimate.share ?? undefined}>
        {estimate.text}
      </td>
      <td className="right">
        <button className="link-button inline" data-tip="Go to this time" onClick={() => player.seek(one.peak_time)}>
          {quantity(one.peak_time, "s")}
        </button>
      </td>
      <td className="right">{quantity(one.rms, "N")}</td>
      {moments && <td className="right">{one.has_moment ? quantity(one.peak_moment, "N*m") : ""}</td>}
      {kept !== undefined && (
        <td className="right">
          {kept ? quantity(kept.peak, "N") : "–"} {change !== null && <span className="quiet">{`${change >= 0 ? "+" : "−"}${shortNumber(Math.abs(change), 3)} %`}</span>}
        </td>
      )}
      <td className="bar-cell">
        <span className="size-bar" style={{ width: `${(one.peak / largest) * 100}%` }} />
      </td>
    </tr>
  );
}

export function Nothing() {
  const empty = useStudio((now) => now.model.bodies.length === 0);
  const status = useStudio((now) => now.run.status);
  return (
    <p className="quiet teach">
      {empty
        ? "Draw a mechanism: its forces appear here as soon as it can run."
        : status === "running"
          ? "The first run is being computed…"
          : "There is no run yet. See Problems for what is missing."}
    </p>
  );
}

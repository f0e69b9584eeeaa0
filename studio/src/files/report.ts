// A report as one HTML file: the drawing, the peak forces with their error estimates, the energy account, the text.
import { quantity, shortNumber } from "../model/units";
import { studio } from "../state";
import { drawingAsSvg } from "./exports";

const plainText = (text: string) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");

export async function reportOf(): Promise<string> {
  const { run, model, history } = studio.get();
  const answer = run.answer;
  if (!answer) return "";
  const title = plainText(model.name || "Mechanism");
  const rows = answer.joints
    .map(
      (one) =>
        `<tr><th>${plainText(one.name)}</th><td>${plainText(one.type)}</td><td>${plainText(one.second_body)}</td><td>${quantity(one.peak, "N", 5)}</td><td>± ${quantity(one.error_estimate, "N", 2)}</td><td>${quantity(one.peak_time, "s")}</td><td>${quantity(one.rms, "N")}</td></tr>`,
    )
    .join("\n");
  const { energy } = answer;
  return `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>${title}: report</title>
<style>
body{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#1b2430}
table{border-collapse:collapse;margin:1rem 0}th,td{padding:.3rem .8rem;border-bottom:1px solid #d5dbe3;text-align:right}
th:first-child,td:nth-child(2),td:nth-child(3){text-align:left}svg{max-width:100%;height:auto;border:1px solid #d5dbe3;border-radius:8px}
pre{background:#f4f6f9;padding:1rem;border-radius:8px;overflow:auto;font-size:12px}
</style></head><body>
<h1>${title}</h1>
${drawingAsSvg().text}
<h2>Peak forces</h2>
<table><thead><tr><th>Joint</th><th>Type</th><th>On</th><th>Peak</th><th>Estimated error</th><th>At</th><th>RMS</th></tr></thead><tbody>
${rows}
</tbody></table>
<h2>Energy account</h2>
<table><tr><th></th><th>Kinetic</th><th>Potential</th><th>Dissipated</th><th>Supplied</th></tr>
<tr><th>Start</th><td>${quantity(energy.kinetic_start, "J")}</td><td>${quantity(energy.potential_start, "J")}</td><td>0</td><td>0</td></tr>
<tr><th>End</th><td>${quantity(energy.kinetic_end, "J")}</td><td>${quantity(energy.potential_end, "J")}</td><td>${quantity(energy.dissipated, "J")}</td><td>${quantity(energy.supplied, "J")}</td></tr></table>
<p>Drift ${quantity(energy.drift, "J", 2)}. Method ${plainText(answer.method)}, tolerance ${shortNumber(answer.tolerance)}, ${quantity(answer.t_end, "s")} of model time.</p>
<h2>Model</h2>
<pre>${plainText(history.text)}</pre>
</body></html>
`;
}

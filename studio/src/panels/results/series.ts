// What can be plotted: the run's columns, and the magnitude of each joint force, which users usually want first.
import type { Column, PeakForce, RunAnswer } from "../../kernel/protocol";

export interface Series {
  id: string;
  label: string;
  unit: string;
  group: string;
  about: string;
  values: () => Float64Array;
  /** Its value in a live motion, from the forces on second bodies of joints. */
  live?: (forceOf: ForceOf) => number | undefined;
  /** Time and value of its peak, which may lie between the rows. */
  peak?: { t: number; value: number };
}

/** x and y of the force on a joint's second body. */
export type ForceOf = (joint: string) => readonly [number, number] | null;

const WORDS: Record<string, string> = {
  x: "x", y: "y", angle: "angle", vx: "velocity x", vy: "velocity y", spin: "spin", fx: "force x", fy: "force y", f1: "force along x of the joint", f2: "force along y of the joint",
  m: "moment", slide: "slide", slide_rate: "rate of slide", angle_rate: "rate of angle", effort: "effort", power: "power",
};

/** A column of a joint; if `frame` is given, the force on its second body. */
export function jointValues(answer: RunAnswer, joint: PeakForce, quantity: string, frame: "" | "world" | "joint" = ""): Float64Array | undefined {
  const feels = frame && joint.second_body;
  return answer.values[answer.columns.findIndex((one) => one.kind === "joint" && one.of === joint.name && one.quantity === quantity && one.frame === frame && one.feels === feels)];
}

export function seriesOf(answer: RunAnswer): Series[] {
  const list: Series[] = [];
  for (const joint of answer.joints) {
    const fx = jointValues(answer, joint, "fx", "world");
    const fy = jointValues(answer, joint, "fy", "world");
    if (!fx || !fy) continue;
    list.push({
      id: `joint.${joint.name}.|F|`,
      label: `|F| at ${joint.name}`,
      unit: "N",
      group: `Joint ${joint.name}`,
      about: `Magnitude of the force in joint ${joint.name}`,
      values: () => fx.map((value, i) => Math.hypot(value, fy[i]!)),
      live: (forceOf) => magnitude(forceOf(joint.name)),
      peak: { t: joint.peak_time, value: joint.peak },
    });
  }
  answer.columns.forEach((column, i) => {
    if (column.kind === "time") return;
    const word = WORDS[column.quantity] ?? column.quantity;
    const group = column.kind === "energy" ? "Energy" : `${column.kind === "body" ? "Link" : column.kind.charAt(0).toUpperCase() + column.kind.slice(1)} ${column.of}`;
    list.push({
      id: column.name,
      label: column.kind === "energy" ? `${column.name.replace("energy.", "")} energy` : `${column.of} ${word}${column.feels ? ` on ${column.feels}` : ""}`,
      unit: column.unit,
      group,
      about: column.about,
      values: () => answer.values[i]!,
      live: liveComponent(column, answer),
    });
  });
  return list;
}

const magnitude = (force: ReturnType<ForceOf>) => (force ? Math.hypot(...force) : undefined);

// A live motion has the forces of joints only.
function liveComponent({ kind, of, quantity, frame, feels }: Column, answer: RunAnswer): Series["live"] {
  const axis = quantity === "fx" ? 0 : 1;
  if (kind !== "joint" || frame !== "world" || (axis === 1 && quantity !== "fy")) return undefined;
  const sign = answer.joints.some((joint) => joint.name === of && joint.second_body === feels) ? 1 : -1;
  return (forceOf) => {
    const force = forceOf(of);
    return force ? sign * force[axis] : undefined;
  };
}

/** The largest forces: plotted until the user chooses. */
function firstSeries(answer: RunAnswer): string[] {
  return [...answer.joints]
    .sort((a, b) => b.peak - a.peak)
    .slice(0, 4)
    .map((joint) => `joint.${joint.name}.|F|`);
}

/** The plotted series: those chosen, even if none; if nothing was chosen, or this run has none of the chosen series, the default. */
export function chosenSeries(all: readonly Series[], plotted: readonly string[] | null, answer: RunAnswer): Series[] {
  const among = (ids: readonly string[]) => ids.map((id) => all.find((one) => one.id === id)).filter((one): one is Series => one !== undefined);
  const found = plotted ? among(plotted) : [];
  return found.length > 0 || plotted?.length === 0 ? found : among(firstSeries(answer));
}

/** The row nearest to a time; rows are equally spaced. */
export function nearest(time: Float64Array, t: number): number {
  const span = (time[time.length - 1] ?? 1) / Math.max(time.length - 1, 1);
  return Math.min(Math.max(Math.round(t / span), 0), time.length - 1);
}

/** Values interpolated at other times, for two runs in one plot; null outside the run. */
export function resample(time: Float64Array, values: Float64Array, at: Float64Array): (number | null)[] {
  const result: (number | null)[] = [];
  let i = 0;
  const end = time[time.length - 1] ?? 0;
  for (const t of at) {
    while (i < time.length - 2 && time[i + 1]! < t) i++;
    const span = (time[i + 1] ?? 0) - (time[i] ?? 0);
    if (t > end * (1 + 1e-9) || span <= 0) result.push(null);
    else result.push(values[i]! + ((values[i + 1]! - values[i]!) * (t - time[i]!)) / span);
  }
  return result;
}

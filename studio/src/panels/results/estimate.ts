import type { PeakForce, RunAnswer } from "../../kernel/protocol";
import { quantity, shortNumber } from "../../model/units";

// As in the report (src/report/page_tables.cpp): a run that stopped early has no second pass to compare with, and its 0 says nothing.
// A number that is none arrives as null.
function known(one: PeakForce, run: Pick<RunAnswer, "outcome">): boolean {
  return Number.isFinite(one.error_estimate) && (one.error_estimate > 0 || run.outcome === "completed");
}

export interface Estimate {
  /** For a cell of a table. */
  text: string;
  /** Below a number. */
  about: string;
  /** Of the peak, null where it is not known. */
  share: string | null;
}

/** How far a peak force can be trusted, in words. */
export function estimateOf(one: PeakForce, run: Pick<RunAnswer, "outcome">): Estimate {
  if (!one.unique) return { text: "not unique", about: "not unique", share: null };
  if (!known(one, run)) return { text: "–", about: "error unknown", share: null };
  const text = `± ${quantity(one.error_estimate, "N", 2)}`;
  const share = Number.isFinite(one.relative_error_estimate) ? `${shortNumber(one.relative_error_estimate * 100, 2)} % of the peak` : null;
  return { text, about: `${text} estimated error`, share };
}

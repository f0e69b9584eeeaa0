import type { PeakForce, RunAnswer } from "../../kernel/protocol";
import { quantity, shortNumber } from "../../model/units";

// As in the report (src/report/page_tables.cpp): a run that stopped early has no second pass to compare with, so its 0 is meaningless.
// NaN arrives as null.
function known(one: PeakForce, run: Pick<RunAnswer, "outcome">): boolean {
  return Number.isFinite(one.error_estimate) && (one.error_estimate > 0 || run.outcome === "completed");
}

export interface Estimate {
  /** For a table cell. */
  text: string;
  /** To be shown below a number. */
  about: string;
  /** Fraction of the peak, null if unknown. */
  share: string | null;
}

/** The accuracy of a peak force, in words. */
export function estimateOf(one: PeakForce, run: Pick<RunAnswer, "outcome">): Estimate {
  if (!one.unique) return { text: "not unique", about: "not unique", share: null };
  if (!known(one, run)) return { text: "–", about: "error unknown", share: null };
  const text = `± ${quantity(one.error_estimate, "N", 2)}`;
  const share = Number.isFinite(one.relative_error_estimate) ? `${shortNumber(one.relative_error_estimate * 100, 2)} % of the peak` : null;
  return { text, about: `${text} estimated error`, share };
}

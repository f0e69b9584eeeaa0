#include "results/force_quality.h"

#include <algorithm>
#include <limits>

namespace pintle {

bool has_force_estimates(const Trajectory& run) {
  return run.outcome == Outcome::kCompleted ||
         std::any_of(run.joints.begin(), run.joints.end(), [](const LoadSummary& joint) { return joint.relative_error_estimate > 0; });
}

bool peaks_behind_horizon(const LoadSummary& joint, const Trajectory& run) { return run.outcome == Outcome::kHorizon && joint.peak_time > joint.horizon; }

const LoadSummary* largest_joint(const Trajectory& run) {
  const auto found = std::max_element(run.joints.begin(), run.joints.end(),
                                      [](const LoadSummary& a, const LoadSummary& b) { return a.peak < b.peak; });
  return found == run.joints.end() ? nullptr : &*found;
}

bool couple_decides(const LoadSummary& joint) {
  constexpr double last_bits = 8 * std::numeric_limits<double>::epsilon();
  return joint.relative_error_estimate * joint.peak > (1 + last_bits) * joint.error_estimate;
}

bool misses_tolerance(const LoadSummary& joint, const Trajectory& run) {
  if (run.of_motion || !(run.tolerance > 0) || !has_force_estimates(run)) return false;
  return !(joint.relative_error_estimate <= run.tolerance);
}

}  // namespace pintle

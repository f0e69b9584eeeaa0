#include "run/errors/promises.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle {
namespace {

constexpr int kIntervals = 8;  // of the remainder of a run, whose means tell how far its own may be off

// Statistics of a joint's force in the rows after `from` and up to `to` [s], by the trapezoidal rule in time.
template <class S>
LoadStatistics of_rows(const BasicForceTable<S>& forces, std::size_t joints, std::size_t j, double from, double to = std::numeric_limits<double>::infinity()) {
  LoadStatistics out;
  double span = 0;
  for (std::size_t i = 1; i < forces.t.size(); ++i) {
    if (forces.t[i] <= from || forces.t[i] > to) continue;
    const double last = linear_magnitude<S>(forces.world[(i - 1) * joints + j]), now = linear_magnitude<S>(forces.world[i * joints + j]), h = forces.t[i] - forces.t[i - 1];
    out.peak = std::max(out.peak, now);
    out.mean += 0.5 * h * (last + now);
    out.rms += 0.5 * h * (last * last + now * now);
    span += h;
  }
  if (span > 0) {
    out.mean /= span;
    out.rms = std::sqrt(out.rms / span);
  }
  return out;
}

// Standard errors of mean and RMS after `from`, from their scatter over intervals of equal length.
template <class S>
LoadStatistics standard_errors(const BasicForceTable<S>& forces, std::size_t joints, std::size_t j, double from) {
  const double length = (forces.t.back() - from) / kIntervals;
  double mean = 0, mean_square = 0, square = 0, square_square = 0;
  for (int i = 0; i < kIntervals; ++i) {
    const LoadStatistics part = of_rows(forces, joints, j, from + i * length, from + (i + 1) * length);
    const double part_square = part.rms * part.rms;
    mean += part.mean / kIntervals;
    mean_square += part.mean * part.mean / kIntervals;
    square += part_square / kIntervals;
    square_square += part_square * part_square / kIntervals;
  }
  const auto of_mean = [](double average, double average_square) { return std::sqrt(std::max(0.0, average_square - average * average) / (kIntervals - 1)); };
  LoadStatistics out;
  out.mean = of_mean(mean, mean_square);
  out.rms = square > 0 ? of_mean(square, square_square) / (2 * std::sqrt(square)) : 0;
  return out;
}

// Rows miss impacts between them, as is assumed in the same ratio before and after a horizon; the peak of the whole run is known.
template <class S>
LoadStatistics after(const BasicForceRecorder<S>& pass, std::size_t joints, std::size_t j, double from) {
  LoadStatistics out = of_rows(pass.forces(), joints, j, from);
  const LoadStatistics rows = of_rows(pass.forces(), joints, j, -std::numeric_limits<double>::infinity()), run = pass.loads().force(static_cast<int>(j));
  if (run.peak_time > from) out.peak = std::max(out.peak, run.peak);
  if (rows.mean > 0) out.mean *= run.mean / rows.mean;
  if (rows.rms > 0) out.rms *= run.rms / rows.rms;
  return out;
}

}  // namespace

template <class S>
void promise_until_horizons(const BasicSystem<S>& system, const BasicForceRecorder<S>& coarse, const BasicForceRecorder<S>& fine, double share, double within, const BasicLeastError<S>& least, const ErrorGrowth& growth, Trajectory& out) {
  const std::size_t joints = system.joints.size();
  std::vector<double> horizons = force_horizons(system, coarse.forces(), fine.forces(), share, within);
  out.growth = {growth.rate, growth.rate_error, out.t_end};
  if (out.of_motion) {
    out.growth.horizon = curve_horizon(motion_difference_curve(system, coarse.forces(), fine.forces()), within);
    horizons.assign(joints, out.growth.horizon);
  }
  state_errors_until(system, coarse.forces(), fine.forces(), horizons, share, least, out.joints);
  const LoadSummary* earliest = nullptr;
  std::size_t row = 0;
  for (std::size_t j = 0; j < joints; ++j) {
    if (system.joints[j].servo >= 0) continue;
    LoadSummary& joint = out.joints[row++];
    joint.horizon = horizons[j];
    const LoadStatistics now = after(fine, joints, j, joint.horizon), other = after(coarse, joints, j, joint.horizon);
    joint.peak_after = now.peak;
    joint.rms_after = now.rms;
    joint.mean_after = now.mean;
    joint.peak_scatter = std::abs(now.peak - other.peak);
    const LoadStatistics within_run = standard_errors(fine.forces(), joints, j, joint.horizon);
    joint.rms_scatter = std::max(std::abs(now.rms - other.rms), within_run.rms);
    joint.mean_scatter = std::max(std::abs(now.mean - other.mean), within_run.mean);
    if (earliest == nullptr || joint.horizon < earliest->horizon) earliest = &joint;
  }
  if (earliest != nullptr && !out.of_motion) out.growth.horizon = earliest->horizon;
  out.message = fmt::format(
      "{} promised up to t = {:.4g} s{}: the motion is chaotic, errors grow e-fold every {:.2g} s ({:.3g} +- {:.1g} per second), and integrations with tolerances down to {:.1g} diverge from each other before its end; "
      "peaks, means and RMS after that are statistics",
      out.of_motion ? "positions are" : "joint forces are", out.growth.horizon, earliest != nullptr && !out.of_motion ? " (joint " + earliest->name + ")" : "", 1 / growth.rate, growth.rate, growth.rate_error, least.tolerance);
}

template void promise_until_horizons(const BasicSystem<Planar>& system, const BasicForceRecorder<Planar>& coarse, const BasicForceRecorder<Planar>& fine, double share, double within, const BasicLeastError<Planar>& least, const ErrorGrowth& growth, Trajectory& out);
PINTLE_IN_SPACE(template void promise_until_horizons(const BasicSystem<Spatial>& system, const BasicForceRecorder<Spatial>& coarse, const BasicForceRecorder<Spatial>& fine, double share, double within, const BasicLeastError<Spatial>& least, const ErrorGrowth& growth, Trajectory& out);)

}  // namespace pintle

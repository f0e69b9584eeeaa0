#include "run/record/missed_peaks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pintle {
namespace {

constexpr double kMissed = 0.01;       // of a peak, or of the work
constexpr double kNegligible = 0.01;   // of the largest force: joints that carry less are not looked at
constexpr double kNoWork = 1e-3;       // of the largest kinetic energy
constexpr double kRowsPerStep = 5;     // show what a step has found
constexpr double kMostRefined = 1e-3;  // of the output step: a peak that asks for less is a shock
constexpr const char* kTables = "peaks, means and work in the tables are those of the rows";

template <class S>
double square_of(const BasicState<S>& state, std::size_t j) { return state.force[j].template head<S::kDim>().squaredNorm(); }

}  // namespace

template <class S>
BasicMissedPeaks<S>::BasicMissedPeaks(const BasicSystem<S>& system) : system_(system), in_rows_(system.joints.size(), 0), at_steps_(system.joints.size()) {}

template <class S>
void BasicMissedPeaks<S>::add_row(const BasicState<S>& state, double power, double kinetic) {
  for (std::size_t j = 0; j < in_rows_.size(); ++j) in_rows_[j] = std::max(in_rows_[j], square_of(state, j));
  if (any_row_) {
    work_ += 0.5 * (power_ + power) * (state.t - t_);
    moved_ += 0.5 * (std::abs(power_) + std::abs(power)) * (state.t - t_);
  } else {
    supplied_before_ = state.supplied;
  }
  any_row_ = true;
  kinetic_ = std::max(kinetic_, kinetic);
  t_ = state.t;
  power_ = power;
  supplied_ = state.supplied;
}

template <class S>
void BasicMissedPeaks<S>::add_step(const BasicState<S>& state, double h) {
  for (std::size_t j = 0; j < at_steps_.size(); ++j)
    if (const double square = square_of(state, j); square > at_steps_[j].square) at_steps_[j] = {square, state.t, h};
}

template <class S>
std::string BasicMissedPeaks<S>::note(double output_step) const {
  const std::string peak = missed_peak(output_step);
  return peak.empty() ? missed_work() : peak;
}

template <class S>
std::string BasicMissedPeaks<S>::missed_peak(double output_step) const {
  double largest = 0, worst = (1 + kMissed) * (1 + kMissed);
  for (std::size_t j = 0; j < at_steps_.size(); ++j)
    if (system_.joints[j].servo < 0) largest = std::max(largest, at_steps_[j].square);
  std::size_t missed = at_steps_.size();
  for (std::size_t j = 0; j < at_steps_.size(); ++j) {
    const double square = at_steps_[j].square;
    if (system_.joints[j].servo >= 0 || square < kNegligible * kNegligible * largest || !(square > worst * in_rows_[j])) continue;
    worst = in_rows_[j] > 0 ? square / in_rows_[j] : square;
    missed = j;
  }
  if (missed == at_steps_.size()) return "";
  const Peak& peak = at_steps_[missed];
  const double wanted = peak.h / kRowsPerStep;
  const bool known = wanted > kMostRefined * output_step && wanted < output_step;
  return fmt::format("output rows miss a peak: joint {} carries {:.5g} N at t = {:.5g} s, the rows show at most {:.5g} N; {}. {}", system_.joints[missed].name,
                     std::sqrt(peak.square), peak.t, std::sqrt(in_rows_[missed]), kTables,
                     known ? fmt::format("output_step = \"{:.1g} s\" resolves it", wanted) : "A shorter output_step resolves it");
}

template <class S>
std::string BasicMissedPeaks<S>::missed_work() const {
  const double supplied = supplied_ - supplied_before_;
  const double missed = std::abs(work_ - supplied);
  if (!(missed > kMissed * std::max(moved_, std::abs(supplied)) && missed > kNoWork * kinetic_)) return "";
  return fmt::format("output rows are too far apart: their power integrates to {:.5g} J, but {:.5g} J were supplied; {}. A shorter output_step resolves it", work_,
                     supplied, kTables);
}

template class BasicMissedPeaks<Planar>;
template class BasicMissedPeaks<Spatial>;

}  // namespace pintle

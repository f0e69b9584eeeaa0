#include "integrators/radau/sliding_mode.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle {
namespace {

constexpr double kRounding = 4;  // smallest width of a ramp, as a multiple of the rounding of velocities over the tolerance
// Tolerance that a ramp still resolves: a width that continued to grow with 1/tolerance would let a held motion creep. With 1e-8 the shaper
// of held_gas_force_test.cpp takes four times the steps at a tolerance of 1e-5, with 1e-7 25 times; with no limit it loses 13 % of its peak
// at 1e-6.
constexpr double kFinest = 1e-9;
// Power of the tolerance, below that, with which ramps get narrower: passes with equally wide ramps share their lag. For tests/models/relay_on_a_ringing_pin.toml at 1e-5, half of it
// states half of the error; with twice it the run takes three times the steps, and states 1/100 of the shaper's error.
constexpr double kNarrower = 0.25;

}  // namespace

template <class S>
std::optional<SlidingMode> BasicChatteringDetector<S>::crossed(const BasicSystem<S>& system, double t0, const std::vector<typename S::Motion>& m0, double t1,
                                           const std::vector<typename S::Motion>& m1, double soon) {
  const std::optional<SlidingMode> before = last_;
  const double since = t1 - t_;
  last_ = system.jump_between(t0, m0, t1, m1);
  t_ = t1;
  const bool again = before && last_ && before->load == last_->load && before->ramp.jump == last_->ramp.jump && since < soon;
  return again ? last_ : std::nullopt;
}

template <class S>
bool leave_sliding(const BasicSystem<S>& system, double t, const std::vector<typename S::Motion>& m, std::vector<SlidingMode>& sliding) {
  const std::size_t before = sliding.size();
  std::erase_if(sliding, [&](const SlidingMode& jump) {
    const double share = jump.ramp.share_at(system.margin(jump, t, m));
    return !(share >= 0 && share <= 1);
  });
  return sliding.size() < before;
}

template <class S>
RampSize ramp_size(const BasicSystem<S>& system, const SlidingMode& jump, const BasicState<S>& state, double next_step, double tolerance) {
  double fastest = largest_coordinate(state.v);
  if (system.loads[jump.load].component >= S::kDim)
    for (const auto& v : state.v) fastest = std::max(fastest, v.template tail<S::kDof - S::kDim>().cwiseAbs().maxCoeff());
  const double resolved = tolerance > kFinest ? tolerance : kFinest * std::pow(kFinest / tolerance, kNarrower);
  return {tolerance * next_step, kRounding * std::numeric_limits<double>::epsilon() * fastest / resolved};
}

template bool leave_sliding(const BasicSystem<Planar>& system, double t, const std::vector<Planar::Motion>& m, std::vector<SlidingMode>& sliding);
template RampSize ramp_size(const BasicSystem<Planar>& system, const SlidingMode& jump, const BasicState<Planar>& state, double next_step, double tolerance);
PINTLE_IN_SPACE(template bool leave_sliding(const BasicSystem<Spatial>& system, double t, const std::vector<Spatial::Motion>& m, std::vector<SlidingMode>& sliding);)
PINTLE_IN_SPACE(template RampSize ramp_size(const BasicSystem<Spatial>& system, const SlidingMode& jump, const BasicState<Spatial>& state, double next_step, double tolerance);)

template class BasicChatteringDetector<Planar>;
PINTLE_IN_SPACE(template class BasicChatteringDetector<Spatial>;)

}  // namespace pintle

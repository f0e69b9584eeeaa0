// Positions where the constraints lose rank: steps around them, forces near them, and reports of them. theory/ideal section 3.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "integrators/dormand_prince.h"
#include "integrators/ideal/ideal_stepper.h"
#include "linalg/lagrange_weights.h"

namespace pintle {
namespace {

using S = Planar;
using dormand_prince::kC;

constexpr double kSingular = 1e-4;       // fraction of the largest independence met: below it a position counts as singular
constexpr double kTooNear = 3e-4;        // fraction of the largest: no stage has less, so near to a singular position
constexpr double kShareBefore = 0.55;    // fraction of a step over a singular position that lies before it: in the widest gap between the stages, from 0.3 to 0.8
constexpr double kNearStep = 0.8;        // steps to a singular position: if it is nearer than this it is stepped over, if nearer than twice this, with the next step
constexpr int kSearch = 48;              // iterations of the search inside a step for the position where the constraints are most dependent
constexpr double kAhead = 1e-3;          // fraction of the step: how far inside its ends the independence is checked for a decrease
constexpr double kUnbounded = 1e-3;      // fraction of the largest reaction at the last accurate state: a part that grows as 1/d counts if it is larger
constexpr int kMostReported = 5;
constexpr std::size_t kAccurate = 5;     // number of states kept whose forces have most of their digits: the curve for forces at singular positions goes through them

}  // namespace

// Near a singular position but not at it, as a run may be at its start.
bool IdealStepper::is_near_singular_position() const {
  return independence_ < kSuspicious * most_independent_ && independence_ > 0.5 * kTooNear * most_independent_;
}

bool IdealStepper::is_too_near(double independence) const { return independence < kTooNear * most_independent_; }

// A step of h, or a similar one that leads up to a singular position ahead or over it, so that no stage is close to it. The independence of the
// constraints falls in proportion to the distance to it. theory/ideal Eq. (3.2).
double IdealStepper::step_around_singular_position(double h) {
  clear_h_ = 0;
  if (!is_near_singular_position()) return h;
  Vecs ahead = begin_.q;
  for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] += kAhead * h * begin_.v[i];
  const double fall = independence_ - equations_.independence(begin_.t + kAhead * h, ahead);
  if (!(fall > 0)) return h;
  const double distance = kAhead * h * independence_ / fall;
  const double clear = kTooNear * most_independent_ / (kShareBefore - kC[2]) * distance / independence_;
  if (distance < kNearStep * std::max(h, clear)) {
    clear_h_ = clear;
    return distance / kShareBefore;
  }
  return distance < 2 * kNearStep * h ? distance - kShareBefore * h : h;
}

// Near a singular position forces and accelerations are those of the curve through the last states that are not near it. theory/ideal section 3.
void IdealStepper::interpolate_forces(State& state) {
  if (accurate_.size() < 2) return;
  for (Vecs* x : {&state.a, &state.force, &state.gap_accel})
    for (S::Vec& each : *x) each.setZero();
  state.supply_power = state.loss_power = 0;
  std::array<double, kAccurate> times{}, weight{};
  for (std::size_t i = 0; i < accurate_.size(); ++i) times[i] = accurate_[i].state.t;
  lagrange_weights(times, 0, accurate_.size(), state.t, weight);
  for (std::size_t n = 0; n < accurate_.size(); ++n) {
    const State& node = accurate_[n].state;
    for (std::size_t i = 0; i < state.a.size(); ++i) state.a[i] += weight[n] * node.a[i];
    for (std::size_t j = 0; j < state.force.size(); ++j) {
      state.force[j] += weight[n] * node.force[j];
      state.gap_accel[j] += weight[n] * node.gap_accel[j];
    }
    state.supply_power += weight[n] * node.supply_power;
    state.loss_power += weight[n] * node.loss_power;
  }
}

// Detects reactions that grow as 1/d towards a singular position: their product with the independence d does not vanish with d.
void IdealStepper::look_for_unbounded_reactions() {
  const std::size_t n = accurate_.size();
  if (unbounded_at_ >= 0 || n < 3) return;
  std::array<double, kAccurate> d{}, weight{};
  for (std::size_t i = 0; i < n; ++i) d[i] = accurate_[i].independence;
  lagrange_weights(d, 0, n, 0, weight);
  double largest = 0, residue = 0;
  for (std::size_t j = 0; j < end_.force.size(); ++j) {
    S::Vec product = S::Vec::Zero();  // at d = 0
    for (std::size_t i = 0; i < n; ++i) product += weight[i] * d[i] * accurate_[i].state.force[j];
    residue = std::max(residue, product.head<2>().norm());
    largest = std::max(largest, accurate_.back().state.force[j].head<2>().norm());
  }
  if (residue > kUnbounded * d[n - 1] * largest) unbounded_at_ = end_.t;
}

// Keeps the newest state, and others as far apart as the curve through them has to reach.
void IdealStepper::keep_accurate() {
  if (independence_ < kFewDigits * most_independent_) {
    look_for_unbounded_reactions();
    const Vecs a = end_.a;  // its part that moves the mechanism has all its digits, and the next step starts from it
    interpolate_forces(end_);
    end_.a = a;
    return;
  }
  const std::size_t n = accurate_.size();
  if (n > 1 && std::abs(accurate_[n - 2].independence - independence_) < 0.5 * kFewDigits * most_independent_) accurate_.pop_back();
  else if (n == kAccurate) accurate_.erase(accurate_.begin());
  accurate_.push_back({end_, independence_});
}

// A position where the constraints lose rank may lie inside the step: their independence falls towards it and grows after it.
void IdealStepper::look_for_singular_position() {
  const auto at = [&](double share) {
    const double t = begin_.t + share * (end_.t - begin_.t);
    return equations_.independence(t, share <= 0 ? begin_.q : share >= 1 ? end_.q : dense_.at(t, begin_, end_).q);
  };
  const double first = independence_, last = at(1);
  independence_ = last;
  most_independent_ = std::max(most_independent_, last);
  if (std::min(first, last) > kSuspicious * most_independent_) return;
  if (!(at(kAhead) < first) || !(at(1 - kAhead) < last)) return;
  double low = 0, high = 1;
  for (int i = 0; i < kSearch; ++i) {
    const double third = (high - low) / 3;
    if (at(low + third) < at(high - third)) high -= third;
    else low += third;
  }
  if (at(0.5 * (low + high)) < kSingular * most_independent_) report_singular_position(begin_.t + 0.5 * (low + high) * (end_.t - begin_.t));
}

void IdealStepper::report_singular_position(double t) {
  if (++n_singular_ > kMostReported) return;
  if (n_singular_ == kMostReported) {
    remarks_.push_back("ideal joints: further singular positions follow");
    return;
  }
  const Eigen::VectorXd dependency = equations_.nearest_dependency();
  std::vector<int> order(static_cast<std::size_t>(dependency.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return std::abs(dependency[a]) > std::abs(dependency[b]) + 1e-9; });
  constexpr std::size_t kShown = 6;
  std::string names;
  for (std::size_t i = 0; i < std::min(kShown, order.size()) && std::abs(dependency[order[i]]) > 0.05; ++i) {
    const auto& [joint, component] = equations_.rows()[order[i]];
    names += fmt::format("{}{} along {}", names.empty() ? "" : ", ", system_.joints[joint].name,
                         system_.joints[joint].servo >= 0 ? "its coordinate" : component == 2 ? "its angle" : component == 0 ? "x" : "y");
  }
  remarks_.push_back(fmt::format("ideal joints: singular position at t = {:.6g} s; dependent there, with no unique reactions: {} (joint axes)", t, names));
}

}  // namespace pintle

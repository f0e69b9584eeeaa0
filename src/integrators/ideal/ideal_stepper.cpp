#include "integrators/ideal/ideal_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "integrators/dormand_prince.h"

namespace pintle {
namespace {

using S = Planar;
using namespace dormand_prince;

constexpr double kSingular = 1e-4;     // of the largest independence met: a position counts as singular below it
constexpr double kSuspicious = 0.5;    // of the largest: above it no singular position is looked for
constexpr int kSearch = 48;            // positions tried inside a step
constexpr double kPassing = 1e-2;      // of the usual step: at singular positions so short a step is taken in any case
constexpr double kCrossing = 0.1;      // of the tolerance times the usual step: so short a step is taken over a jump of a force
constexpr double kNearJump = 1e-4;     // of the usual step: rejected steps that are this short are looked at for jumps
constexpr double kForget = 0.99;       // of the usual step, by one that is shorter
constexpr double kLeastCrossing = 1e-8;  // of the usual step: shorter ones are lost in the rounding of velocities over the step
constexpr int kMostReported = 5;

}  // namespace

IdealStepper::IdealStepper(const System& system, double tolerance, Equations equations, const PenaltySettings& penalty)
    : system_(system), projects_(equations == Equations::kIdeal), tolerance_(tolerance), equations_(system, equations, penalty), dense_(system) {
  for (auto* k : {&kq_, &kv_})
    for (auto& x : *k) x.resize(system.bodies.size());
  scale_.body.assign(system.bodies.size(), S::Vec::Zero());
}

void IdealStepper::start(const State& state, double h) {
  end_ = state;
  h_ = smooth_h_ = h;
  const double before = system_.kinetic(end_.v);
  if (!(projects_ ? onto_constraints(end_) : close_loops(system_, end_) && equations_.complete(end_))) failure_ = "ideal joints cannot be closed at the start: the loops do not close, or the position is singular";
  if (projects_) equations_.measure_misfit(end_.t, end_.q);
  const double lost = before - system_.kinetic(end_.v);
  if (lost > 1e-6 * before)
    remarks_.push_back(fmt::format("ideal joints: the stated velocities are inconsistent; an impulse in the joints dissipates {:.3g} J at the start", lost));
  begin_ = inside_ = stage_ = end_;
  if (projects_) most_independent_ = equations_.independence(end_.t, end_.q);
  grow_scale();
}

bool IdealStepper::step(double t_end) {
  if (!failure_.empty()) return false;
  begin_ = end_;
  double h = max_step_ > 0 ? std::min(h_, max_step_) : h_;
  bool at_once = true, jump_ahead = false;
  const double rounding = std::numeric_limits<double>::epsilon() * std::abs(t_end);
  const double crossing_h = std::max(std::max(kCrossing * tolerance_, kLeastCrossing) * smooth_h_, 1e3 * rounding);
  while (true) {
    h = std::min(h, t_end - begin_.t);
    if (h <= 16 * rounding) {
      failure_ = fmt::format("ideal joints: the step size became too small at t = {:.9g} s{}", begin_.t,
                             equations_.nearly_singular() ? ", near a position where the constraints are not independent" : "");
      return false;
    }
    const double e = take_stages(h) ? error(h) / tolerance_ : std::numeric_limits<double>::infinity();
    const double factor = std::isfinite(e) ? std::clamp(0.9 * std::pow(std::max(e, 1e-10), -0.2), 0.2, 5.0) : 0.1;
    const bool passing = equations_.nearly_singular() && h < kPassing * usual_h_ && std::isfinite(e);
    const bool jumps = e > 1 && h < kNearJump * smooth_h_ && std::isfinite(e) && crosses_jump();
    jump_ahead = jump_ahead || jumps;
    // Over the jump; or up to where nothing but rounding is left of the way to it.
    const bool crossing = e > 1 && h < crossing_h && std::isfinite(e) && jump_ahead;
    if ((e <= 1 || passing || crossing) && finish(t_end - begin_.t - h < 1e-14 * t_end ? t_end : begin_.t + h, h)) {
      h_ = crossing ? kCrossing * smooth_h_ : h * (passing ? std::max(1.0, factor) : factor);
      if (at_once) smooth_h_ = std::max(h, kForget * smooth_h_);  // steps that come to a jump nearer and nearer are short because of it
      if (!equations_.nearly_singular() && !crossing) usual_h_ = h;
      return true;
    }
    ++counters_.rejected;
    at_once = false;
    h *= std::min(factor, 0.5);
  }
}

// The embedded error of a jump does not fall with the step; what it does to velocities does.
bool IdealStepper::crosses_jump() const {
  if (!system_.has_branches()) return false;
  const auto side = [this](const State& state) {
    std::vector<S::Motion> m;
    system_.motions(state.q, state.v, m);
    std::vector<double> value(system_.switching_functions().size());
    system_.find_switching(state.t, m, state.gap, state.gap_rate, state.law_state, state.sliding, value.data());
    return value;
  };
  return !same_sides(side(begin_), side(stage_));
}

bool IdealStepper::take_stages(double h) {
  kq_[0] = begin_.v;
  kv_[0] = begin_.a;
  power_[0] = {begin_.supply_power, begin_.loss_power};
  for (int s = 1; s < kStages; ++s) {
    stage_.t = begin_.t + kC[s] * h;
    for (std::size_t i = 0; i < stage_.q.size(); ++i) {
      S::Vec q = S::Vec::Zero(), v = S::Vec::Zero();
      for (int k = 0; k < s; ++k) {
        q += kA[s][k] * kq_[k][i];
        v += kA[s][k] * kv_[k][i];
      }
      stage_.q[i] = begin_.q[i] + h * q;
      stage_.v[i] = begin_.v[i] + h * v;
    }
    ++counters_.evaluations;
    ++counters_.factorizations;
    if (!equations_.complete(stage_)) return false;
    kq_[s] = stage_.v;
    kv_[s] = stage_.a;
    power_[s] = {stage_.supply_power, stage_.loss_power};
  }
  return true;
}

bool IdealStepper::onto_constraints(State& state) {
  return equations_.close_positions(state.t, state.q) && equations_.close_velocities(state.t, state.q, state.v) && equations_.complete(state);
}

// The last stage stands at the end of the step; from there onto the constraints, but where branches of the motion meet: the
// nearest point may be on the wrong one.
bool IdealStepper::finish(double t, double h) {
  end_.t = t;
  end_.q = stage_.q;
  end_.v = stage_.v;
  if (projects_ && !equations_.nearly_singular() ? !onto_constraints(end_) : !equations_.complete(end_)) return false;
  end_.supplied = begin_.supplied;
  end_.dissipated = begin_.dissipated;
  for (int s = 0; s < kStages - 1; ++s) {
    end_.supplied += h * kA[kStages - 1][s] * power_[s][0];
    end_.dissipated += h * kA[kStages - 1][s] * power_[s][1];
  }
  ++counters_.steps;
  grow_scale();
  if (projects_) look_for_singular_position();
  else equations_.measure_violation();
  return true;
}

// The embedded error as load: what would give it as an acceleration over the step, over the loads of the body.
double IdealStepper::error(double h) const {
  double worst = 0;
  for (int i = 0; i < system_.n_bodies(); ++i) {
    S::Vec dq = S::Vec::Zero(), dv = S::Vec::Zero();
    for (int s = 0; s < kStages; ++s) {
      dq += kE[s] * kq_[s][i];
      dv += kE[s] * kv_[s][i];
    }
    const S::Vec load = scale_.body[i].cwiseQuotient(system_.bodies[i].mass);
    const S::Vec d = dv.cwiseAbs().cwiseMax((dq / h).cwiseAbs()).cwiseQuotient(load);
    worst = std::max(worst, d.maxCoeff());
    if (!std::isfinite(d.sum())) return std::numeric_limits<double>::infinity();
  }
  return worst;
}

void IdealStepper::grow_scale() {
  constexpr double kNegligible = 1e-4;  // of the largest load of the mechanism
  double largest = 0;
  for (int i = 0; i < system_.n_bodies(); ++i) largest = std::max({largest, scale_.body[i][0], system_.bodies[i].mass[0] * end_.a[i].head<2>().norm()});
  largest = std::max(largest, largest_force(end_.force));
  for (int i = 0; i < system_.n_bodies(); ++i) {
    const S::Vec& mass = system_.bodies[i].mass;
    const S::Vec load = mass.cwiseProduct(end_.a[i]).cwiseAbs() + system_.bodies[i].gravity.cwiseAbs();
    const double least = std::max(1e-9 * mass[0], kNegligible * largest);
    const double force = std::max({scale_.body[i][0], load[0], load[1], least});
    scale_.body[i] << force, force, std::max({scale_.body[i][2], load[2], 1e-3 * force * system_.bodies[i].radius_of_gyration()});
  }
  for (int j = 0; j < system_.n_joints(); ++j)
    for (const int body : {system_.joints[j].at.a, system_.joints[j].at.b}) {
      if (body == kGround) continue;
      const double force = std::max(scale_.body[body][0], end_.force[j].head<2>().norm());
      scale_.body[body] << force, force, std::max(scale_.body[body][2], std::abs(end_.force[j][2]));
    }
}

const State& IdealStepper::interpolate(double t) {
  inside_ = dense_.at(t, begin_, end_);
  if (!projects_ || (equations_.independence(t, inside_.q) > 0 && equations_.nearly_singular())) equations_.complete(inside_);
  else onto_constraints(inside_);
  return inside_;
}

std::vector<std::string> IdealStepper::remarks() const {
  std::vector<std::string> all = remarks_;
  if (!projects_) all.push_back(equations_.violation_text("penalties"));
  return all;
}

// A position where the constraints lose rank may lie inside the step: their independence falls towards it and grows after it.
void IdealStepper::look_for_singular_position() {
  const auto at = [&](double share) {
    const double t = begin_.t + share * (end_.t - begin_.t);
    return equations_.independence(t, share <= 0 ? begin_.q : share >= 1 ? end_.q : dense_.at(t, begin_, end_).q);
  };
  constexpr double kNear = 1e-3;
  const double first = at(0), last = at(1);
  most_independent_ = std::max(most_independent_, last);
  if (std::min(first, last) > kSuspicious * most_independent_) return;
  if (!(at(kNear) < first) || !(at(1 - kNear) < last)) return;
  double low = 0, high = 1;
  for (int i = 0; i < kSearch && high - low > 1e-12; ++i) {
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

#include "integrators/relative/tree_dopri5.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cubic_hermite.h"
#include "integrators/dormand_prince.h"
#include "integrators/load_scale.h"
#include "integrators/thresholds.h"

namespace pintle {
namespace {

using namespace dormand_prince;
using Eigen::Index;
using Eigen::VectorXd;
using S = Planar;

// x and its first derivative at fraction s of a step, on the quintic through value, first and second derivative at both ends.
void quintic(double s, double h, const std::array<const VectorXd*, 3>& begin, const std::array<const VectorXd*, 3>& end, VectorXd& x, VectorXd& v) {
  const double s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  const VectorXd d = *end[0] - *begin[0] - h * *begin[1] - 0.5 * h * h * *begin[2];
  const VectorXd dv = h * (*end[1] - *begin[1]) - h * h * *begin[2], da = h * h * (*end[2] - *begin[2]);
  const VectorXd c3 = 10 * d - 4 * dv + 0.5 * da, c4 = -15 * d + 7 * dv - da, c5 = 6 * d - 3 * dv + 0.5 * da;
  x = *begin[0] + s * h * *begin[1] + 0.5 * s2 * h * h * *begin[2] + s3 * c3 + s4 * c4 + s4 * s * c5;
  v = *begin[1] + s * h * *begin[2] + (3 * s2 * c3 + 4 * s3 * c4 + 5 * s4 * c5) / h;
}

}  // namespace

TreeDopri5::TreeDopri5(const System& system, double tolerance)
    : system_(system), borders_(system), tree_(std::make_unique<JointTree>(system)), tolerance_(tolerance), at_(system, *tree_) {
  scale_.body.assign(system.bodies.size(), S::Vec::Zero());
}

void TreeDopri5::complete(TreeState& state) {
  at_.place(state.t, state.y, state.u);
  at_.gaps(state.gap);
  at_.rates(state.rate);
  at_.forces(state, state.force, state.law_rate);
  tree_->mass(at_.pose(), mass_matrix_);
  mass_.compute(mass_matrix_);
  at_.accelerate(VectorXd::Zero(tree_->n()));
  at_.imbalance(state.force, state.w);
  state.w = mass_.solve(-state.w);
}

void TreeDopri5::write(TreeState& at, State& state) {
  at_.accelerate(at.w);
  at_.gap_accelerations(at.accel);
  at_.write(at, at.w, state);
  const auto [supplied, lost] = at_.power(at);
  state.supply_power = supplied;
  state.loss_power = lost;
}

void TreeDopri5::start(const State& state, double h) {
  end_state_ = state;
  h_ = h;
  read_coordinates(*tree_, state, end_);
  end_.law_state = state.law_state;
  complete(end_);
  write(end_, end_state_);
  borders_.start(end_state_);
  rounding_ = loads_above_rounding(system_, tree_->laws(), end_state_, tolerance_);
  raise_scale();
}

void TreeDopri5::raise_scale() {
  grow_load_scale(system_, at_.pose().m, at_.Q(), end_state_, scale_);
  raise_above(rounding_, scale_);
}

bool TreeDopri5::step(double t_end) {
  begin_ = end_;
  begin_state_ = end_state_;
  double h = max_step_ > 0 ? std::min(h_, max_step_) : h_;
  ky_[0] = begin_.u;
  ku_[0] = begin_.w;
  kz_[0] = begin_.law_rate;
  borders_.begin_step();
  while (true) {
    h = std::min(h, t_end - begin_.t);
    if (h <= kLastBits * std::abs(t_end)) {
      failure_ = fmt::format("the step size became too small at t = {:.9g} s", begin_.t);
      return false;
    }
    for (int s = 1; s < 7; ++s) {
      stage_.y = begin_.y;
      stage_.u = begin_.u;
      for (int k = 0; k < s; ++k) {
        stage_.y += h * kA[s][k] * ky_[k];
        stage_.u += h * kA[s][k] * ku_[k];
      }
      stage_.law_state = begin_.law_state;
      for (std::size_t z = 0; z < stage_.law_state.size(); ++z)
        for (int k = 0; k < s; ++k) stage_.law_state[z] += h * kA[s][k] * kz_[k][z];
      stage_.t = begin_.t + kC[s] * h;
      complete(stage_);
      ky_[s] = stage_.u;
      ku_[s] = stage_.w;
      kz_[s] = stage_.law_rate;
      ++counters_.evaluations;
    }
    const double e = error(h) / tolerance_;
    const double factor = step_ratio(e);
    if (is_accepted(e, h, t_end)) {
      end_ = stage_;
      end_.t = end_of_step(begin_.t, h, t_end);
      write(end_, end_state_);
      if (borders_.shorten(end_state_, h)) {
        ++counters_.rejected;
        continue;
      }
      end_state_.dissipated = begin_state_.dissipated + 0.5 * h * (begin_state_.loss_power + end_state_.loss_power);
      end_state_.supplied = begin_state_.supplied + 0.5 * h * (begin_state_.supply_power + end_state_.supply_power);
      if (borders_.cross(end_state_)) {
        before_event_ = end_;
        end_.law_state = end_state_.law_state;
        complete(end_);
        write(end_, end_state_);
        borders_.record(end_state_);
      }
      raise_scale();
      ++counters_.steps;
      h_ = borders_.has_shortened() ? std::max(h_, h * factor) : h * factor;
      return true;
    }
    ++counters_.rejected;
    h *= std::min(factor, 0.8);
  }
}

// The embedded error as joint force and as body force, relative to the loads; the instant is at the end of the step.
double TreeDopri5::error(double h) {
  VectorXd dy = VectorXd::Zero(tree_->n()), du = dy;
  for (int s = 0; s < 7; ++s) {
    dy += kE[s] * h * ky_[s];
    du += kE[s] * h * ku_[s];
  }
  at_.find_matrices();
  const VectorXd gap = at_.A() * dy, rate = at_.A() * du, of_bodies = at_.J() * du;
  if (!gap.allFinite() || !rate.allFinite() || !of_bodies.allFinite()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t l = 0; l < tree_->laws().size(); ++l) {
    const Placement& at = system_.joints[tree_->laws()[l]].at;
    const Index i = 3 * static_cast<Index>(l);
    const S::Vec largest = load_on(at, scale_);
    LawTangents law;
    at_.linearize(static_cast<int>(l), stage_, law);
    S::Vec df = law.stiffness * gap.segment<3>(i) + law.damping * rate.segment<3>(i);
    for (int z = 0; z < law.n; ++z)
      for (int s = 0; s < 7; ++s)
        for (int k = 0; k < 3; ++k) df[k] -= law.force_by_state[k][z] * kE[s] * h * kz_[s][system_.joints[tree_->laws()[l]].first_state + z];
    worst = std::max({worst, df.head<2>().norm() / largest[0], std::abs(df[2]) / largest[2]});
  }
  return std::max(worst, over_loads(system_, of_bodies, scale_) / h);
}

// Quintic curves through both ends, for coordinates and for gaps. Every vibration is resolved, so the forces follow from the
// laws at these gaps.
const State& TreeDopri5::interpolate(double t) {
  if (t == end_.t) return end_state_;
  if (t == begin_.t) return begin_state_;
  const TreeState& end = borders_.crossed() ? before_event_ : end_;
  const State& end_state = state_before_event();
  const double h = end.t - begin_.t, s = (t - begin_.t) / h;
  TreeState now;
  now.t = t;
  quintic(s, h, {&begin_.y, &begin_.u, &begin_.w}, {&end.y, &end.u, &end.w}, now.y, now.u);
  now.law_state = begin_.law_state;
  for (std::size_t z = 0; z < now.law_state.size(); ++z)
    now.law_state[z] = cubic_hermite(s, h, begin_.law_state[z], begin_.law_rate[z], end.law_state[z], end.law_rate[z]);
  complete(now);
  quintic(s, h, {&begin_.gap, &begin_.rate, &begin_.accel}, {&end.gap, &end.rate, &end.accel}, now.gap, now.rate);
  for (std::size_t l = 0; l < tree_->laws().size(); ++l) {
    if (!has_slip(system_.joints[tree_->laws()[l]].displacement)) continue;
    const Eigen::Index i = 3 * static_cast<Eigen::Index>(l) + kSlip;  // the slip of surfaces is not a state: only its rate counts
    now.rate[i] = cubic_hermite(s, h, begin_.rate[i], begin_.accel[i], end.rate[i], end.accel[i]);
  }
  at_.forces(now, now.force, now.law_rate);
  at_.accelerate(VectorXd::Zero(tree_->n()));
  at_.imbalance(now.force, now.w);
  now.w = mass_.solve(-now.w);
  write(now, inside_state_);
  inside_state_.dissipated = cubic_hermite(s, h, begin_state_.dissipated, begin_state_.loss_power, end_state.dissipated, end_state.loss_power);
  inside_state_.supplied = cubic_hermite(s, h, begin_state_.supplied, begin_state_.supply_power, end_state.supplied, end_state.supply_power);
  return inside_state_;
}

}  // namespace pintle

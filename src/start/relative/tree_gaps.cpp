#include "start/relative/tree_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/inverse_dynamics.h"
#include "integrators/thresholds.h"

namespace pintle {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using S = Planar;

constexpr int kClosing = 4, kClosingRates = 2;  // passes onto given gaps, whose directions change on the way, and onto given rates

double largest_size(const VectorXd& x) { return x.size() == 0 ? 0 : x.cwiseAbs().maxCoeff(); }

const Law& law_of(const TreeInstant& at, std::size_t l) { return at.system().joints[at.tree().laws()[l]].law; }

// That of the joint to which it is lowest. As for free bodies, and not over the motions of the tree: some of these hardly move a gap, and next to their
// frequencies gaps that no motion can close would look as if one could.
double slowest_joint(const TreeInstant& at) {
  double slowest = std::numeric_limits<double>::infinity();
  for (std::size_t l = 0; l < at.tree().laws().size(); ++l)
    slowest = std::min(slowest, lowest_own_frequency(at.system(), at.system().joints[at.tree().laws()[l]], at.kinematics(static_cast<int>(l))));
  return slowest;
}

}  // namespace

void TreeGaps::set_gaps_from_bodies(TreeState& state) {
  at_.place(state.t, state.y, state.u);
  at_.gaps(state.gap);
  at_.rates(state.rate);
  at_.rest(state);
  at_.forces(state, state.force, state.law_rate);
  state.accel = VectorXd::Zero(state.gap.size());
}

void TreeGaps::move_onto_gaps(TreeState& state) {
  at_.place(state.t, state.y, state.u);
  at_.find_matrices();
  const double mu = held_above(at_.system(), slowest_joint(at_), at_.Q(), at_.pose().q);
  if (!std::isfinite(mu) || !(mu > 0) || !projector_.prepare(at_, mu, state, TreeProjector::Laws::kHolding)) return;
  VectorXd now;
  for (int pass = 0; pass < kClosing; ++pass) {
    at_.gaps(now, &state);
    state.y += projector_.close(state.gap - now);
    at_.place(state.t, state.y, state.u);
  }
  for (int pass = 0; pass < kClosingRates; ++pass) {
    at_.rates(now);
    state.u += projector_.close(state.rate - now);
    at_.place(state.t, state.y, state.u);
  }
}

// As balance_start: gaps that the bodies cannot assume, as in redundant joints, follow from their positions and
// velocities.
void TreeGaps::balance(TreeState& state) {
  at_.place(state.t, state.y, state.u);
  const double rounding = kLastBits * largest_coordinate(at_.pose().q), same_rate = kFits * largest_size(state.u), same_force = kFits * largest_size(state.force);
  VectorXd now, now_rate;
  at_.gaps(now);
  at_.rates(now_rate);
  for (Index i = 0; i < now.size(); ++i) {
    const BasicLaw<S>& law = law_of(at_, static_cast<std::size_t>(i / 3));
    const bool held = law.engaged_stiffness()[i % 3] > 0;
    const Index first = i - i % 3;
    const double misfit_of_rate = std::abs(now_rate[i] - state.rate[i]), damping = respond(law, S::Vec(state.gap.segment<3>(first)), S::Vec(state.rate.segment<3>(first))).damping(i % 3, i % 3);
    if (!held || (misfit_of_rate > same_rate && damping * misfit_of_rate > same_force)) state.rate[i] = now_rate[i];
    if (!held || std::abs(now[i] - state.gap[i]) > rounding) state.gap[i] = now[i];
  }
  at_.rest(state);
  at_.forces(state, state.force, state.law_rate);
  if (!projector_.prepare(at_, 1, state)) return;
  projector_.accelerations(at_, state.force, state.w);
  at_.accelerate(state.w);
  at_.gap_accelerations(state.accel);
}

}  // namespace pintle

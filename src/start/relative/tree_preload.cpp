#include "start/relative/tree_preload.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dynamics/inverse_dynamics.h"
#include "integrators/thresholds.h"
#include "laws/gap_at_force.h"
#include "linalg/chebyshev_nodes.h"
#include "start/preload.h"
#include "start/slow_manifold.h"

namespace pintle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using S = Planar;

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

bool TreeInverseDynamics::prepare(const TreeState& state) {
  at_.place(state.t, state.y, state.u);
  at_.find_matrices();
  const double mu = held_above(at_.system(), slowest_joint(at_), at_.Q(), at_.pose().q);
  return std::isfinite(mu) && mu > 0 && projector_.prepare(at_, mu, state, TreeProjector::Laws::kHolding);
}

bool TreeInverseDynamics::find(TreeState& state) {
  if (!prepare(state)) return false;
  const bool rubs = push_by_friction(state);
  for (int pass = 0; pass < 2; ++pass) projector_.balance(at_, state.accel, true, state.force, state.w);
  for (int round = 1; rubs && round < kFrictionRounds; ++round) {
    find_gaps(state);
    push_by_friction(state);
    projector_.balance(at_, state.accel, true, state.force, state.w);
  }
  return true;
}

// theory/assembly Eq. (3.5). Returns whether there is any friction.
bool TreeInverseDynamics::push_by_friction(TreeState& state) {
  bool any = false;
  VectorXd now, now_rate;
  for (std::size_t l = 0; l < at_.tree().laws().size(); ++l) {
    const JointData& joint = at_.system().joints[at_.tree().laws()[l]];
    if (!joint.law.rubs()) continue;
    if (!any) {
      at_.gaps(now);
      at_.rates(now_rate);
    }
    any = true;
    const Index i = 3 * static_cast<Index>(l);
    S::Vec gap = state.gap.segment<3>(i), rate = state.rate.segment<3>(i);
    for (int k = 0; k < 3; ++k)
      if (!joint.held[k]) {
        gap[k] = now[i + k];
        rate[k] = now_rate[i + k];
      }
    double states[kMostLawStates];
    joint.law.rest({state.t, gap, rate, states}, states);
    const S::Vec force = joint.law.force({state.t, gap, rate, states});
    for (int k = 0; k < 3; ++k)
      if (!joint.held[k]) state.force[i + k] = force[k];
  }
  return any;
}

bool TreeInverseDynamics::find_gaps(TreeState& state) const {
  bool carried = true;
  for (std::size_t l = 0; l < at_.tree().laws().size(); ++l) {
    const Index i = 3 * static_cast<Index>(l);
    S::Vec gap = state.gap.segment<3>(i);
    carried = gap_at_force(law_of(at_, l), state.force.segment<3>(i), state.rate.segment<3>(i), gap) && carried;
    state.gap.segment<3>(i) = gap;
  }
  return carried;
}

void TreeInverseDynamics::move_onto_gaps(TreeState& state) {
  if (!prepare(state)) return;
  VectorXd now;
  for (int pass = 0; pass < 4; ++pass) {
    at_.gaps(now, &state);
    state.y += projector_.close(state.gap - now);
    at_.place(state.t, state.y, state.u);
  }
  for (int pass = 0; pass < 2; ++pass) {
    at_.rates(now);
    state.u += projector_.close(state.rate - now);
    at_.place(state.t, state.y, state.u);
  }
}

// As balance_start: gaps that the bodies cannot assume, as in redundant joints, follow from their positions and
// velocities.
void TreeInverseDynamics::balance(TreeState& state) {
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

void start_tree_forces(TreeInverseDynamics& forces, bool preload, TreeState& state) {
  TreeInstant& at = forces.instant();
  at.place(state.t, state.y, state.u);
  at.gaps(state.gap);
  at.rates(state.rate);
  at.rest(state);
  at.forces(state, state.force, state.law_rate);
  state.accel = VectorXd::Zero(state.gap.size());
  if (preload) {
    state.rate.setZero();
    for (int pass = 0; pass < kPreloadPasses; ++pass) {
      if (!forces.find(state)) break;
      forces.find_gaps(state);
      forces.move_onto_gaps(state);
    }
  }
  forces.balance(state);
}

namespace {

// The slow motion from `start` over `span`: each curve has one column per node.
class TreeSlowManifold {
 public:
  TreeSlowManifold(const System& system, const JointTree& tree, double span, const TreeState& start)
      : span_(span), start_(start), forces_(system, tree), gap_(MatrixXd::Zero(start.gap.size(), ChebyshevNodes::kN)), rate_(gap_), accel_(gap_),
        force_of_gap_(start.gap.size(), start.gap.size()) {
    force_of_gap_.setZero();
    for (std::size_t l = 0; l < tree.laws().size(); ++l) {
      const Index i = 3 * static_cast<Index>(l);
      force_of_gap_.block<3, 3>(i, i) = respond(law_of(forces_.instant(), l), start.gap.segment<3>(i), start.rate.segment<3>(i)).stiffness;
    }
  }

  // Follows the motion with the present gap accelerations, and takes new gaps from the forces that it needs. Returns
  // their relative change.
  double sweep() {
    TreeState at = start_;
    at.gap = gap_.col(0);
    at.rate = rate_.col(0);
    at.accel = accel_.col(0);
    if (swept_) forces_.move_onto_gaps(at);
    MatrixXd next = gap_;
    for (int node = 0; node < ChebyshevNodes::kN; ++node) {
      if (node > 0) follow(at, nodes_.x[node - 1], nodes_.x[node]);
      at.accel = accel_.col(node);
      at.rate = rate_.col(node);
      if (!forces_.find(at) || !forces_.find_gaps(at)) return kDiverged;
      if (!at.gap.allFinite()) return kDiverged;
      next.col(node) = at.gap;
    }
    double change = 0, size = 1e-300;
    for (Index i = 0; i < next.rows(); i += 3)
      for (Index node = 0; node < next.cols(); ++node) {
        change = std::max(change, (force_of_gap_ * (next - gap_)).col(node).segment<3>(i).norm());
        size = std::max(size, (force_of_gap_ * next).col(node).segment<3>(i).norm());
      }
    gap_ = next;
    rate_ = gap_ * nodes_.D.transpose() / span_;
    accel_ = rate_ * nodes_.D.transpose() / span_;
    swept_ = true;
    return change / size;
  }

  bool write_start(TreeState& state) {
    state.gap = gap_.col(0);
    state.rate = rate_.col(0);
    state.accel = accel_.col(0);
    forces_.move_onto_gaps(state);
    forces_.balance(state);
    return state.y.allFinite() && state.u.allFinite() && state.w.allFinite() && state.force.allFinite();
  }

 private:
  // One classical Runge-Kutta step of the motion with given gap accelerations.
  void follow(TreeState& at, double s0, double s1) {
    const double h = span_ * (s1 - s0);
    const TreeState begin = at;
    std::array<VectorXd, 4> ky, ku;
    constexpr std::array<double, 4> c{0, 0.5, 0.5, 1};
    for (int stage = 0; stage < 4; ++stage) {
      TreeState now = begin;
      now.t = start_.t + span_ * s0 + c[stage] * h;
      if (stage > 0) {
        now.y += c[stage] * h * ky[stage - 1];
        now.u += c[stage] * h * ku[stage - 1];
      }
      now.accel = accel_ * nodes_.weights(s0 + c[stage] * (s1 - s0));
      forces_.find(now);
      ky[stage] = now.u;
      ku[stage] = now.w;
    }
    at.t = start_.t + span_ * s1;
    at.y += h / 6 * (ky[0] + 2 * ky[1] + 2 * ky[2] + ky[3]);
    at.u += h / 6 * (ku[0] + 2 * ku[1] + 2 * ku[2] + ku[3]);
  }

  double span_;
  const TreeState& start_;
  TreeInverseDynamics forces_;
  ChebyshevNodes nodes_;
  MatrixXd gap_, rate_, accel_, force_of_gap_;
  bool swept_ = false;
};

}  // namespace

double move_tree_onto_slow_manifold(const System& system, const JointTree& tree, double span, TreeState& state) {
  TreeSlowManifold motion(system, tree, span, state);
  return sweep_onto(motion, state);
}

}  // namespace pintle

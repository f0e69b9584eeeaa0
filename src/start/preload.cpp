#include "start/preload.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "integrators/thresholds.h"
#include "kinematics/position_search.h"
#include "system/size_about_origin.h"

namespace pintle {
namespace {

constexpr double kAbsurd = 100;  // ratio of the largest forces of two passes: the passes diverge, whatever the gaps. Starts that converge grow by 3 (four leaf springs in a row), those that do not by 2600 (five): with 50 and with 200 these give up after the same 2 s instead of 24 s

// Springs replace laws that give no force where the joints are; joints that start free or touch nothing are left alone.
template <class S>
std::optional<BasicSystem<S>> with_springs_for_play(const BasicSystem<S>& system, const BasicState<S>& state) {
  const double size = largest_coordinate(state.q);
  std::vector<int> open;
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicLaw<S>& law = system.joints[j].law;
    if (!law.ideal_limit() && !law.starts_free() && !is_open_contact(law, state.gap[j], size) && is_in_play(law, state.gap[j], state.gap_rate[j])) open.push_back(j);
  }
  return with_springs(system, open);
}

// A joint that starts free but is at the border of its law to roundoff, such as a rope that is taut without load, counts as taut: it may carry load.
template <class S>
void tauten(const BasicSystem<S>& system, BasicState<S>& state) {
  const double rounding = kLastBits * largest_coordinate(state.q);
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicLaw<S>& law = system.joints[j].law;
    if (!is_apart(law, state.gap[j], state.gap_rate[j])) continue;
    const typename S::Vec engaged = law.engaged_stiffness();
    for (int k = 0; k < S::kDof; ++k)
      for (const double way : {rounding, -rounding}) {
        typename S::Vec gap = state.gap[j];
        gap[k] += way;
        if (engaged[k] > 0 && respond(law, gap, state.gap_rate[j]).stiffness(k, k) >= engaged[k]) state.gap[j] = gap;
      }
  }
}

// Components of taut ropes and belts that would have to push, which no gap makes them do: they become loads that follow from the bodies' positions.
template <class S>
struct OneSided {
  VecsOf<S> left, slack;  // 1 in such components; 1 in those of them without pretension, which carry nothing

  // Adds the components that the forces found require to push: all with pretension, and of the others the one with the largest push. Returns whether
  // there is any.
  bool add(const BasicSystem<S>& system, const BasicState<S>& taut, const BasicState<S>& found) {
    const double nothing = kFits * largest_force(found.force);
    double most = nothing;
    bool any = false;
    std::optional<std::pair<int, int>> most_asked;
    for (int j = 0; j < system.n_joints(); ++j) {
      const BasicLaw<S>& law = system.joints[j].law;
      if (law.ideal_limit() || !law.starts_free()) continue;
      const BasicResponse<S> stands = respond(law, taut.gap[j], taut.gap_rate[j]), now = respond(law, found.gap[j], found.gap_rate[j]);
      for (int k = 0; k < S::kDof; ++k) {
        const double asked = std::abs(found.force[j][k]);
        if (left[j][k] != 0 || !(stands.stiffness(k, k) > 0) || now.stiffness(k, k) > 0 || !(asked > nothing)) continue;
        if (std::abs(stands.force[k]) > nothing) {
          left[j][k] = 1;
          any = true;
        } else if (asked > most) {
          most = asked;
          most_asked = {j, k};
        }
      }
    }
    if (most_asked) left[most_asked->first][most_asked->second] = slack[most_asked->first][most_asked->second] = 1;
    return any || most_asked;
  }
};

template <class S>
void plain_start(const BasicSystem<S>& system, BasicState<S>& state) {
  std::vector<typename S::Motion> m;
  std::vector<BasicJointKinematics<S>> r;
  system.motions(state.q, state.v, m);
  system.joint_kinematics(state.t, m, r);
  for (int j = 0; j < system.n_joints(); ++j) {
    state.gap[j] = r[j].gap;
    state.gap_rate[j] = r[j].rate;
  }
  rest_laws(system, state);
  system.accelerations(state.t, state.q, state.v, state.a, state.law_state.data());
  find_joint_forces(system, state);
  find_gap_accelerations(system, r, state);
}

// The gaps of the passes below are those of a fixed-point iteration, which contracts by the ratio of the stiffness that the loads have, as springs, to that of the joints which
// carry the rest. D. G. Anderson's acceleration (J. ACM 12 (1965) 547-560) also finds the fixed point of an iteration that does not contract, as where a motor is softer than the
// spring beside it. theory/assembly Eq. (3.8)
template <class S>
class GapAcceleration {
 public:
  // `before`: the gaps of a pass; `next`: those that it has found for the next one, for which better ones are found; `weight`: force per gap.
  void improve(const VecsOf<S>& before, const VecsOf<S>& weight, VecsOf<S>& next) {
    const Eigen::Index n = static_cast<Eigen::Index>(next.size()) * S::kDof;
    Eigen::VectorXd found(n), change(n);
    for (std::size_t j = 0; j < next.size(); ++j)
      for (int k = 0; k < S::kDof; ++k) {
        const Eigen::Index i = static_cast<Eigen::Index>(j) * S::kDof + k;
        found[i] = next[j][k];
        change[i] = weight[j][k] * (next[j][k] - before[j][k]);
      }
    if (passes_++ == 0) {  // a small step shows how the iteration responds, where a whole one might lead to another position
      for (std::size_t j = 0; j < next.size(); ++j) next[j] = before[j] + kFirst * (next[j] - before[j]);
    } else {
      add_column(change - change_, changes_);
      add_column(found - found_, founds_);
      const Eigen::VectorXd part = changes_.colPivHouseholderQr().solve(change);
      const Eigen::VectorXd better = found - founds_ * part;
      for (std::size_t j = 0; j < next.size(); ++j)
        for (int k = 0; k < S::kDof; ++k) next[j][k] = better[static_cast<Eigen::Index>(j) * S::kDof + k];
    }
    found_ = std::move(found);
    change_ = std::move(change);
  }

 private:
  static constexpr Eigen::Index kMemory = 5;  // passes that are combined. With 3 or 10, 3 of 45 starts beside springs take half the steps or twice as many
  static constexpr double kFirst = 1e-3;      // part of the first change that is made. With half and with twice 45 starts beside springs differ by less than 25 % in steps; with all of it a lever on a preloaded spring starts 10 turns away

  static void add_column(const Eigen::VectorXd& column, Eigen::MatrixXd& columns) {
    const Eigen::Index keep = std::min(columns.cols(), kMemory - 1);
    Eigen::MatrixXd all(column.size(), keep + 1);
    if (keep > 0) all.leftCols(keep) = columns.rightCols(keep);
    all.col(keep) = column;
    columns = std::move(all);
  }

  int passes_ = 0;
  Eigen::VectorXd found_, change_;  // by the last pass
  Eigen::MatrixXd founds_, changes_;
};

// The largest change of a gap, in units of the force that it causes, relative to the largest force. `weight`: set to force per gap.
template <class S>
double change_of_gaps(const BasicSystem<S>& system, const BasicState<S>& before, const BasicState<S>& state, VecsOf<S>& weight) {
  double change = 0;
  for (int j = 0; j < system.n_joints(); ++j) {
    weight[j] = respond(system.joints[j].law, state.gap[j], state.gap_rate[j]).stiffness.diagonal();
    change = std::max(change, weight[j].cwiseProduct(state.gap[j] - before.gap[j]).template head<S::kDim>().cwiseAbs().maxCoeff());
    change = std::max(change, weight[j].cwiseProduct(state.gap[j] - before.gap[j]).template tail<S::kDof - S::kDim>().cwiseAbs().maxCoeff());
  }
  return change / std::max(largest_force(state.force), 1e-300);
}

}  // namespace

template <class S>
bool moves_too_far(const BasicSystem<S>& system, const BasicState<S>& from, const BasicState<S>& to) {
  const double size = size_about_origin(system, from.q);
  for (std::size_t i = 0; i < from.q.size(); ++i) {
    const typename S::Vec way = S::difference(from.q[i], to.q[i]);
    if (!(way.template head<S::kDim>().norm() <= size && way.template tail<S::kDof - S::kDim>().norm() <= std::numbers::pi)) return true;
  }
  return false;
}

// Gaps without stiffness are taken from the positions. So are gaps that the bodies cannot assume, as in redundant joints: otherwise
// the first step would find gaps and forces other than those in the first row. theory/time Eq. (4.3).
template <class S>
void balance_start(const BasicSystem<S>& system, BasicState<S>& state) {
  std::vector<typename S::Motion> m;
  std::vector<BasicJointKinematics<S>> r;
  system.motions(state.q, state.v, m);
  system.joint_kinematics(state.t, m, r);
  const double same_gap = kLastBits * largest_coordinate(state.q), same_rate = kFits * largest_coordinate(state.v), same_force = kFits * largest_force(state.force);
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[j];
    const BasicResponse<S> response = respond(joint.law, state.gap[j], state.gap_rate[j]);
    const typename S::Vec mobility = system.own_mobility(joint.at, r[j]);
    for (int k = 0; k < S::kDof; ++k) {
      const double stiffness = response.stiffness(k, k), misfit = std::abs(r[j].gap[k] - state.gap[j][k]);
      const double misfit_of_rate = std::abs(r[j].rate[k] - state.gap_rate[j][k]);
      if (!(stiffness > 0) || (misfit > same_gap && stiffness * misfit > same_force)) state.gap[j][k] = r[j].gap[k];
      const double ringing = mobility[k] > 0 ? std::sqrt(stiffness / mobility[k]) : 0;  // force per rate
      if (!(stiffness > 0) || (misfit_of_rate > same_rate && std::max(response.damping(k, k), ringing) * misfit_of_rate > same_force)) state.gap_rate[j][k] = r[j].rate[k];
    }
  }
  rest_laws(system, state);
  find_joint_forces(system, state);
  find_accelerations(system, m, r, state);
}

namespace {

// Deflects the joints of the unloaded mechanism until they carry its loads, in passes that find the forces and then the gaps. Returns how far the last pass has changed the gaps,
// as a fraction of the largest force; infinity where passes diverge.
template <class S>
double deflect(const BasicSystem<S>& system, const BasicState<S>& unloaded, GapAcceleration<S>* acceleration, BasicState<S>& state) {
  const std::size_t joints = system.joints.size();
  state = unloaded;
  for (auto& x : state.gap_rate) x.setZero();
  for (auto& x : state.gap_accel) x.setZero();
  tauten(system, state);
  BasicInverseDynamics<S> forces(system);
  forces.linearize_redundant_laws(state);
  const std::optional<BasicSystem<S>> firm = with_springs_for_play(system, state);
  bool fits = true;
  OneSided<S> one_sided{VecsOf<S>(joints, S::Vec::Zero()), VecsOf<S>(joints, S::Vec::Zero())};
  const BasicState<S> taut = state;
  const bool starts_free = std::any_of(system.joints.begin(), system.joints.end(), [](const BasicJointData<S>& joint) { return joint.law.starts_free(); });
  double last_found = 0;  // largest force of the previous pass
  double change = 0, least = std::numeric_limits<double>::infinity();
  BasicState<S> best;  // of the accelerated passes, with the least change
  if (acceleration != nullptr) best = unloaded;
  VecsOf<S> weight(joints);
  for (int pass = 0; pass < (fits && acceleration == nullptr ? kPreloadPasses : kRedundantPasses); ++pass) {
    const BasicState<S> before = state;
    if (pass == 0 && firm) {
      if (!BasicInverseDynamics<S>(*firm).find(state)) break;
      forces.find_accelerations(state);  // and where the bodies are
    } else if (!forces.find(state)) {
      break;
    }
    const double found = largest_force(state.force), found_before = std::exchange(last_found, found);
    // The gaps of absurd forces are costly to find, and only for one-sided joints of any use.
    const bool may_diverge = acceleration == nullptr && pass > (firm ? 1 : 0);
    const bool absurd = !starts_free && may_diverge && found > kAbsurd * found_before;
    const bool grows = absurd || (may_diverge && found > kMostGrowth * largest_force(before.force));
    if (!absurd) forces.find_gaps(state);
    if (one_sided.add(system, taut, state)) {
      if (acceleration != nullptr) return std::numeric_limits<double>::infinity();
      forces.release(one_sided.left, one_sided.slack);
      state = taut;
      pass = -1;  // start again
      continue;
    }
    if (pass == 0 && firm)  // a force that no gap can carry, such as a push in a rope, does not act
      for (int j = 0; j < system.n_joints(); ++j)
        if (!system.joints[j].law.ideal_limit()) state.force[j] = respond(system.joints[j].law, state.gap[j], state.gap_rate[j]).force;
    // Where joints have deflected, redundant ones may hold what was free: the projection then holds components that are not held, and the passes
    // diverge.
    if (grows) {
      if (moves_too_far(system, unloaded, before)) return state = unloaded, std::numeric_limits<double>::infinity();
      state = before;
      change = std::numeric_limits<double>::infinity();
      break;
    }
    if (acceleration != nullptr || pass + 1 >= kPreloadPasses) change = change_of_gaps(system, before, state, weight);
    if (acceleration != nullptr) {
      if (change < least) {
        least = change;
        best = state;
      }
      if (change < kFits) break;
      acceleration->improve(before.gap, weight, state.gap);
    }
    forces.move_onto_gaps(state);
    if (pass < kCarefulPasses) forces.limit_step_at_borders(before, state);
    fits = !forces.set_forces_from_bodies(state);
  }
  if (acceleration != nullptr) {
    state = std::move(best);
    change = least;
  }
  balance_start(system, state);
  if (is_finite(state) && !moves_too_far(system, unloaded, state)) return change;
  state = unloaded;  // near a singular position joints would deflect by more than the mechanism's size, and a soft thread would turn its drum many times
  return std::numeric_limits<double>::infinity();
}

}  // namespace

template <class S>
void start_forces(const BasicSystem<S>& system, bool preload, BasicState<S>& state) {
  const std::size_t n = system.bodies.size(), joints = system.joints.size();
  state.a.assign(n, S::Vec::Zero());
  state.gap = state.gap_rate = state.gap_accel = state.force = VecsOf<S>(joints, S::Vec::Zero());
  plain_start(system, state);
  if (!preload || joints == 0) return;
  const BasicState<S> unloaded = state;
  const auto half_of_the_digits = [](double change) { return change * change < kFits; };
  if (half_of_the_digits(deflect<S>(system, unloaded, nullptr, state))) return;
  GapAcceleration<S> acceleration;
  BasicState<S> better;
  if (half_of_the_digits(deflect<S>(system, unloaded, &acceleration, better))) state = std::move(better);
}

void find_forces_and_accelerations(const System& system, State& state) {
  std::vector<Planar::Motion> m;
  std::vector<JointKinematics> r;
  kinematics_at(system, state.t, state.q, state.v, m, r);
  find_law_rates(system, state);
  find_joint_forces(system, state);
  find_accelerations(system, m, r, state);
}

double characteristic_length(const System& system, const Vecs& q) { return std::max(mechanism_size(system, q), system.largest_radius_of_gyration()); }

template bool moves_too_far(const BasicSystem<Planar>& system, const BasicState<Planar>& from, const BasicState<Planar>& to);
template void balance_start(const BasicSystem<Planar>& system, BasicState<Planar>& state);
template void start_forces(const BasicSystem<Planar>& system, bool preload, BasicState<Planar>& state);
PINTLE_IN_SPACE(template bool moves_too_far(const BasicSystem<Spatial>& system, const BasicState<Spatial>& from, const BasicState<Spatial>& to);)
PINTLE_IN_SPACE(template void balance_start(const BasicSystem<Spatial>& system, BasicState<Spatial>& state);)
PINTLE_IN_SPACE(template void start_forces(const BasicSystem<Spatial>& system, bool preload, BasicState<Spatial>& state);)

}  // namespace pintle

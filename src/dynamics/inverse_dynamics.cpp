#include "dynamics/inverse_dynamics.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "integrators/absolute/gap_projector.h"
#include "integrators/absolute/radau_stepper.h"
#include "integrators/thresholds.h"
#include "laws/gap_at_force.h"
#include "system/size_about_origin.h"

namespace pintle {

namespace {

constexpr int kClosing = 4;          // upper limit on passes of a projection onto closed gaps
constexpr double kClosed = 1e-11;    // passes end when the correction is below this fraction of the first one
constexpr double kRedundant = 1e-3;  // as a fraction of test forces on all joints: a joint is redundant if more than this remains of its force
constexpr int kMostHalvings = 6;     // upper limit on halvings of a step until no law crosses a border

// Over all joints.
template <class S>
double slowest_joint(const BasicSystem<S>& system, const std::vector<BasicJointKinematics<S>>& r, const VecsOf<S>* moved = nullptr) {
  double slowest = std::numeric_limits<double>::infinity();
  for (int j = 0; j < system.n_joints(); ++j) slowest = std::min(slowest, lowest_own_frequency(system, system.joints[j], r[j], moved ? &(*moved)[j] : nullptr));
  return slowest;
}

// Whether a holding law also resists the motion that the joint leaves free, as an oil film does.
template <class S>
bool drags(const BasicJointData<S>& joint) {
  if (joint.law.ideal_limit()) return false;
  const BasicResponse<S> still = respond(joint.law, typename S::Vec(S::Vec::Zero()), typename S::Vec(S::Vec::Zero()));
  for (int k = 0; k < S::kDof; ++k)
    if (joint.free_mask[k] != 0 && still.damping(k, k) > 0) return true;
  return false;
}

}  // namespace

template <class S>
double held_above(const BasicSystem<S>& system, double lowest, const VecsOf<S>& loads, const std::vector<typename S::Coordinates>& q) {
  double load = 0, mass = 0;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    load += loads[i].template head<S::kDim>().norm();
    mass += system.bodies[i].mass[0];
  }
  return held_above(lowest, load / mass, size_about_origin(system, q));
}

template <class S>
double lowest_own_frequency(const BasicSystem<S>& system, const BasicJointData<S>& joint, const BasicJointKinematics<S>& r, const typename S::Vec* moved) {
  typename S::Vec k = joint.law.engaged_stiffness();
  if (k.isZero(0) && !joint.law.ideal_limit()) k = respond(joint.law, r.gap, typename S::Vec(S::Vec::Zero())).stiffness.diagonal();  // an edge in contact
  if (moved) k = k.cwiseProduct(*moved);
  const auto root = k.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  typename S::Mat own = S::Mat::Zero();
  if (joint.at.a != kGround) own += r.GA() * system.bodies[joint.at.a].mass.cwiseInverse().asDiagonal() * r.GA().transpose();
  if (joint.at.b != kGround) own += r.GB() * system.bodies[joint.at.b].mass.cwiseInverse().asDiagonal() * r.GB().transpose();
  own = root * own * root;
  if (std::count_if(k.begin(), k.end(), [](double stiffness) { return stiffness > 0; }) == 2 && k[0] > 0 && k[1] > 0) {  // a pin: in closed form
    const double larger = 0.5 * (own(0, 0) + own(1, 1)) + std::hypot(0.5 * (own(0, 0) - own(1, 1)), own(0, 1)), product = own(0, 0) * own(1, 1) - own(0, 1) * own(0, 1);
    if (product > kLastBits * larger * larger) return std::sqrt(product / larger);
  }
  const Eigen::SelfAdjointEigenSolver<typename S::Mat> modes(own, Eigen::EigenvaluesOnly);
  double lowest = std::numeric_limits<double>::infinity();
  for (const double square : modes.eigenvalues())
    if (square > kLastBits * modes.eigenvalues().maxCoeff()) lowest = std::min(lowest, std::sqrt(square));
  return lowest;
}

template <class S>
bool is_in_play(const BasicLaw<S>& law, const typename S::Vec& gap, const typename S::Vec& rate) {
  const typename S::Vec engaged = law.engaged_stiffness();
  const BasicResponse<S> now = respond(law, gap, rate);
  for (int k = 0; k < S::kDof; ++k)
    if (engaged[k] > 0 && !(now.stiffness(k, k) > 0) && !(now.damping(k, k) > 0)) return true;
  return false;
}

template <class S>
bool is_apart(const BasicLaw<S>& law, const typename S::Vec& gap, const typename S::Vec& rate) {
  if (law.ideal_limit() || !law.starts_free()) return false;
  const BasicResponse<S> now = respond(law, gap, rate);
  return is_in_play(law, gap, rate) || (now.stiffness.isZero(0) && now.damping.isZero(0));
}

template <class S>
std::optional<BasicSystem<S>> with_springs(const BasicSystem<S>& system, const std::vector<int>& joints) {
  if (joints.empty()) return std::nullopt;
  BasicSystem<S> firm = system;
  for (const int j : joints) {
    BasicLinearLaw<S> spring;
    spring.k = system.joints[j].law.engaged_stiffness();
    firm.joints[j].law = BasicLaw<S>(spring);
  }
  return firm;
}

// 1 in the components that joints hold, regardless of friction in the others.
template <class S>
VecsOf<S> held_components(const BasicSystem<S>& system) {
  VecsOf<S> held;
  for (const BasicJointData<S>& joint : system.joints) held.push_back(S::Vec::Ones() - joint.free_mask);
  return held;
}

template <class S>
BasicInverseDynamics<S>::BasicInverseDynamics(const BasicSystem<S>& system) : system_(system), projector_(system), linearized_(system.joints.size(), false), wanted_(system.joints.size()) {
  VecsOf<S> held(system.joints.size(), S::Vec::Ones());
  bool any_drags = false;
  for (int j = 0; j < system.n_joints(); ++j) {
    const bool drag = drags(system.joints[j]) || system.joints[j].law.rubs_where_it_holds();
    if (drag || system.joints[j].law.rubs()) rubbing_.push_back(j);
    for (int k = 0; drag && k < S::kDof; ++k)
      if (system.joints[j].free_mask[k] != 0) held[j][k] = 0;
    any_drags = any_drags || drag;
  }
  if (any_drags) moved_ = held;
}

template <class S>
void BasicInverseDynamics<S>::find_kinematics(const BasicState<S>& state) {
  system_.motions(state.q, state.v, m_);
  system_.joint_kinematics(state.t, m_, r_);
}

template <class S>
typename S::Vec BasicInverseDynamics<S>::from_bodies(int j, const VecsOf<S>& x) const {
  typename S::Vec y = S::Vec::Zero();
  add_gap(system_.joints[j].at, r_[j], x, y);
  return y;
}

template <class S>
void BasicInverseDynamics<S>::leave_to_laws(const VecsOf<S>& components) {
  by_law_ = components;
  moved_.resize(components.size(), S::Vec::Ones());
  for (std::size_t j = 0; j < components.size(); ++j) moved_[j] = moved_[j].cwiseProduct(S::Vec::Ones() - components[j]);
}

template <class S>
void BasicInverseDynamics<S>::release(const VecsOf<S>& components, const VecsOf<S>& slack) {
  leave_to_laws(components);
  released_ = components;
  slack_ = slack;
}

// theory/assembly Eq. (5.7): components left to their laws act as loads.
template <class S>
void BasicInverseDynamics<S>::push_by_laws(BasicState<S>& state) {
  for (std::size_t j = 0; j < by_law_.size(); ++j) {
    if (by_law_[j].isZero()) continue;
    const typename S::Vec force = respond(system_.joints[j].law, r_[j].gap, r_[j].rate).force;
    const typename S::Vec pushing = by_law_[j].cwiseProduct(force);
    state.force[j] = pushing + moved_[j].cwiseProduct(state.force[j]);
    add_force(system_.joints[j].at, r_[j], pushing, state.a);
  }
}

template <class S>
void BasicInverseDynamics<S>::keep_states_of(const BasicState<S>& start) {
  if (rubbing_.empty()) return;
  find_kinematics(start);
  rest_rate_.clear();
  for (const BasicJointKinematics<S>& r : r_) rest_rate_.push_back(r.rate);
}

// Friction, and anything else that acts in a free direction, acts as a load, at the reactions that the gaps of the state carry. theory/assembly Eq.
// (3.5).
template <class S>
void BasicInverseDynamics<S>::push_by_friction(BasicState<S>& state) {
  for (const int j : rubbing_) {
    const BasicJointData<S>& joint = system_.joints[j];
    typename S::Vec gap = state.gap[j], rate = state.gap_rate[j], f = S::Vec::Zero();
    for (int k = 0; k < S::kDof; ++k)
      if (!joint.held[k]) {
        gap[k] = r_[j].gap[k];
        rate[k] = r_[j].rate[k];
      }
    double states[kMostLawStates];
    for (int k = 0; !rest_rate_.empty() && joint.law.n_states() > 0 && k < S::kDof; ++k)
      if (!joint.held[k]) rate[k] = rest_rate_[j][k];
    joint.law.rest({state.t, gap, rate, states}, states);
    const typename S::Vec force = joint.law.force({state.t, gap, rate, states});
    for (int k = 0; k < S::kDof; ++k)
      if (!joint.held[k]) {
        f[k] = force[k];
        state.force[j][k] = 0;  // the joint force is found without it
      }
    add_force(joint.at, r_[j], f, Q_);
  }
}

// The largest gap over the components that a law holds.
template <class S>
double BasicInverseDynamics<S>::largest_held(const VecsOf<S>& gap) const {
  double largest = 0;
  for (int j = 0; j < system_.n_joints(); ++j)
    for (int k = 0; k < S::kDof; ++k)
      if (system_.joints[j].free_mask[k] == 0 && (moved_.empty() || moved_[j][k] != 0)) largest = std::max(largest, std::abs(gap[j][k]));
  return largest;
}

// theory/assembly Eqs. (3.1), (3.2): first the free bodies' accelerations, then those that the joints require, then the forces.
template <class S>
bool BasicInverseDynamics<S>::find(BasicState<S>& state) {
  // Friction depends on the reactions: they are found again with the friction of the previous ones.
  double last_change = std::numeric_limits<double>::infinity();
  for (int round = 1;; ++round) {
    if (!rubbing_.empty()) last_force_ = state.force;
    if (!find_accelerations(state)) return false;
    for (int pass = 0; pass < kClosing; ++pass) {
      const double change = projector_.improve_forces(Q_, state.a, state.force);
      if (change <= kClosed * largest_force(state.force)) break;
    }
    if (rubbing_.empty()) break;
    find_gaps(state);
    for (std::size_t j = 0; j < last_force_.size(); ++j) last_force_[j] -= state.force[j];
    const double change = largest_force(last_force_);
    if (change <= kClosed * largest_force(state.force) || (round >= kFrictionRounds && !(change < kFrictionContracts * last_change))) break;
    last_change = change;
  }
  return true;
}

template <class S>
bool BasicInverseDynamics<S>::find_accelerations(BasicState<S>& state) {
  find_kinematics(state);
  set_linearized_gaps_from_bodies(state);
  const VecsOf<S>* moved = moved_.empty() ? nullptr : &moved_;
  system_.external(state.t, m_, Q_);
  const double mu = held_above(system_, slowest_joint(system_, r_, moved), Q_, state.q);
  if (!std::isfinite(mu) || !(mu > 0)) return false;
  if (!projector_.prepare(r_, mu, state.gap, state.gap_rate, moved)) return false;
  push_by_friction(state);
  state.a = Q_;
  if (moved) push_by_laws(state);
  for (int i = 0; i < system_.n_bodies(); ++i) state.a[i] = state.a[i].cwiseQuotient(system_.bodies[i].mass);
  double first = 0;
  for (int pass = 0; pass < kClosing; ++pass) {
    for (int j = 0; j < system_.n_joints(); ++j) wanted_[j] = state.gap_accel[j] - r_[j].bias - from_bodies(j, state.a);
    const double missing = largest_held(wanted_);
    if (pass == 0) first = missing;
    else if (missing <= kClosed * first) break;
    projector_.close(wanted_, state.a);
  }
  return true;
}

template <class S>
bool BasicInverseDynamics<S>::prepare_unit_gap_accelerations(const BasicState<S>& state) {
  find_kinematics(state);
  const double mu = kHeldAbove * slowest_joint(system_, r_);
  no_load_.assign(system_.bodies.size(), S::Vec::Zero());
  return std::isfinite(mu) && mu > 0 && projector_.prepare(r_, mu, state.gap, state.gap_rate);
}

template <class S>
const VecsOf<S>& BasicInverseDynamics<S>::forces_of_unit_gap_acceleration(int j, int c) {
  accelerated_ = no_load_;
  accelerating_.assign(system_.joints.size(), S::Vec::Zero());
  for (int pass = 0; pass < kClosing; ++pass) {
    for (int i = 0; i < system_.n_joints(); ++i) wanted_[i] = -from_bodies(i, accelerated_);
    wanted_[j][c] += 1;
    if (largest_held(wanted_) <= kClosed) break;
    projector_.close(wanted_, accelerated_);
  }
  for (int pass = 0; pass < kClosing; ++pass)
    if (projector_.improve_forces(no_load_, accelerated_, accelerating_) <= kClosed * largest_force(accelerating_)) break;
  return accelerating_;
}

// theory/assembly Eq. (5.1).
template <class S>
BasicEffectiveMasses<S> BasicInverseDynamics<S>::effective_masses(const BasicState<S>& state) {
  if (!prepare_unit_gap_accelerations(state)) return {};
  const VecsOf<S> none(system_.joints.size(), S::Vec::Zero());
  BasicEffectiveMasses<S> masses{none, none};
  for (int j = 0; j < system_.n_joints(); ++j) {
    const typename S::Vec mobility = system_.own_mobility(system_.joints[j].at, r_[j]);
    for (int c = 0; c < S::kDof; ++c) {
      masses.closed[j][c] = masses.alone[j][c] = mobility[c] > 0 ? 1 / mobility[c] : 0;
      if (system_.n_joints() > kMostJointsWithMasses) continue;
      masses.closed[j][c] = std::max(masses.closed[j][c], forces_of_unit_gap_acceleration(j, c)[j][c]);  // if no motion can change this gap alone, the force is 0
    }
  }
  return masses;
}

// Components that a joint leaves free move with the bodies.
template <class S>
bool BasicInverseDynamics<S>::find_gaps(BasicState<S>& state) const {
  bool carried = true;
  for (int j = 0; j < system_.n_joints(); ++j) {
    if (system_.joints[j].constrained) {
      state.gap[j].setZero();
      continue;
    }
    typename S::Vec rate = state.gap_rate[j];
    for (int k = 0; k < S::kDof; ++k)
      if (system_.joints[j].free_mask[k] != 0 && !r_.empty()) rate[k] = r_[j].rate[k];
    const BasicLaw<S>& law = system_.joints[j].law;
    if (linearized_[j] && resists(law, respond(law, r_[j].gap, rate))) newton_step_to_force(law, state.force[j], rate, moved_.empty() ? typename S::Vec(S::Vec::Ones()) : moved_[j], state.gap[j]);
    else carried = gap_at_force(law, state.force[j], rate, state.gap[j]) && carried;
    for (int k = 0; !released_.empty() && k < S::kDof; ++k)
      if (released_[j][k] != 0) state.gap[j][k] = r_[j].gap[k];
  }
  return carried;
}

// The joints that start free and do not touch at the bodies' positions; an edge has no spring that would hold it at a distance.
template <class S>
std::vector<int> BasicInverseDynamics<S>::apart(const BasicState<S>& state) const {
  std::vector<int> out;
  for (int j = 0; j < system_.n_joints(); ++j) {
    const BasicLaw<S>& law = system_.joints[j].law;
    const bool slack = !slack_.empty() && !slack_[j].isZero(0);
    if (!law.engaged_stiffness().isZero(0) && (slack || (is_apart(law, r_[j].gap, r_[j].rate) && is_apart(law, state.gap[j], state.gap_rate[j])))) out.push_back(j);
  }
  return out;
}

// The slack components (joint and component) that are not held, but carry load at the new positions of the bodies.
template <class S>
std::vector<std::pair<int, int>> BasicInverseDynamics<S>::slack_drawn_taut(const VecsOf<S>& held) const {
  std::vector<std::pair<int, int>> out;
  for (std::size_t j = 0; j < slack_.size(); ++j)
    for (int k = 0; k < S::kDof; ++k)
      if (slack_[j][k] != 0 && held[j][k] == 0 && respond(system_.joints[j].law, r_[j].gap, typename S::Vec(S::Vec::Zero())).stiffness(k, k) > 0) out.emplace_back(static_cast<int>(j), k);
  return out;
}

// Eq. (3.4). Joints that are apart keep their distance: the bodies on both sides move together.
template <class S>
void BasicInverseDynamics<S>::move_onto_gaps(BasicState<S>& state) {
  find_kinematics(state);
  const std::vector<int> apart_now = apart(state);
  const std::optional<BasicSystem<S>> firm = with_springs(system_, apart_now);
  std::optional<BasicGapProjector<S>> holding;
  if (firm) holding.emplace(*firm);
  BasicGapProjector<S>& projector = holding ? *holding : projector_;
  system_.external(state.t, m_, Q_);
  const double mu = held_above(system_, slowest_joint(system_, r_), Q_, state.q);
  VecsOf<S> held = held_components(system_), gap = state.gap;
  for (std::size_t j = 0; j < released_.size(); ++j) held[j] = held[j].cwiseProduct(S::Vec::Ones() - released_[j]);
  for (const int j : apart_now) gap[j] = r_[j].gap;
  if (!std::isfinite(mu)) return;
  const auto close = [&](const VecsOf<S>& holding_now) {
    if (!projector.prepare(r_, mu, state.gap, state.gap_rate, &holding_now)) return false;
    for (int pass = 0; pass < kClosing; ++pass) {
      for (int j = 0; j < system_.n_joints(); ++j) wanted_[j] = gap[j] - r_[j].gap;
      moves_.assign(state.v.size(), S::Vec::Zero());
      projector.close(wanted_, moves_);
      for (std::size_t i = 0; i < moves_.size(); ++i) S::move(state.q[i], moves_[i]);
      find_kinematics(state);
    }
    return true;
  };
  const PositionsOf<S> from = slack_.empty() ? PositionsOf<S>() : state.q;
  if (!close(held)) return;
  // Keeping the length of one rope may keep all others slack. If no single one does, all that would be drawn taut keep theirs.
  if (const std::vector<std::pair<int, int>> taut = slack_drawn_taut(held); !taut.empty()) {
    const auto close_with = [&](const std::vector<std::pair<int, int>>& components) {
      VecsOf<S> holding_now = held;
      for (const auto& [j, k] : components) holding_now[j][k] = 1;
      state.q = from;
      find_kinematics(state);
      return close(holding_now) && slack_drawn_taut(holding_now).empty();
    };
    if (std::none_of(taut.begin(), taut.end(), [&](const std::pair<int, int>& one) { return close_with({one}); })) close_with(taut);
  }
  VecsOf<S> dv(state.v.size(), S::Vec::Zero()), rate = state.gap_rate;
  for (const int j : apart_now) rate[j] = r_[j].rate;
  for (int pass = 0; pass < kClosing; ++pass) {
    for (int j = 0; j < system_.n_joints(); ++j) wanted_[j] = rate[j] - r_[j].rate - from_bodies(j, dv);
    projector.close(wanted_, dv);
  }
  for (std::size_t i = 0; i < dv.size(); ++i) state.v[i] += dv[i];
}

template <class S>
void BasicInverseDynamics<S>::limit_step_at_borders(const BasicState<S>& before, BasicState<S>& state) {
  if (!any_linearized()) return;
  find_kinematics(before);
  VecsOf<S> gap_before(r_.size());
  for (std::size_t j = 0; j < r_.size(); ++j) gap_before[j] = r_[j].gap;
  const auto crosses = [&](int j) {
    const BasicLaw<S>& law = system_.joints[j].law;
    const typename S::Vec &from = gap_before[j], &to = r_[j].gap, &rate = state.gap_rate[j];
    return linearized_[j] && resists(law, respond(law, from, rate)) && resists(law, respond(law, to, rate)) && !on_same_sides(law, from, to, rate);
  };
  for (int halvings = 0;; ++halvings) {
    find_kinematics(state);
    bool any = false;
    for (int j = 0; j < system_.n_joints(); ++j) any = any || crosses(j);
    if (!any || halvings == kMostHalvings) return;
    for (std::size_t i = 0; i < state.q.size(); ++i) state.q[i] = S::moved(before.q[i], 0.5 * S::difference(state.q[i], before.q[i]));
  }
}

template <class S>
bool BasicInverseDynamics<S>::set_forces_from_bodies(BasicState<S>& state) {
  double misfit = 0;
  for (int j = 0; j < system_.n_joints(); ++j) {
    if (!is_nonlinear(j)) continue;
    const BasicLaw<S>& law = system_.joints[j].law;
    const BasicResponse<S> now = respond(law, r_[j].gap, state.gap_rate[j]);
    const bool at_bodies = linearized_[j] && resists(law, now);
    misfit = std::max(misfit, at_bodies ? (now.force - state.force[j]).norm() : (respond(law, state.gap[j], state.gap_rate[j]).stiffness * (r_[j].gap - state.gap[j])).norm());
  }
  if (misfit <= kFits * largest_force(state.force)) return false;
  for (int j = 0; j < system_.n_joints(); ++j) state.force[j] = respond(system_.joints[j].law, r_[j].gap, state.gap_rate[j]).force;
  return true;
}

// Whether the law is a nonlinear function of gap and rate alone.
template <class S>
bool BasicInverseDynamics<S>::is_nonlinear(int j) const {
  const BasicLaw<S>& law = system_.joints[j].law;
  return !law.ideal_limit() && law.n_states() == 0 && !law.starts_free();
}

template <class S>
bool BasicInverseDynamics<S>::any_linearized() const {
  return std::find(linearized_.begin(), linearized_.end(), true) != linearized_.end();
}

template <class S>
void BasicInverseDynamics<S>::linearize_nonlinear_laws() {
  for (int j = 0; j < system_.n_joints(); ++j) linearized_[j] = is_nonlinear(j);
}

// Of arbitrary forces on all joints the part that moves nothing is kept: a joint where it does not vanish is redundant.
template <class S>
void BasicInverseDynamics<S>::linearize_redundant_laws(const BasicState<S>& state) {
  linearize_nonlinear_laws();
  if (!any_linearized()) return;
  find_kinematics(state);
  const double mu = kHeldAbove * slowest_joint(system_, r_);
  const VecsOf<S> held = held_components(system_), none(system_.bodies.size(), S::Vec::Zero());
  if (!std::isfinite(mu) || !(mu > 0) || !projector_.prepare(r_, mu, state.gap, state.gap_rate, &held)) return linearized_.assign(linearized_.size(), false);
  VecsOf<S> force(linearized_.size());
  for (int j = 0; j < system_.n_joints(); ++j) {
    const BasicResponse<S> now = respond(system_.joints[j].law, r_[j].gap, state.gap_rate[j]);
    for (int k = 0; k < S::kDof; ++k) force[j][k] = now.stiffness(k, k) > 0 ? held[j][k] * std::cos(1.0 + S::kDof * j + k) : 0;  // in no particular direction
  }
  const double given = largest_force(force);
  for (int pass = 0; pass < kClosing; ++pass) projector_.improve_forces(none, none, force);
  for (int j = 0; j < system_.n_joints(); ++j) {
    const BasicLaw<S>& law = system_.joints[j].law;
    linearized_[j] = linearized_[j] && force[j].norm() > kRedundant * given && resists(law, respond(law, r_[j].gap, state.gap_rate[j]));
  }
}

// Where a law does not resist, as within its play, its tangent is useless.
template <class S>
void BasicInverseDynamics<S>::set_linearized_gaps_from_bodies(BasicState<S>& state) const {
  for (int j = 0; j < system_.n_joints(); ++j) {
    if (!linearized_[j]) continue;
    const BasicLaw<S>& law = system_.joints[j].law;
    const BasicResponse<S> now = respond(law, r_[j].gap, state.gap_rate[j]);
    if (!resists(law, now)) continue;
    state.gap[j] = r_[j].gap;
    state.force[j] = now.force;
  }
}

template double held_above<Planar>(const System& system, double lowest, const Vecs& loads, const Vecs& q);
PINTLE_IN_SPACE(template double held_above<Spatial>(const BasicSystem<Spatial>& system, double lowest, const VecsOf<Spatial>& loads, const std::vector<Spatial::Coordinates>& q);)
template double lowest_own_frequency<Planar>(const System& system, const JointData& joint, const JointKinematics& r, const Planar::Vec* moved);
PINTLE_IN_SPACE(template double lowest_own_frequency<Spatial>(const BasicSystem<Spatial>& system, const BasicJointData<Spatial>& joint, const BasicJointKinematics<Spatial>& r, const Spatial::Vec* moved);)
template bool is_in_play<Planar>(const BasicLaw<Planar>& law, const Planar::Vec& gap, const Planar::Vec& rate);
PINTLE_IN_SPACE(template bool is_in_play<Spatial>(const BasicLaw<Spatial>& law, const Spatial::Vec& gap, const Spatial::Vec& rate);)
template bool is_apart<Planar>(const BasicLaw<Planar>& law, const Planar::Vec& gap, const Planar::Vec& rate);
PINTLE_IN_SPACE(template bool is_apart<Spatial>(const BasicLaw<Spatial>& law, const Spatial::Vec& gap, const Spatial::Vec& rate);)
template std::optional<BasicSystem<Planar>> with_springs(const BasicSystem<Planar>& system, const std::vector<int>& joints);
PINTLE_IN_SPACE(template std::optional<BasicSystem<Spatial>> with_springs(const BasicSystem<Spatial>& system, const std::vector<int>& joints);)

template class BasicInverseDynamics<Planar>;
PINTLE_IN_SPACE(template class BasicInverseDynamics<Spatial>;)

}  // namespace pintle

#include "start/stiction.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "kinematics/position_search.h"
#include "laws/friction/stick_slip.h"
#include "start/locks.h"
#include "start/preload.h"
#include "system/system.h"

namespace pintle {
namespace {

using S = Planar;

// Stiffness of a soft lock, as a fraction of a firm one's: joints deflect under their loads, and the lock carries what they do not balance. With 1e-4 the locks of
// tests/models/garage_door_at_rest.toml still carry 31 N instead of 16 N, with 1e-2 more than friction can; 1e-8 changes the force of its rope by 4e-4.
constexpr double kSoft = 1e-6;

// A joint held by friction, and the lock that replaces the friction.
struct LockedJoint {
  int joint;
  LockLaw lock;
  double at_rest;       // an acceleration that is only roundoff [m/s^2] or [rad/s^2]
  double force = 0;     // of the lock on the second body, or of the friction where it slips [N] or [N*m]
  bool turned = false;  // slips in the direction opposite to that found from its lock
};

// Sticking joints that would begin to move without friction.
std::vector<LockedJoint> joints_to_hold(const System& system, const std::vector<JointKinematics>& r, const State& state) {
  const double nothing = kFits * largest_force(state.force), stiffest = largest_stiffness(system), size = characteristic_length(system, state.q);
  std::vector<LockedJoint> out;
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& joint = system.joints[j];
    const auto held = joint.law.stiction(state.law_state.data() + joint.first_state);
    if (!held) continue;
    const double at_rest = nothing * system.own_mobility(joint.at, r[j])[held->component];
    if (!(std::abs(state.gap_accel[j][held->component]) > at_rest)) continue;
    // The lock must not deflect under the load that it is used to find: surfaces that stick softly would.
    const double firm = std::max(held->stiffness, stiffest * (held->component == 2 ? size * size : 1));
    out.push_back({.joint = j, .lock = {held->component, firm, r[j].gap[held->component]}, .at_rest = at_rest});
  }
  return out;
}

// Whether its direction of slip is prescribed although it has no speed yet. Bristles find theirs by themselves.
bool knows_its_way(const JointData& joint, double t, const S::Vec& gap) {
  std::vector<double> at_rest(static_cast<std::size_t>(joint.law.n_states()));
  joint.law.rest({t, gap, S::Vec::Zero(), at_rest.data()}, at_rest.data());
  return !joint.law.stiction(at_rest.data());
}

// Computes the locks' forces from their gaps, which follow those of the system's own joints, and removes the locks from the state.
void take_off_locks(int n_joints, std::vector<LockedJoint>& held, BasicSettledStart<S>& start) {
  const S::Vec* gap = start.state.gap.data() + n_joints;
  for (LockedJoint& one : held) one.force = one.lock.force_at((*gap++)[one.lock.component]);
  remove_locks(n_joints, start);
}

bool stick(const System& system, const LockedJoint& one, State& state) {
  const JointData& joint = system.joints[one.joint];
  return joint.law.set_stuck(law_point(system, one.joint, state), one.force, state.law_state.data() + joint.first_state);
}

// Firm locks carry all that would deflect a rope or another soft joint between them. If friction can hold the mechanism once that has deflected, it rests:
// only what the joints do not balance is shared, by the locks' stiffness.
bool rests_by_friction(const System& system, std::vector<LockedJoint> held, const BasicSettledStart<S>& unloaded, double duration, double known_span, BasicSettledStart<S>& start) {
  for (LockedJoint& one : held) one.lock.k *= kSoft;
  BasicSettledStart<S> trial = unloaded;
  start_forces(with_locks(system, held), true, trial.state);
  const auto all_stick = [&] { return std::all_of(held.begin(), held.end(), [&](const LockedJoint& one) { return stick(system, one, trial.state); }); };
  for (std::size_t i = 0; i < held.size(); ++i) held[i].force = held[i].lock.preload = trial.state.force[system.joints.size() + i][held[i].lock.component];
  if (!all_stick()) return false;
  trial.state = unloaded.state;
  const System locked = with_locks(system, held);
  start_forces(locked, true, trial.state);
  settle_joints(locked, duration, known_span, trial);
  take_off_locks(system.n_joints(), held, trial);
  rest_laws(system, trial.state);
  if (!all_stick()) return false;
  find_forces_and_accelerations(system, trial.state);
  start = std::move(trial);
  return true;
}

}  // namespace

System settle_with_stiction(System system, const BasicSettledStart<Planar>& unloaded, double duration, double known_span, BasicSettledStart<Planar>& start) {
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  kinematics_at(system, unloaded.state.t, unloaded.state.q, unloaded.state.v, m, r);
  std::vector<LockedJoint> held = joints_to_hold(system, r, start.state), slipping;
  if (held.empty()) settle_joints(system, duration, known_span, start);
  for (bool again = !held.empty(); again;) {
    const System locked = with_locks(system, held);
    BasicSettledStart<Planar> trial = unloaded;
    start_forces(locked, true, trial.state);
    // A lock that opposes a motor does not determine the direction in which its joint moves. Each is reversed at most once.
    bool turned = false;
    for (LockedJoint& one : slipping) {
      const double accel = trial.state.gap_accel[one.joint][one.lock.component];
      if (one.turned || std::abs(accel) <= one.at_rest || accel * one.force <= 0) continue;
      one.force = -one.force;
      one.turned = turned = true;
      system.joints[one.joint].law.start_slipping(one.force);
    }
    if (turned) continue;
    const State given = trial.state;
    settle_joints(locked, duration, known_span, trial);
    State& state = trial.state;
    kinematics_at(system, state.t, state.q, state.v, m, r);
    const auto turned_back = [&](const LockedJoint& one) {
      return one.force * r[one.joint].rate[one.lock.component] > StickSlip::kStill * std::abs(one.force) && knows_its_way(system.joints[one.joint], state.t, r[one.joint].gap);
    };
    if (std::any_of(slipping.begin(), slipping.end(), turned_back)) {
      // A compliant joint, such as a rope under a motor that slackens, would turn back a joint that has yet to move, and its friction. Its deflection is
      // left to the run.
      state = given;
      trial.notes = unloaded.notes;
      trial.settled_over = 0;
      note_not_settled(system, state, trial.notes);
    }
    take_off_locks(system.n_joints(), held, trial);
    rest_laws(system, state);
    const auto slips = [&](const LockedJoint& one) {
      if (stick(system, one, state)) return false;
      system.joints[one.joint].law.start_slipping(one.force);
      slipping.push_back(one);
      return true;
    };
    const bool all_stick = std::all_of(held.begin(), held.end(), [&](const LockedJoint& one) { return stick(system, one, state); });
    if (!all_stick && slipping.empty() && held.size() > 1 && rests_by_friction(system, held, unloaded, duration, known_span, start)) return system;
    again = std::erase_if(held, slips) > 0;
    if (again) continue;
    find_forces_and_accelerations(system, state);
    start = std::move(trial);
  }
  return system;
}

}  // namespace pintle

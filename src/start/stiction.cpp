#include "start/stiction.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "kinematics/position_search.h"
#include "laws/law_part.h"
#include "start/start_forces.h"
#include "system/system.h"

namespace pintle {
namespace {

using S = Planar;

constexpr double kAtRest = 1e-6;     // slip speed of a joint that is at rest [m/s or rad/s]
constexpr double kIdle = 1e-6;       // of the friction that a joint can have: one that needs no more to stay at rest needs none
constexpr double kUsualJoint = 1e8;  // what holds a joint whose law has no stiffness of its own [N/m]

// Holds one component where it is.
struct LockLaw {
  static constexpr std::string_view kWord = "lock";
  int component = 0;
  double k = 1, at = 0;  // [N/m or N*m/rad]; the gap that it holds

  static LockLaw typical() { return {}; }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const T off = in.gap[component] - T(at);
    out.force[component] = -(k * off);
    out.energy = 0.5 * k * (off * off);
  }
  Planar::Vec engaged_stiffness() const { return k * Planar::Vec::Unit(component); }
};

// As stiff as the joint is where it rubs.
double lock_stiffness(const JointData& joint, int component, double arm) {
  const S::Vec engaged = joint.law.engaged_stiffness();
  const double k = std::max(engaged[0], engaged[1]);
  return (k > 0 ? k : kUsualJoint) * (component == 2 ? arm * arm : 1);
}

// Whether a joint that is at rest needs friction to stay there: more than next to nothing of what it can have.
bool would_move(const System& system, int j, int component, const JointKinematics& r, State state) {
  const double mobility = own_mobility(system, system.joints[j].at, r)[component];
  if (!(mobility > 0)) return false;
  return !system.joints[j].law.stick(law_point(system, j, state), state.gap_accel[j][component] / (kIdle * mobility), state.law_state.data() + system.joints[j].first_state);
}

System with_locks(const System& system, const std::vector<int>& joints, const std::vector<JointKinematics>& r) {
  System locked = system;
  for (const int j : joints) {
    JointData& joint = locked.joints[j];
    const int component = joint.law.sticking_component();
    joint.law.add(std::make_unique<LawPartOf<LockLaw>>(LockLaw{component, lock_stiffness(joint, component, system.largest_radius_of_gyration()), r[j].gap[component]}));
    joint.free_mask[component] = 0;
    joint.held[component] = true;
  }
  return locked;
}

}  // namespace

void hold_by_friction(const System& system, const BasicSettledStart<Planar>& unloaded, double duration, double known_span, BasicSettledStart<Planar>& start) {
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  kinematics_at(system, unloaded.state.t, unloaded.state.q, unloaded.state.v, m, r);
  std::vector<int> held;
  for (int j = 0; j < system.n_joints(); ++j) {
    const int k = system.joints[j].law.sticking_component();
    if (k >= 0 && std::abs(r[j].rate[k]) < kAtRest && would_move(system, j, k, r[j], start.state)) held.push_back(j);
  }
  while (!held.empty()) {
    const System locked = with_locks(system, held, r);
    BasicSettledStart<Planar> trial = unloaded;
    start_forces(locked, true, trial.state);
    settle_joints(locked, duration, known_span, trial);
    State state = trial.state;
    rest_laws(system, state);
    const auto slips = [&](int j) {
      const BasicLaw<S>& law = system.joints[j].law;
      return !law.stick(law_point(system, j, state), trial.state.force[j][law.sticking_component()], state.law_state.data() + system.joints[j].first_state);
    };
    const auto slipping = std::remove_if(held.begin(), held.end(), slips);
    if (slipping != held.end()) {
      held.erase(slipping, held.end());
      continue;
    }
    find_law_rates(system, state);
    find_joint_forces(system, state);
    kinematics_at(system, state.t, state.q, state.v, m, r);
    find_accelerations(system, m, r, state);
    trial.state = std::move(state);
    start = std::move(trial);
    return;
  }
}

}  // namespace pintle

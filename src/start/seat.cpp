#include "start/seat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "dynamics/inverse_dynamics.h"
#include "kinematics/position_search.h"
#include "laws/bushing.h"
#include "laws/gap_at_force.h"
#include "start/preload.h"

namespace pintle {
namespace {

using S = Planar;

// How far a component must move out from the middle, in doublings, until the law pushes back with that force; nullopt if it never does.
std::optional<double> way_to_side(const BasicLaw<S>& law, int component, double force) {
  S::Vec gap = S::Vec::Zero();
  if (!go_out_against<S>(law, force * S::Vec::Unit(component), S::Vec::Zero(), gap)) return std::nullopt;
  return std::abs(gap[component]);
}

bool holds(const JointData& joint, int component) { return joint.free_mask[component] == 0 && joint.law.engaged_stiffness()[component] > 0; }

// The distance from the middle to the side, in the component where it is smallest [m] or [rad].
double play_of(const JointData& joint, int& component) {
  constexpr double kTouch = 1e-6;  // force that indicates touch, as a fraction of the stiffness where the law acts times 1 m. With 1 N the beam of test SeatedStart stays in its play
  double play = std::numeric_limits<double>::infinity();
  for (int k = 0; k < S::kDof; ++k) {
    const std::optional<double> way = holds(joint, k) ? way_to_side(joint.law, k, kTouch * joint.law.engaged_stiffness()[k]) : std::nullopt;
    if (!way || *way >= play) continue;
    play = *way;
    component = k;
  }
  return play;
}

// The same mechanism without play: springs as stiff as the laws where these act, but soft enough to deflect by the play under `load` [N].
System without_play(const System& system, const std::vector<int>& joints, double load) {
  System firm = system;
  for (const int j : joints) {
    const JointData& joint = system.joints[j];
    LinearLaw spring;
    spring.k = joint.law.engaged_stiffness().cwiseProduct(S::Vec::Ones() - joint.free_mask);
    int k = 0;
    if (const double play = play_of(joint, k); load * play > 0 && std::isfinite(play)) spring.k *= std::min(1.0, load / (play * spring.k[k]));
    firm.joints[j].law = BasicLaw<S>(spring);
  }
  return firm;
}

// Whether loops close only by using up play.
bool has_misfit(const System& system, const State& state, const std::vector<int>& joints) {
  constexpr double kMisfit = 1e-3;  // as a fraction of the play: a smaller misfit hardly affects the pins
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  kinematics_at(system, state.t, state.q, state.v, m, r);
  return std::any_of(joints.begin(), joints.end(), [&](int j) {
    int k = 0;
    const double play = play_of(system.joints[j], k);
    return r[j].gap.cwiseProduct(S::Vec::Ones() - system.joints[j].free_mask).norm() > kMisfit * play;
  });
}

// The largest load on a body of the assembled mechanism, in which loads move loose bodies freely [N].
double largest_load_on_bodies(const System& system, const State& state) {
  State free = state;
  start_forces(system, false, free);
  double largest = largest_force(free.force);
  for (std::size_t i = 0; i < free.a.size(); ++i) largest = std::max(largest, system.bodies[i].mass[0] * free.a[i].head<2>().norm());
  return largest;
}

// Where the bodies go when joints with play move to the sides that their loads press them to; which of these joints carry nothing and stay in the middle; and
// which are kept from their side by other joints.
struct Seating {
  Vecs q, v;
  std::vector<int> unloaded, out_of_reach;
};

// The gap at the side that this force presses the joint to; nullopt if it presses to none.
std::optional<S::Vec> gap_at_side(const BasicLaw<S>& law, const S::Vec& force, double nothing) {
  S::Vec gap = S::Vec::Zero();
  if (!(force.norm() > nothing) || !go_out_against<S>(law, force, S::Vec::Zero(), gap)) return std::nullopt;
  gap_at_force<S>(law, force, S::Vec::Zero(), gap);
  return gap;
}

// The equilibrium of the bodies on springs at the sides of `pressed`, where these joints have the gaps and carry the forces of `carried`. On its way to its side a pin may move what
// other joints share, such as an object between two jaws, and then carries another force, on another side.
State pressed_to_sides(const System& system, const System& firm, const std::vector<int>& pressed, State carried, const State& state) {
  State out = state;
  for (int pass = 0; pass < kRedundantPasses; ++pass) {
    System at_sides = firm;
    for (const int j : pressed) {
      BushingLaw spring;
      const S::Vec k = firm.joints[j].law.engaged_stiffness();
      spring.K = k.asDiagonal();
      spring.offset = carried.gap[j];
      for (int c = 0; c < S::kDof; ++c)
        if (k[c] > 0) spring.offset[c] += carried.force[j][c] / k[c];
      at_sides.joints[j].law = BasicLaw<S>(spring);
    }
    out = state;
    start_forces(at_sides, true, out);
    const double nothing = kFits * largest_force(out.force);
    double change = 0;
    for (const int j : pressed) {
      change = std::max(change, (out.force[j] - carried.force[j]).norm());
      const std::optional<S::Vec> gap = gap_at_side(system.joints[j].law, out.force[j], nothing);
      if (!gap) return out;
      carried.gap[j] = *gap;
      carried.force[j] = out.force[j];
    }
    if (change < nothing) break;
  }
  return out;
}

Seating seat(const System& system, const std::vector<int>& loose, const State& state) {
  // Springs without play would carry a misfit as a preload. If each is soft enough to deflect by its play, they share the misfit as pins that go to their sides
  // do.
  const bool misfit = has_misfit(system, state, loose);
  State carried = state;
  System firm = without_play(system, loose, misfit ? largest_load_on_bodies(system, state) : 0);
  start_forces(firm, true, carried);
  if (misfit) {
    const double load = largest_force(carried.force);
    carried = state;
    firm = without_play(system, loose, load);
    start_forces(firm, true, carried);
  }
  Seating out;
  const double nothing = kFits * largest_force(carried.force);
  std::vector<int> pressed;
  for (const int j : loose) {
    const std::optional<S::Vec> gap = gap_at_side(system.joints[j].law, carried.force[j], nothing);
    (gap ? pressed : out.unloaded).push_back(j);
    carried.gap[j] = gap.value_or(S::Vec::Zero());
  }
  if (misfit) BasicInverseDynamics<S>(firm).move_onto_gaps(carried);
  else carried = pressed_to_sides(system, firm, pressed, carried, state);
  out.q = carried.q;
  out.v = carried.v;
  if (misfit) return out;
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  kinematics_at(system, carried.t, carried.q, carried.v, m, r);
  for (const int j : loose) {
    const bool asked = std::find(out.unloaded.begin(), out.unloaded.end(), j) == out.unloaded.end();
    if (asked && !(respond(system.joints[j].law, r[j].gap, S::Vec(S::Vec::Zero())).force.dot(carried.force[j]) > 0)) out.out_of_reach.push_back(j);
  }
  return out;
}

}  // namespace

bool has_play(const JointData& joint) {
  if (joint.law.ideal_limit() || joint.law.feeds()) return false;
  const BasicResponse<S> middle = respond<S>(joint.law, S::Vec::Zero(), S::Vec::Zero());
  for (int k = 0; k < S::kDof; ++k)
    if (holds(joint, k) && !(middle.stiffness(k, k) > 0) && !(middle.damping(k, k) > 0) && way_to_side(joint.law, k, 1) && way_to_side(joint.law, k, -1)) return true;
  return false;
}

std::vector<int> joints_in_play(const System& system) {
  std::vector<int> out;
  for (int j = 0; j < system.n_joints(); ++j)
    if (has_play(system.joints[j])) out.push_back(j);
  return out;
}

std::string names_of_joints(const System& system, const std::vector<int>& joints) {
  std::string names;
  for (const int j : joints) names += (names.empty() ? "" : ", ") + system.joints[j].name;
  return names;
}

std::string names_of_joints_in_play(const System& system) { return names_of_joints(system, joints_in_play(system)); }

std::string names_of_joints_in_play(const System& system, const State& state) {
  std::vector<int> loose = joints_in_play(system);
  std::erase_if(loose, [&](int j) { return !is_in_play(system.joints[j].law, state.gap[j], state.gap_rate[j]); });
  return names_of_joints(system, loose);
}

std::string seat_joints(const System& system, State& state) {
  std::vector<int> loose = joints_in_play(system), left;  // joints that stay in the middle
  while (!loose.empty()) {
    System without = system;
    for (const int j : left) without.joints[j].law = BasicLaw<S>(LinearLaw{});
    const Seating made = seat(without, loose, state);
    if (made.out_of_reach.empty()) {
      state.q = made.q;
      state.v = made.v;
      left.insert(left.end(), made.unloaded.begin(), made.unloaded.end());
      break;
    }
    left.insert(left.end(), made.out_of_reach.begin(), made.out_of_reach.end());
    std::erase_if(loose, [&](int j) { return std::find(left.begin(), left.end(), j) != left.end(); });
  }
  std::sort(left.begin(), left.end());
  return names_of_joints(system, left);
}

void note_seated(Assembly& assembly) {
  if (const std::string free = seat_joints(assembly.system, assembly.state); !free.empty())
    assembly.notes.push_back("joints that carry no load at the start stay in the middle of their play: " + free);
}

}  // namespace pintle

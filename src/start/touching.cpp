#include "start/touching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "kinematics/position_search.h"
#include "laws/bushing.h"
#include "laws/contact/gap_contact.h"
#include "laws/law_tangents.h"
#include "mobility/constraint_rows.h"
#include "start/preload.h"
#include "start/seat.h"

namespace pintle {
namespace {

using S = Planar;

constexpr double kMostAjar = 1e-4;  // upper limit on the opening of contacts, as a fraction of the mechanism's size: if soft joints opened them further, it would no longer be the assembled mechanism

// A joint whose surfaces touch, and how it is pressed: `sign` times component `k` of its gap is the depth.
struct Touch {
  int joint, k;
  double sign, stiffness;  // [N/m] or [N*m/rad], under the loads of the start
  S::Vec gap;              // where they touch
  bool is_stop;            // in a component that the joint leaves free
  double depth = 0;        // under its load, once that is known
  double beside = 0;       // other forces there on the second body, such as the pressure in a cylinder [N] or [N*m]
};

S::Vec gap_at(const Touch& touch, double depth) {
  S::Vec gap = touch.gap;
  gap[touch.k] += touch.sign * depth;
  return gap;
}

double pressing(const Touch& touch, const S::Vec& force) { return -touch.sign * (force[touch.k] - touch.beside); }

// A law at rest: for a stop everything that acts in its component, for a contact the holding law.
BasicResponse<S> respond_at_rest(const BasicLaw<S>& law, const Touch& touch, double depth) {
  const S::Vec gap = gap_at(touch, depth), still = S::Vec::Zero();
  if (!touch.is_stop) return respond(law, gap, still);
  double states[kMostLawStates];
  law.rest({0, gap, still, states}, states);
  LawTangents all;
  law.linearize({0, gap, still, states}, all);
  BasicResponse<S> out;
  out.force = all.force;
  out.stiffness = all.stiffness;
  return out;
}

// By bisection, which works for any power of the depth.
double depth_at(const BasicLaw<S>& law, const Touch& touch, double force) {
  const auto missing = [&](double depth) { return force - pressing(touch, respond_at_rest(law, touch, depth).force); };
  double low = 0, high = ContactForce::kUsualDepth;
  for (int i = 0; i < 60 && missing(high) > 0; ++i) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (missing(middle) > 0 ? low : high) = middle;
  }
  return high;
}

// The sum over all bodies, as they would move if touching surfaces did not push [N].
double sum_of_loads(const System& system, const State& state) {
  State free = state;
  start_forces(system, false, free);
  double sum = 0;
  for (std::size_t i = 0; i < free.a.size(); ++i) sum += system.bodies[i].mass[0] * free.a[i].head<2>().norm();
  return sum;
}

// The largest penetration of surfaces, or of a coordinate into its stop; minus infinity for a stop that is not reached.
double depth_in(const BasicLaw<S>& law, const S::Vec& gap) {
  const std::optional<StopBreach> breach = law.breach(gap);
  return std::max(law.penetration(gap), breach ? breach->depth : -std::numeric_limits<double>::infinity());
}

// A lightly loaded contact is soft, so the stiffness is that under `load`, with lever arm `length` where the contact holds an angle.
std::optional<Touch> find_touch(const System& system, int j, const JointKinematics& r, double within, double at_rest, double load, double length) {
  const BasicLaw<S>& law = system.joints[j].law;
  if ((law.ideal_limit() || law.feeds()) && !law.has_stops()) return std::nullopt;
  constexpr double kProbe = ContactForce::kUsualDepth;  // [m] or [rad]
  for (int k = 0; k < S::kDof; ++k)
    for (const double sign : {1.0, -1.0}) {
      Touch touch{j, k, sign, 0, r.gap, system.joints[j].free_mask[k] != 0};
      const double lever = k < S::kDim ? 1 : length, deep = depth_in(law, gap_at(touch, kProbe)), depth = std::max(depth_in(law, r.gap), deep - kProbe);
      if (!(std::abs(depth) * lever <= within) || !(deep - depth > 0.5 * kProbe)) continue;
      if (touch.is_stop) touch.beside = respond_at_rest(law, touch, 0).force[k];
      const double pressed = load > 0 ? std::max(depth_at(law, touch, load * lever), kProbe) : kProbe;
      touch.stiffness = respond_at_rest(law, touch, pressed).stiffness(k, k);
      if (touch.stiffness > 0 && std::abs(r.rate[k]) * lever <= at_rest) return touch;
    }
  return std::nullopt;
}

std::vector<Touch> find_touches(const System& system, const State& state) {
  const double length = characteristic_length(system, state.q), within = kAsStated * length, at_rest = kFits * system.largest_speed(state.v);
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  kinematics_at(system, state.t, state.q, state.v, m, r);
  const double load = sum_of_loads(system, state);
  std::vector<Touch> touches;
  for (int j = 0; j < system.n_joints(); ++j)
    if (const std::optional<Touch> touch = find_touch(system, j, r[j], within, at_rest, load, length)) touches.push_back(*touch);
  return touches;
}

// Springs in place of the contacts and stops; they push and pull about the position of first touch.
System with_springs(const System& system, const std::vector<Touch>& touches) {
  System firm = system;
  for (const Touch& touch : touches) {
    JointData& joint = firm.joints[touch.joint];
    BushingLaw spring;
    spring.K(touch.k, touch.k) = touch.stiffness;
    spring.offset = touch.gap;
    if (touch.is_stop) {
      joint.law = joint.law.holding_law();
      joint.law.add(BasicLaw<S>(spring).parts().front()->clone());
    } else {
      joint.law = BasicLaw<S>(spring);
    }
    joint.held[touch.k] = true;
    joint.free_mask[touch.k] = 0;
  }
  return firm;
}

// The sum of the translational deflections of all joints under the forces that they carry [m]: about the largest displacement of a body by them.
double sum_of_deflections(const System& system, const State& state) {
  double sum = 0;
  for (int j = 0; j < system.n_joints(); ++j) {
    const S::Vec stiffness = system.joints[j].law.engaged_stiffness();
    for (int k = 0; k < S::kDim; ++k)
      if (system.joints[j].held[k] && stiffness[k] > 0) sum += std::abs(state.force[j][k]) / stiffness[k];
  }
  return sum;
}

// The joints of `all` that are not among `pressed`.
std::vector<int> others(const std::vector<Touch>& all, const std::vector<Touch>& pressed) {
  std::vector<int> joints;
  for (const Touch& touch : all)
    if (std::none_of(pressed.begin(), pressed.end(), [&touch](const Touch& one) { return one.joint == touch.joint; })) joints.push_back(touch.joint);
  return joints;
}

// What a start's touching surfaces turn out to do: those that press, and the joints whose surfaces would have to pull.
struct Pressing {
  std::vector<Touch> pressed;
  std::vector<int> idle;
};

// `state` stays as it is if no forces are found.
Pressing press(const System& system, State& state) {
  const std::vector<Touch> all = find_touches(system, state);
  std::vector<Touch> touches = all;
  State carried = state;
  const double length = characteristic_length(system, state.q);
  double ajar = kAsStated * length;  // opening of contacts that would pull; more than the loads deflect stiff joints
  while (!touches.empty()) {
    carried = state;
    const System firm = with_springs(system, touches);
    start_forces(firm, true, carried);
    ajar = std::max(ajar, std::min(sum_of_deflections(firm, carried), kMostAjar * length));
    const double nothing = kFits * largest_force(carried.force);
    const auto pulls = [&](const Touch& touch) { return !(pressing(touch, carried.force[touch.joint]) > nothing); };
    if (std::erase_if(touches, pulls) == 0) break;
  }
  if (all.empty()) return {};
  if (touches.empty()) {
    carried = state;
    start_forces(system, false, carried);
  }
  for (const Touch& touch : all) carried.gap[touch.joint][touch.k] = gap_at(touch, -ajar)[touch.k];
  for (Touch& touch : touches) {
    touch.depth = depth_at(system.joints[touch.joint].law, touch, pressing(touch, carried.force[touch.joint]));
    carried.gap[touch.joint][touch.k] = gap_at(touch, touch.depth)[touch.k];
  }
  BasicInverseDynamics<S>(with_springs(system, all)).move_onto_gaps(carried);
  state.q = carried.q;
  state.v = carried.v;
  std::vector<int> idle = others(all, touches);
  return {std::move(touches), std::move(idle)};
}

// The law with `replacement(i)` for those of its parts i that hold nothing, as stops do; its states keep their order, as holding parts come first.
template <class Replacement>
BasicLaw<S> with_other_parts(const BasicLaw<S>& law, const Replacement& replacement) {
  BasicLaw<S> out = law.holding_law();
  for (std::size_t i = 0; i < law.parts().size(); ++i)
    if (!law.parts()[i]->holds()) out.add(replacement(i));
  return out;
}

// Sets the lock along the tangent of its stop's law at this depth.
void set_tangent(const System& system, double depth, StopLock& stop) {
  Touch touch{stop.joint, stop.lock.component, stop.sign, 0, stop.stop * S::Vec::Unit(stop.lock.component), true};
  touch.beside = respond_at_rest(system.joints[stop.joint].law, touch, 0).force[touch.k];
  const BasicResponse<S> here = respond_at_rest(system.joints[stop.joint].law, touch, depth);
  stop.lock = {touch.k, here.stiffness(touch.k, touch.k), gap_at(touch, depth)[touch.k], here.force[touch.k] - touch.beside};
}

StopLock lock_for(const System& system, const Touch& touch) {
  StopLock out{touch.joint, {touch.k}, touch.gap[touch.k], touch.sign};
  set_tangent(system, touch.depth, out);
  return out;
}

// Sets all locks along the tangents of their stops at the loads that the locks find, and removes those that would have to pull.
void find_tangents(const System& system, const State& state, std::vector<StopLock>& stops) {
  bool found = false;
  for (int pass = 0; pass < kRedundantPasses && !found && !stops.empty(); ++pass) {
    State trial = state;
    start_forces(with_locks_for_stops(system, stops), true, trial);
    found = true;
    for (std::size_t i = stops.size(); i-- > 0;) {
      const double force = stops[i].lock.preload, depth = stops[i].sign * (trial.gap[system.joints.size() + i][stops[i].lock.component] - stops[i].stop);
      if (depth > 0) set_tangent(system, depth, stops[i]);
      else stops.erase(stops.begin() + static_cast<std::ptrdiff_t>(i));
      found = found && depth > 0 && std::abs(stops[i].lock.preload - force) <= kFits * std::abs(force);
    }
  }
}

}  // namespace

System with_locks_for_stops(const System& system, const std::vector<StopLock>& stops) {
  System out = with_locks(system, stops);
  for (const StopLock& stop : stops) {
    const BasicLaw<S>& law = system.joints[stop.joint].law;
    out.joints[stop.joint].law = with_other_parts(law, [&law](std::size_t i) { return law.parts()[i]->stops() ? inert_states(law.parts()[i]->n_states()) : law.parts()[i]->clone(); });
  }
  out.finish();
  return out;
}

void put_stops_back(const System& system, const std::vector<StopLock>& stops, Assembly& assembly) {
  const System started = std::exchange(assembly.system, system);  // friction has noted in its law which way it slips
  for (int j = 0; j < system.n_joints(); ++j) assembly.system.joints[j].law = started.joints[j].law;
  for (const StopLock& stop : stops) {
    const BasicLaw<S>&real = system.joints[stop.joint].law, &law = started.joints[stop.joint].law;
    assembly.system.joints[stop.joint].law = with_other_parts(law, [&](std::size_t i) { return (real.parts()[i]->stops() ? real : law).parts()[i]->clone(); });
  }
  assembly.system.finish();
  remove_locks(system.n_joints(), assembly);
  State& state = assembly.state;
  State at_rest = state;
  rest_laws(assembly.system, at_rest);
  for (const StopLock& stop : stops) {
    int first = system.joints[stop.joint].first_state;
    for (const auto& part : assembly.system.joints[stop.joint].law.parts()) {
      if (part->stops()) std::copy_n(at_rest.law_state.begin() + first, part->n_states(), state.law_state.begin() + first);
      first += part->n_states();
    }
  }
  find_forces_and_accelerations(assembly.system, state);
}

std::vector<StopLock> press_touching_surfaces(Assembly& assembly) {
  const System& system = assembly.system;
  auto [pressed, idle] = press(system, assembly.state);
  std::vector<StopLock> locks;
  for (const Touch& touch : pressed)
    if (touch.is_stop) locks.push_back(lock_for(system, touch));
  find_tangents(system, assembly.state, locks);
  std::erase_if(idle, [&system](int j) { return system.joints[static_cast<std::size_t>(j)].law.has_stops(); });  // as in a cylinder that begins to extend
  if (idle.empty()) return locks;
  std::string note = "surfaces that touch at the start without pressing on each other: " + names_of_joints(system, idle);
  if (std::any_of(idle.begin(), idle.end(), [&system](int j) { return system.joints[static_cast<std::size_t>(j)].type != "cam"; }))
    note += "; if one of them should press, the other side of its edge may be meant (the first marker's axis turned by 180 deg: it presses along +y)";
  assembly.notes.push_back(std::move(note));
  return locks;
}

bool hold_at_stops_passed(Assembly& unloaded, const Assembly& started, std::vector<StopLock>& stops) {
  const System& system = unloaded.system;
  const std::vector<JointKinematics> before = kinematics_at_rest(system, unloaded.state.q), now = kinematics_at_rest(system, started.state.q);
  const std::size_t known = stops.size();
  std::string names;
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicLaw<S>& law = system.joints[j].law;
    const std::optional<StopBreach> breach = law.has_stops() ? law.breach(now[j].gap) : std::nullopt;
    if (!breach || !(breach->depth > ContactForce::kUsualDepth) || law.breach(before[j].gap)) continue;
    if (std::any_of(stops.begin(), stops.end(), [j](const StopLock& stop) { return stop.joint == j; })) continue;
    StopLock stop{j, {breach->component}, breach->stop, breach->upper ? 1.0 : -1.0};
    set_tangent(system, ContactForce::kUsualDepth, stop);
    stops.push_back(stop);
    names += (names.empty() ? "" : ", ") + system.joints[j].name;
  }
  if (names.empty()) return false;
  find_tangents(system, unloaded.state, stops);
  if (stops.size() > known) unloaded.notes.push_back("joints that start at a stop, to which the loads of t = 0 push them: " + names);
  return true;
}

}  // namespace pintle

#include "start/equilibrium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "integrators/absolute/radau_stepper.h"
#include "integrators/thresholds.h"
#include "kinematics/position_search.h"
#include "laws/linear.h"
#include "pintle/simulate.h"
#include "start/preload.h"
#include "start/slow_manifold.h"
#include "start/stiction.h"
#include "system/build.h"

namespace pintle {
namespace {

using S = Planar;

constexpr double kTolerance = 1e-5;               // tolerance of the creep's steps: where it ends does not depend on the path
constexpr double kAtRest = 1e-11;                 // as a fraction of the largest force: a body counts as resting if the unbalanced force is below this, where roundoff permits
constexpr int kSwings = 100;                      // steps in which neither the unbalanced force halves nor time grows by kLonger: the mechanism then swings, or has come as near as roundoff permits
constexpr double kLonger = 4;                     // growth of time that counts as progress: steps grow, as where a weight sinks steadily. With 2 and with 8 a post that sticks on its way (test SettledStart) rests there, not where it would without friction; all others rest in the same place
constexpr double kThicker = 4;                    // ratio of the next fluid's drag rate to that of one in which the mechanism swings
constexpr double kFirstStep = 1e-3;               // first step, as a fraction of the time constant of the creep
constexpr double kLongest = 1e6;                  // longest creep, as a multiple of its time constant: a mechanism that still moves then has no position of rest
constexpr std::uint64_t kMostCreepSteps = 50000;  // upper limit on the number of steps of the creep
constexpr double kUnbalanced = 1e-6;              // as a fraction of the largest force: limit on the unbalanced force at a start in equilibrium
constexpr double kNudge = 1e-6, kLeaves = 1e-3;   // as fractions of the mechanism's size: how far it is moved from its equilibrium, and how far away it must end for that equilibrium to count as unstable

// The model frozen at t = 0: motors hold their positions.
Model standing_still(Model model) {
  const auto fix = [](Expression& e) { e = e.substitute("t", 0); };
  for (Joint& joint : model.joints)
    for (auto& [key, function] : joint.functions) fix(function);
  for (AppliedForce& force : model.forces) {
    for (Expression& e : force.force) fix(e);
    fix(force.torque);
  }
  for (Motor& motor : model.motors) {
    if (motor.kind == MotorKind::kSpeed) motor.law = Expression::constant(0);
    else fix(motor.law);
  }
  for (Body& body : model.bodies) {
    body.velocity.reset();
    body.spin.reset();
  }
  return model;
}

// The model without friction.
Model without_friction(Model model) {
  for (Joint& joint : model.joints) {
    joint.friction = LawChoice{"", {}};
    joint.law.values.erase("static_friction");
    if (const auto own = joint.law.values.find("friction_coefficient"); own != joint.law.values.end()) own->second = {0};
  }
  return model;
}

// A law between the ground and a body, in the world's axes.
JointData tied_to_ground(const std::string& name, int body, const State& state, const LinearLaw& law) {
  JointData joint;
  joint.name = name;
  joint.type = "fixed";
  joint.at.b = body;
  joint.at.F = S::Frame::at(state.q[body].head<2>(), state.q[body][2]);
  joint.law = BasicLaw<S>(law);
  for (int k = 0; k < S::kDof; ++k) {
    joint.held[k] = law.k[k] > 0;
    joint.free_mask[k] = joint.held[k] ? 0 : 1;
  }
  return joint;
}

// Whether a servo moves the body: the servo then holds it, and would not carry what a spring in parallel carries.
bool has_servo(const System& system, int body) {
  return std::any_of(system.joints.begin(), system.joints.end(), [body](const JointData& joint) { return joint.servo >= 0 && (joint.at.a == body || joint.at.b == body); });
}

// The system in a fluid that takes `rate` times its momentum from each body per second. Held coordinates are held as stiffly as by the stiffest joint.
System in_fluid(const Model& model, const System& system, const State& state, double rate) {
  System out = system;
  const double stiffest = largest_stiffness(system), hold = stiffest > 0 ? stiffest : 1e8;
  for (int i = 0; i < system.n_bodies(); ++i) {
    const S::Vec& mass = system.bodies[i].mass;
    LinearLaw law;
    law.c = rate * mass;
    for (int k = 0; k < S::kDof; ++k)
      if (model.bodies[i].hold[k] && !has_servo(system, i)) law.k[k] = k < 2 ? hold : hold * mass[2] / mass[0];
    out.joints.push_back(tied_to_ground(model.bodies[i].name, i, state, law));
  }
  out.finish();
  return out;
}

// A couple counts as a force at the largest radius of gyration.
double largest_load(const System& system, const State& state) {
  double largest = std::max(largest_force(state.force), largest_couple<S>(state.force) / system.largest_radius_of_gyration());
  for (const BodyData& body : system.bodies) largest = std::max(largest, body.gravity.head<2>().norm());
  return largest;
}

// The largest force that drives a body against the fluid and against its inertia; a couple counts as a force at the body's radius of gyration. Where a
// body swings, the two vanish alternately.
double largest_unrest(const System& system, const State& state, double rate, int& body) {
  double largest = 0;
  for (int i = 0; i < system.n_bodies(); ++i) {
    const S::Vec p = system.bodies[i].mass.cwiseProduct(rate * state.v[i].cwiseAbs() + state.a[i].cwiseAbs());
    const double unrest = std::hypot(p[0], p[1], p[2] / system.bodies[i].radius_of_gyration());
    if (unrest <= largest) continue;
    largest = unrest;
    body = i;
  }
  return largest;
}

// The reciprocal of the time in which the loads move the mechanism by its size.
double rate_of_motion(const System& system, const State& state) {
  double fastest = 0;
  for (int i = 0; i < system.n_bodies(); ++i) {
    fastest = std::max(fastest, state.a[i].head<2>().norm());
    fastest = std::max(fastest, std::abs(state.a[i][2]) * system.bodies[i].radius_of_gyration());
  }
  return fastest > 0 ? std::sqrt(fastest / characteristic_length(system, state.q)) : 1;
}

// Roundoff of the joint forces.
double rounding_of(const System& system, const State& state) { return kLastBits * largest_stiffness(system) * characteristic_length(system, state.q); }

// The path of a mechanism through a fluid to where it rests. In the first fluid the loads move it by its size in about one time constant. Springs that
// are stiff compared with these loads make it swing there, with steps that cannot grow. The fluid then becomes thicker: the creep takes longer, but few
// steps.
class Creep {
 public:
  Creep(const Model& model, const System& system, const State& assembled)
      : model_(model), system_(system), assembled_(assembled), first_rate_(2 * rate_of_motion(system, assembled)), rate_(first_rate_), fluid_(in_fluid(model, system, assembled, rate_)) {}

  const System& fluid() const { return fluid_; }

  /// The state in which it ends. The second creep has steps as accurate as the loads left at rest require; on the way the loads may have been much larger.
  State go(State from) {
    std::uint64_t steps = 0;
    creep_to_rest(from, steps);
    creep_to_rest(from, steps);
    return from;
  }

 private:
  void creep_to_rest(State& state, std::uint64_t& steps) {
    while (!creep(state, steps)) {
      if (steps > kMostCreepSteps)
        throw AssemblyError(fmt::format("start = \"settled\": body {} still moves after {} steps.\n  Try positions nearer to the equilibrium, or start = \"assembled\".", name(), kMostCreepSteps));
      rate_ *= kThicker;
      fluid_ = in_fluid(model_, system_, assembled_, rate_);
      start_forces(fluid_, false, state);
    }
  }

  // Continues while steps reduce the unbalanced force. False if the mechanism swings. Long steps bring back some of the roundoff that shorter ones had removed: if
  // nothing else is left, takes the state with the smallest unbalanced force.
  bool creep(State& state, std::uint64_t& steps) {
    BasicRadauStepper<S> stepper(fluid_, kTolerance);
    state.t = 0;
    stepper.start(state, kFirstStep / rate_);
    const double longest = kLongest * rate_ / (first_rate_ * first_rate_), rounding = rounding_of(system_, assembled_);
    double least = std::numeric_limits<double>::infinity(), halved = least, mark = 0;
    State calmest;
    const auto rests = [&] {
      if (least > rounding) return false;
      state = calmest;
      return true;
    };
    for (int since = 0; since < kSwings; ++since, ++steps) {
      if (!stepper.step(longest)) throw AssemblyError("start = \"settled\": no position of rest was found: " + stepper.failure() + "\n  Try positions nearer to the equilibrium, or start = \"seated\" or \"assembled\".");
      state = stepper.state();
      const double unrest = largest_unrest(fluid_, state, rate_, body_);
      if (unrest <= kAtRest * largest_load(fluid_, state)) return true;
      if (unrest < least) {
        least = unrest;
        calmest = state;
      }
      if (state.t > 0.99 * longest) {
        if (rests()) return true;
        throw AssemblyError(fmt::format("start = \"settled\": body {} does not come to rest: nothing stops it, or a load keeps driving it.\n  Try hold in its table, something that it can rest on, or start = \"assembled\".", name()));
      }
      if (unrest > 0.5 * halved && state.t <= kLonger * mark) continue;
      halved = std::min(unrest, halved);
      mark = state.t;
      since = 0;
    }
    return rests();
  }
  const std::string& name() const { return model_.bodies[static_cast<std::size_t>(body_)].name; }

  const Model& model_;
  const System& system_;
  const State& assembled_;
  const double first_rate_;
  double rate_;
  System fluid_;
  int body_ = 0;
};

struct Move {
  double way = 0, turn = 0;  // largest displacement and rotation of any body [m], [rad]
};
Move largest_move(const Vecs& from, const Vecs& to) {
  Move move;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const S::Vec d = to[i] - from[i];
    move.way = std::max(move.way, d.head<2>().norm());
    move.turn = std::max(move.turn, std::abs(d[2]));
  }
  return move;
}

std::string in_words(const Move& move) { return fmt::format("{:.3g} m and {:.3g} deg", move.way, move.turn * 360 / kTurn); }

// The given equilibrium if it is stable; otherwise the position of rest that the mechanism reaches from it when disturbed.
State stable_rest(Creep& creep, const State& at_rest, std::vector<std::string>& notes) {
  const double size = characteristic_length(creep.fluid(), at_rest.q);
  State nudged = at_rest;
  for (std::size_t i = 0; i < nudged.q.size(); ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;
    nudged.q[i] += kNudge * S::Vec(sign * size, -0.7 * sign * size, 0.8);
  }
  start_forces(creep.fluid(), false, nudged);
  State again = creep.go(nudged);
  const Move move = largest_move(at_rest.q, again.q);
  if (move.way < kLeaves * size && move.turn < kLeaves) return at_rest;
  notes.push_back("settled: the first equilibrium is unstable: when nudged, the mechanism leaves it and comes to rest " + in_words(move) + " away, where it starts");
  return again;
}

struct Unbalanced {
  double size;  // [N]
  std::size_t body;
};
// The largest force that accelerates a body, if it exceeds roundoff.
std::optional<Unbalanced> unbalanced(const Assembly& start) {
  const System& system = start.system;
  const State& state = start.state;
  Unbalanced largest{0, 0};
  for (std::size_t i = 0; i < state.a.size(); ++i) {
    const BodyData& body = system.bodies[i];
    const double force = std::hypot(body.mass[0] * state.a[i].head<2>().norm(), body.mass[2] * state.a[i][2] / body.radius_of_gyration());
    if (force > largest.size) largest = {force, i};
  }
  if (!(largest.size > std::max(kUnbalanced * largest_load(system, state), rounding_of(system, state)))) return std::nullopt;
  return largest;
}

bool holds_bodies(const Model& model) {
  return std::any_of(model.bodies.begin(), model.bodies.end(), [](const Body& body) { return body.hold[0] || body.hold[1] || body.hold[2]; });
}

// Coordinates held while the mechanism comes to rest are released when the run begins. Sticking surfaces then carry what the hold carried, as far as they can; the
// deflections that their springs acquired on the way are no guide to it.
void hold_by_friction(Assembly& start) {
  if (std::none_of(start.system.joints.begin(), start.system.joints.end(), [](const JointData& joint) { return joint.law.has_friction(); })) return;
  const Assembly given = start;
  start_forces(start.system, false, start.state);
  const BasicSettledStart<S> unloaded = start;
  start.system = settle_with_stiction(std::move(start.system), unloaded, 0, 0, start);
  const auto now = unbalanced(start);
  if (now && !(now->size < unbalanced(given)->size)) start = given;
}

}  // namespace

Assembly start_in_equilibrium(const Model& model, bool smooth) {
  const Model still = standing_still(smooth ? without_friction(model) : model);
  Assembly start = assemble_unloaded(still, build_system(still));
  start_forces(start.system, false, start.state);
  Creep creep(still, start.system, start.state);
  State from = start.state;
  start_forces(creep.fluid(), false, from);
  std::vector<std::string> notes;
  const State at_rest = stable_rest(creep, creep.go(from), notes);
  const Vecs assembled = start.state.q;
  Assembly out = assemble_unloaded(model, build_system(model));
  State& state = out.state;
  state.q = at_rest.q;
  for (S::Vec& v : state.v) v.setZero();
  start_forces(out.system, false, state);
  const std::size_t joints = out.system.joints.size();
  std::copy_n(at_rest.gap.begin(), joints, state.gap.begin());
  if (!smooth) state.law_state = at_rest.law_state;
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  kinematics_at(out.system, state.t, state.q, state.v, m, r);
  for (std::size_t j = 0; j < joints; ++j) state.gap_rate[j] = r[j].rate;
  find_law_rates(out.system, state);
  find_joint_forces(out.system, state);
  find_accelerations(out.system, m, r, state);
  if (unbalanced(out) && holds_bodies(model)) hold_by_friction(out);
  out.notes.push_back("settled: the mechanism came to rest " + in_words(largest_move(assembled, state.q)) + " from where it was assembled");
  out.notes.insert(out.notes.end(), notes.begin(), notes.end());
  if (const auto force = unbalanced(out))
    out.notes.push_back(fmt::format("settled: held coordinates, or forces that depend on rates, are not in equilibrium: {:.3g} N accelerate body {} from the start", force->size, model.bodies[force->body].name));
  return out;
}

}  // namespace pintle

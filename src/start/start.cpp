#include "start/start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/constants.h"
#include "mobility/constraint_rows.h"
#include "mobility/mobility.h"
#include "pintle/simulate.h"
#include "start/assembly_notes.h"
#include "start/equilibrium.h"
#include "start/ideal_rows.h"
#include "start/preload.h"
#include "start/relative/tree_start.h"
#include "start/seat.h"
#include "start/settle_joints.h"
#include "start/stiction.h"
#include "start/touching.h"
#include "system/build.h"
#include "system/joint_tree.h"

namespace pintle {
namespace {

// These equations do not follow the states of joints that stay compliant among ideal ones, such as what a contact remembers of its touch.
void demand_no_states(const System& system) {
  for (const JointData& joint : system.joints)
    if (!joint.ideal && !joint.law.feeds() && joint.law.n_states() > 0)
      throw AssemblyError(fmt::format("joint {}: equations with ideal joints do not integrate the states of its law, such as the approach speed of a contact: its forces would be wrong.\n  Try equations = \"newtonian\", or \"relative\" (in compare: --against relative), in which joints marked ideal = true are ideal and all others force laws.", joint.name));
}

// Ideal joints carry no preload: their loops are closed exactly. Joints that stay force laws begin with the deflections that carry their loads.
// What constraints cannot close, compliant joints would be preloaded by.
void note_open_constraints(Equations equations, Assembly& assembly) {
  const System& system = assembly.system;
  const double rounding = kAsStated * mechanism_size(system, assembly.state.q);
  const std::vector<JointKinematics> r = kinematics_at_rest(system, assembly.state.q);
  std::vector<int> open;
  double widest = 0;
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& joint = system.joints[j];
    if (!joint.ideal || joint.servo >= 0) continue;
    const double gap = std::hypot(joint.held[0] ? r[j].gap[0] : 0, joint.held[1] ? r[j].gap[1] : 0);
    if (!(gap > rounding)) continue;
    open.push_back(j);
    widest = std::max(widest, gap);
  }
  if (open.empty()) return;
  const char* what = equations == Equations::kPenalty ? "penalties make of it large forces that mean nothing, in place of a preload: use equations = \"newtonian\""
                                                      : "constraints omit the preload that this means for joints that yield, as with equations = \"newtonian\"";
  assembly.notes.push_back(fmt::format("joints that stay open by up to {:.2g} m: {}; {}", widest, names_of_joints(system, open), what));
}

Assembly ideal_start(Model model, double known_span) {
  const bool loaded = is_preloaded(model.simulate.start);
  if (model.simulate.start == Start::kAssembled) model.simulate.start = Start::kUnloaded;
  demand_no_states(make_ideal(model, build_system(model)));  // no position would help
  Assembly assembly = assemble(model);
  IdealRows rows = choose_ideal_rows(make_ideal(model, std::move(assembly.system)), assembly.state.q);
  assembly.system = std::move(rows.system);
  assembly.notes.insert(assembly.notes.end(), rows.notes.begin(), rows.notes.end());
  assembly.not_unique = std::move(rows.not_unique);
  note_open_constraints(model.simulate.equations, assembly);
  const System& system = assembly.system;
  std::vector<int> laws;
  for (int j = 0; j < system.n_joints(); ++j)
    if (!system.joints[j].ideal && !system.joints[j].law.engaged_stiffness().isZero(0)) laws.push_back(j);
  if (laws.empty()) return assembly;
  assembly.notes.push_back("joints that remain force laws among ideal joints: " + names_of_joints(system, laws) + "; stiff or strongly damped ones take many steps with these equations");
  if (!loaded) return assembly;
  start_forces(assembly.system, true, assembly.state);
  settle_joints(assembly.system, model.simulate.duration, known_span, assembly);
  return assembly;
}

// Loads that deflect the joints far at the start are often unintended: a damper driven by a chosen velocity, a joint softer than expected.
void note_far_deflection(const System& system, const Vecs& assembled, const State& state, std::vector<std::string>& notes) {
  constexpr double kFarTurn = 0.05, kFarWay = 0.05;  // [rad]; as a fraction of the mechanism's size
  const double size = characteristic_length(system, assembled);
  double far = 1;
  std::string note;
  for (std::size_t i = 0; i < assembled.size(); ++i) {
    const Planar::Vec d = state.q[i] - assembled[i];
    const double turn = std::abs(d[2]), way = d.head<2>().norm(), share = std::max(turn / kFarTurn, way / (kFarWay * size));
    if (share <= far) continue;
    far = share;
    note = fmt::format("the loads of t = 0 deflect the joints so far that body {} starts {:.3g} m and {:.3g} deg from where it was assembled; if that was not meant, look at the loads and velocities of the start, or try start = \"unloaded\"",
                       system.bodies[i].name, way, turn * 360 / kTurn);
  }
  if (!note.empty()) notes.push_back(std::move(note));
}

// The deflections of joints and actuators are hardly ever meant to move coordinates that are held during assembly.
void note_held_that_moved(const Model& model, const System& system, const Vecs& assembled, const State& state, std::vector<std::string>& notes) {
  constexpr double kFar = 0.02;  // [rad], and as a fraction of the mechanism's size. With half of it the belt drive of the collection, whose belt stretches by 0.7 deg, gets the note
  const std::string moved = held_that_moved(model, assembled, state.q, kFar, kFar * characteristic_length(system, assembled));
  if (moved.empty()) return;
  const bool at_rest = std::none_of(model.bodies.begin(), model.bodies.end(), [](const Body& body) { return body.velocity.value_or(Vec2{}) != Vec2{} || body.spin.value_or(0) != 0; });
  notes.push_back("the joints deflect under the loads of t = 0, and coordinates held during assembly move with them: " + moved +
                  (at_rest ? "; start = \"settled\" leaves them in place and reports what is not in equilibrium there" : "; start = \"unloaded\" leaves them in place"));
}

// Where surfaces with play are as assembled.
void note_play(const Model& model, Assembly& assembly) {
  if (model.simulate.start != Start::kAssembled) return;
  if (const std::string loose = names_of_joints_in_play(assembly.system, assembly.state); !loose.empty())
    assembly.notes.push_back("joints start in the middle of their play (" + loose + ") and strike its sides first: the largest forces may be those of the start; start = \"seated\" begins where the loads press them");
}

// The assembled mechanism under its loads, its joints on their slow motion. `stops` press from the first instant.
Assembly with_loads(const Model& model, Assembly assembly, const std::vector<StopLock>& stops, double known_span) {
  const std::optional<System> with_stops = stops.empty() ? std::nullopt : std::optional(assembly.system);
  if (with_stops) assembly.system = with_locks_for_stops(*with_stops, stops);
  std::optional<BasicSettledStart<Planar>> unloaded;
  if (std::any_of(assembly.system.joints.begin(), assembly.system.joints.end(), [](const JointData& joint) { return joint.law.has_friction(); })) unloaded = assembly;
  start_forces(assembly.system, true, assembly.state);
  note_play(model, assembly);
  const double duration = model.simulate.duration;
  if (unloaded) assembly.system = settle_with_stiction(std::move(assembly.system), *unloaded, duration, known_span, assembly);
  else settle_joints(assembly.system, duration, known_span, assembly);
  if (with_stops) put_stops_back(*with_stops, stops, assembly);
  return assembly;
}

Assembly start_of_free_bodies(const Model& model, System system, double known_span) {
  Assembly assembly = assemble_unloaded(model, std::move(system));
  const bool loaded = is_preloaded(model.simulate.start);
  const Vecs assembled = assembly.state.q;
  if (model.simulate.start == Start::kSeated) note_seated(assembly);
  std::vector<StopLock> stops = loaded ? press_touching_surfaces(assembly) : std::vector<StopLock>{};
  if (!loaded || assembly.system.joints.empty()) {
    start_forces(assembly.system, loaded, assembly.state);
    note_play(model, assembly);
    return assembly;
  }
  if (std::any_of(assembly.system.joints.begin(), assembly.system.joints.end(), [](const JointData& joint) { return joint.law.has_stops(); })) {
    Assembly started = with_loads(model, assembly, stops, known_span);
    assembly = hold_at_stops_passed(assembly, started, stops) ? with_loads(model, std::move(assembly), stops, known_span) : std::move(started);
  } else {
    assembly = with_loads(model, std::move(assembly), stops, known_span);
  }
  note_far_deflection(assembly.system, assembled, assembly.state, assembly.notes);
  note_held_that_moved(model, assembly.system, assembled, assembly.state, assembly.notes);
  return assembly;
}

// The assembled mechanism, if it is at rest.
std::optional<Assembly> start_at_rest(Model model) {
  model.simulate.start = Start::kSeated;
  try {
    Assembly assembly = start_of_free_bodies(model, build_system(model), 0);
    if (is_at_rest(assembly.system, assembly.state)) return assembly;
  } catch (const AssemblyError&) {  // the caller reports why the run's own start failed
  }
  return std::nullopt;
}

// Where the mechanism rests if there is no friction on the way there: it rests there with friction, too.
std::optional<Assembly> smooth_rest(const Model& model) {
  try {
    Assembly assembly = start_in_equilibrium(model, true);
    assembly.notes.push_back("settled: no position of rest was found with friction; the mechanism starts where it rests without friction");
    return assembly;
  } catch (const AssemblyError&) {  // the caller reports why the run's own start failed
    return std::nullopt;
  }
}

// Where the creep finds no rest, as for a block held on its ramp by static friction alone, the assembled mechanism may itself be at rest.
Assembly settled_start(const Model& model) {
  try {
    return start_in_equilibrium(model);
  } catch (const AssemblyError&) {
    if (std::optional<Assembly> at_rest = start_at_rest(model)) {
      at_rest->notes.push_back("settled: the mechanism is at rest where it was assembled, and starts there");
      return std::move(*at_rest);
    }
    if (std::optional<Assembly> at_rest = smooth_rest(model)) return std::move(*at_rest);
    throw;
  }
}

// Equations that keep a gap at zero do not evaluate the joint's law, so they omit its friction, its detent and its stops too.
template <class IsIdeal>
void note_lost_laws(const System& system, const IsIdeal& is_ideal, std::vector<std::string>& notes) {
  for (int j = 0; j < system.n_joints(); ++j) {
    if (!is_ideal(j)) continue;
    const JointData& joint = system.joints[j];
    const auto is_detent = [](const auto& part) { return !part->holds() && !part->rubs() && !part->stops() && !part->feeds() && !part->depends_on_reaction_alone(); };
    const std::string name = "joint " + joint.name + (joint.law.feeds() ? "" : " is ideal");
    if (joint.law.has_friction()) notes.push_back(name + ": its friction is not in these equations");
    if (std::any_of(joint.law.parts().begin(), joint.law.parts().end(), is_detent)) notes.push_back(name + ": its detent is not in these equations");
    if (joint.law.has_stops()) notes.push_back(name + ": its stops are not in these equations, so that it moves through them");
  }
}

constexpr std::size_t kMostBodies = 200;  // finding the rank of the constraints of larger mechanisms takes long

// Joints of the tree are ideal in relative coordinates: how they share a load with the opened joints depends on which are opened.
void note_undetermined_reactions(const System& system, const JointTree& tree, Assembly& assembly) {
  if (system.bodies.size() > kMostBodies) return;
  const auto is_in_tree = [&](const std::string& name) {
    for (int j = 0; j < system.n_joints(); ++j)
      if (system.joints[j].name == name) return tree.in_tree(j);
    return false;
  };
  name_undetermined_reactions(check_mobility(system, assembly.state.q).redundancies, is_in_tree, "relative coordinates, in which only opened joints are compliant", assembly.notes, assembly.not_unique);
}

// Stages without coordinates do not solve for the gaps of joints whose lengths are driven.
void demand_coordinates(const System& system, const JointTree& tree) {
  if (tree.n() > 0) return;
  for (int j = 0; j < system.n_joints(); ++j)
    if (!tree.in_tree(j) && system.joints[j].driven >= 0)
      throw AssemblyError(fmt::format("joint {}: its length is driven, and ideal joints leave no coordinate that could move.\n  Try equations = \"newtonian\", in which they yield", system.joints[j].name));
}

// Several speed or position motors on fewer degrees of freedom: the differences between their demands deflect joints. Throws if these are constraints and cannot yield.
void note_or_refuse_conflicting_motors(const System& system, const Vecs& q, std::vector<std::string>& notes) {
  std::string names;
  int servos = 0;
  for (const JointData& joint : system.joints) {
    if (joint.servo < 0) continue;
    names += (servos++ > 0 ? ", " : "") + joint.name;
  }
  if (servos < 2 || system.bodies.size() > kMostBodies) return;
  const CheckMobility counts = check_mobility(system, q).counts;
  if (counts.rank < 0) return;
  const int held = counts.freedoms - counts.rank - counts.mobility_driven;  // degrees of freedom, by all motors
  if (held >= servos) return;
  const std::string freedom = held == 1 ? "one degree" : fmt::format("{} degrees", held), of_them = held == 1 ? "one" : std::to_string(held);
  if (std::any_of(system.joints.begin(), system.joints.end(), [](const JointData& joint) { return joint.servo >= 0 && joint.constrained; }))
    throw AssemblyError(fmt::format("motors {} together drive {} of freedom, and constraint equations do not say how they share it.\n  Try a speed or position for only {} of them, and a torque for the others; "
                                    "or equations = \"newtonian\", in which the joints yield", names, freedom, of_them));
  notes.push_back(fmt::format("motors {} together drive {} of freedom: the differences between their targets deflect the joints, and may cause the largest forces; prescribe a speed or position for only {} of them, and a torque for the others",
                              names, freedom, of_them));
}

Assembly start_as_asked(const Model& model, double known_span) {
  if (has_constraints(model.simulate.equations)) {
    Assembly assembly = ideal_start(model, known_span);
    const System& system = assembly.system;
    note_lost_laws(system, [&system](int j) { return system.joints[j].ideal || system.joints[j].law.n_states() > 0; }, assembly.notes);
    for (const JointData& joint : system.joints)
      if (model.simulate.equations == Equations::kRelativeAugmented && joint.law.depends_on_reaction_alone()) assembly.notes.push_back("joint " + joint.name + ": its teeth do not push the bodies apart in these equations, whatever its radial_force says");
    return assembly;
  }
  if (model.simulate.start == Start::kSettled) return settled_start(model);
  System system = build_system(model);
  if (model.simulate.equations != Equations::kRelative) return start_of_free_bodies(model, std::move(system), known_span);
  const JointTree tree(system);
  demand_coordinates(system, tree);
  Assembly assembly = start_of_free_bodies(model, with_stiff_tree(system, tree), known_span);
  if (!tree.all_free()) {
    for (int j = 0; j < system.n_joints(); ++j)
      if (tree.in_tree(j)) assembly.system.joints[j].law = system.joints[j].law;
    assembly.system.finish(&system);
    note_undetermined_reactions(system, tree, assembly);
    convert_to_tree(assembly.system, is_preloaded(model.simulate.start), assembly.state);
  }
  for (std::string& line : tree.notes()) assembly.notes.push_back(std::move(line));
  note_lost_laws(system, [&tree](int j) { return tree.in_tree(j); }, assembly.notes);
  return assembly;
}

}  // namespace

Assembly start_of_run(const Model& model, double known_span) {
  Assembly assembly = start_as_asked(model, known_span);
  if (known_span == 0) note_or_refuse_conflicting_motors(assembly.system, assembly.state.q, assembly.notes);
  return assembly;
}

}  // namespace pintle

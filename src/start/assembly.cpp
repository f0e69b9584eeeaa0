#include "start/assembly.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "dynamics/inverse_dynamics.h"
#include "joints/belt.h"
#include "kinematics/guess.h"
#include "kinematics/position_search.h"
#include "mobility/constraint_rows.h"
#include "pintle/simulate.h"
#include "start/assembly_notes.h"
#include "start/preload.h"
#include "start/seat.h"
#include "system/build.h"

namespace pintle {
namespace {

using S = Planar;

// Whether a joint that starts free, such as a slack rope, is further than roundoff from where it would act.
bool stands_apart(const JointData& joint, const S::Vec& gap, double size) {
  const S::Vec still = S::Vec::Zero();
  for (int k = 0; k < S::kDof; ++k)
    for (const double way : {kAsStated * size, -kAsStated * size})
      if (!is_apart(joint.law, S::Vec(gap + way * S::Vec::Unit(k)), still)) return false;
  return true;
}

// The velocities nearest to the stated ones, in the mass norm, that keep every gap of the joints that are not apart constant (servos follow
// their targets). Unstated velocities follow. Multiplier iteration, theory/assembly Eqs. (2.1)-(2.3).
void assemble_velocities(const Model& model, const System& system, const Vecs& q, Vecs& v) {
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  const Vecs still(q.size(), S::Vec::Zero());
  kinematics_at(system, 0, q, still, m, r);
  Vecs joint_weight(r.size(), S::Vec::Zero()), body_weight(q.size());
  const double size_of_mechanism = mechanism_size(system, q);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Body& body = model.bodies[i];
    const double move = body.velocity ? 1 : 1e-3, turn = body.spin ? 1 : 1e-3;
    body_weight[i] = system.bodies[i].mass.cwiseProduct(S::Vec(move, move, turn));
  }
  for (std::size_t j = 0; j < r.size(); ++j) {
    const JointData& joint = system.joints[j];
    const S::Vec stiff = joint.law.engaged_stiffness();
    const bool apart = is_open_contact(joint.law, r[j].gap, size_of_mechanism) || (!has_play(joint) && stands_apart(joint, r[j].gap, size_of_mechanism));
    for (int k = 0; k < 3; ++k) {
      if (!(stiff[k] > 0) || apart) continue;
      double mobility = 0;
      if (joint.at.a != kGround) mobility += r[j].GA().row(k).cwiseAbs2().dot(system.bodies[joint.at.a].mass.cwiseInverse());
      if (joint.at.b != kGround) mobility += r[j].GB().row(k).cwiseAbs2().dot(system.bodies[joint.at.b].mass.cwiseInverse());
      joint_weight[j][k] = mobility > 0 ? 1e5 / mobility : 0;
    }
  }
  LeastSquares equations(system);
  if (!equations.prepare(r, joint_weight, body_weight)) return;
  Vecs target = v, multiplier(r.size(), S::Vec::Zero()), x = v;
  Vecs wanted(r.size()), rhs;
  std::array<double, 2> open_before{};  // the gap rates' squares times the joints' weights, in the last two passes
  for (int iteration = 0; iteration < 60; ++iteration) {
    for (std::size_t j = 0; j < r.size(); ++j) wanted[j] = -r[j].rate + multiplier[j];  // at rest a servo's rate is minus its target's
    rhs = equations.pull(r, joint_weight, wanted);
    for (std::size_t i = 0; i < q.size(); ++i) rhs[i] += body_weight[i].cwiseProduct(target[i]);
    const Vecs& next = equations.solve(rhs);
    double change = 0, size = 1e-12;
    for (std::size_t i = 0; i < q.size(); ++i) {
      change = std::max(change, (next[i] - x[i]).cwiseAbs().maxCoeff());
      size = std::max(size, next[i].cwiseAbs().maxCoeff());
      for (int k = 0; k < 3; ++k)
        if (!(k < 2 ? model.bodies[i].velocity.has_value() : model.bodies[i].spin.has_value())) target[i][k] = next[i][k];
    }
    x = next;
    double open = 0;
    for (std::size_t j = 0; j < r.size(); ++j) {
      S::Vec rate = r[j].rate;
      add_gap(system.joints[j].at, r[j], x, rate);
      multiplier[j] -= rate;
      open += joint_weight[j].dot(rate.cwiseAbs2());
    }
    // What no pass closes is the motion itself: a misfit of redundant joints moves their gaps a little along with it. Two passes leave nineteen twentieths of that, and
    // a millionth of other gap rates.
    if (change < 1e-15 * size || (iteration > 2 && 10 * open > open_before[1])) break;
    open_before = {open, open_before[0]};
  }
  v = x;
}

// How far a joint is from being closed [m], [rad]; 0 in components that it does not hold.
std::array<double, 2> misfit(const JointData& joint, const JointKinematics& r) {
  const S::Vec stiff = joint.law.engaged_stiffness();
  S::Vec gap = gap_to_close(joint, r);
  for (int k = 0; k < 3; ++k)
    if (stiff[k] == 0) gap[k] = 0;
  return {gap.head<2>().norm(), std::abs(gap[2])};
}

std::vector<std::array<double, 2>> misfits(const System& system, const Vecs& q) {
  const std::vector<JointKinematics> r = kinematics_at_rest(system, q);
  std::vector<std::array<double, 2>> out;
  for (std::size_t j = 0; j < r.size(); ++j) out.push_back(misfit(system.joints[j], r[j]));
  return out;
}

constexpr double kOpenLength = 2e-3, kOpenAngle = 0.02;  // a joint is open that misses by more: as a fraction of the mechanism's size; [rad]

bool is_broken(const std::array<double, 2>& misfit, double size) { return misfit[0] > kOpenLength * size || misfit[1] > kOpenAngle; }

// Whether all joints except the open ones are closed, judged by these misfits.
bool all_closed(const std::vector<std::array<double, 2>>& left, const std::vector<bool>& open, double size) {
  for (std::size_t j = 0; j < left.size(); ++j)
    if (!open[j] && is_broken(left[j], size)) return false;
  return true;
}

// What is missing for a joint to be closed.
std::string length_and_angle(const std::array<double, 2>& misfit, double size) {
  const bool open = misfit[0] > kOpenLength * size, turned = misfit[1] > kOpenAngle;
  const std::string length = fmt::format("{:.4g} m", misfit[0]), angle = fmt::format("{:.4g} rad", misfit[1]);
  return open && turned ? length + " and " + angle : open ? length : angle;
}

// A loop that does not close leaves its misfit where joints are soft, which may be in another loop. The loop consists of the joints that, opened
// one at a time, let all others close.
std::string loop_that_lacks(const Model& model, const System& system, const Vecs& q, const std::vector<bool>& open) {
  const double size = mechanism_size(system, q);
  std::string names, lacks;
  for (std::size_t j = 0; j < open.size(); ++j) {
    if (open[j]) continue;
    Vecs trial = q;
    std::vector<bool> opened = open;
    opened[j] = true;
    PositionSearch(model, system, opened).run(trial);
    const auto left = misfits(system, trial);
    if (!all_closed(left, opened, size)) continue;
    if (lacks.empty()) lacks = length_and_angle(left[j], size);
    names += (names.empty() ? "" : ", ") + system.joints[j].name;
  }
  return names.empty() ? "" : fmt::format("\n  loop: {}; with any one of them open, all others close, leaving a gap of about {}", names, lacks);
}

// Takes all bodies out of `hold`. Returns the names of the coordinates that were in it.
std::vector<std::string> let_go(Model& model) {
  std::vector<std::string> held;
  for (Body& body : model.bodies)
    for (int k = 0; k < S::kDof; ++k)
      if (std::exchange(body.hold[k], false)) held.push_back(body.name + "." + kCoordinates[k]);
  return held;
}

bool is_closed(const std::array<double, 2>& misfit, double size) { return misfit[0] <= kAsStated * size && misfit[1] <= kAsStated; }

// Held coordinates that are slightly off, such as a rounded angle, leave joints open by as little. Moves them to where all joints close; false if there is no
// such position.
bool close_beside_holds(const Model& model, const System& system, const std::vector<bool>& open, Vecs& q, std::vector<std::string>& notes) {
  Model free = model;
  if (let_go(free).empty()) return false;
  Vecs trial = q;
  PositionSearch(free, system, open).run(trial);
  const auto after = misfits(system, trial);
  const double size = mechanism_size(system, q);
  for (std::size_t j = 0; j < after.size(); ++j)
    if (!open[j] && !is_closed(after[j], size)) return false;
  notes.push_back("held coordinates leave loops slightly open, and are adjusted: " + held_that_moved(model, q, trial, 0, 0));
  q = std::move(trial);
  return true;
}

// The joints in which bodies only touch, without those that are open: these bodies may be apart.
std::vector<std::size_t> contacts_of(const System& system, const std::vector<bool>& open) {
  std::vector<std::size_t> out;
  for (std::size_t j = 0; j < open.size(); ++j)
    if (!open[j] && std::isfinite(system.joints[j].law.penetration(S::Vec::Zero())) && !has_play(system.joints[j])) out.push_back(j);
  return out;
}

std::vector<bool> with_opened(std::vector<bool> open, const std::vector<std::size_t>& contacts) {
  for (const std::size_t j : contacts) open[j] = true;
  return open;
}

// Whether no joint is beyond a stop.
bool all_within_stops(const System& system, const Vecs& q) {
  const std::vector<JointKinematics> r = kinematics_at_rest(system, q);
  const double size = mechanism_size(system, q);
  for (std::size_t j = 0; j < r.size(); ++j)
    if (const auto breach = system.joints[j].law.breach(r[j].gap); breach && breach->depth > kAsStated * (breach->component == 2 ? 1 : size)) return false;
  return true;
}

// Whether everything else closes without these contacts, with no bodies inside each other; q is then the position where it does.
bool closes_without(const Model& model, const System& system, const std::vector<bool>& open, const std::vector<std::size_t>& contacts, Vecs& q) {
  const std::vector<bool> opened = with_opened(open, contacts);
  Vecs trial = q;
  PositionSearch(model, system, opened).run(trial);
  const double size = mechanism_size(system, trial);
  if (!all_closed(misfits(system, trial), opened, size)) return false;
  const std::vector<JointKinematics> r = kinematics_at_rest(system, trial);
  for (const std::size_t j : contacts)
    if (system.joints[j].law.penetration(r[j].gap) > kAsStated * size) return false;
  q = std::move(trial);
  return true;
}

// The contacts without which everything else closes, as an escape wheel touches one of its pallets at a time.
std::string contacts_that_may_stand_apart(const Model& model, const System& system, Vecs q, const std::vector<bool>& open) {
  const std::vector<std::size_t> contacts = contacts_of(system, open);
  return contacts.empty() || !closes_without(model, system, open, contacts, q) ? "" : names_of_joints(system, {contacts.begin(), contacts.end()});
}

// A contact that closes only with a joint beyond its stop, as that of a valve with lash, starts apart. Each contact is tried alone, then all together,
// each time from the stated positions.
void leave_contacts_apart(const Model& model, const System& system, const Vecs& stated, std::vector<bool>& open, Vecs& q, std::vector<std::string>& notes) {
  if (all_within_stops(system, q)) return;
  const std::vector<std::size_t> contacts = contacts_of(system, open);
  std::vector<std::vector<std::size_t>> choices;
  for (const std::size_t j : contacts) choices.push_back({j});
  if (contacts.size() > 1) choices.push_back(contacts);
  for (const std::vector<std::size_t>& choice : choices) {
    Vecs trial = stated;
    if (!closes_without(model, system, open, choice, trial) || !all_within_stops(system, trial)) continue;
    notes.push_back(fmt::format("bodies that touch in {} start apart: closing the contact would take a joint beyond its stop", names_of_joints(system, {choice.begin(), choice.end()})));
    open = with_opened(std::move(open), choice);
    q = std::move(trial);
    return;
  }
}

// What other than lengths keeps the search from closing the joints: held coordinates, motors that ask for another position, pins that the search puts
// in the middle of their play.
std::string what_to_try(Model model, const System& system, const Vecs& q, const std::vector<bool>& open, bool only_motors) {
  if (const std::string apart = contacts_that_may_stand_apart(model, system, q, open); !apart.empty())
    return fmt::format("Everything else closes if bodies may start apart ({}): if that is meant, try start = \"raw\", which closes no contact.", apart);
  if (const std::vector<std::string> held = let_go(model); !held.empty()) {
    Vecs trial = q;
    PositionSearch(model, system, open).run(trial);
    if (all_closed(misfits(system, trial), open, mechanism_size(system, q))) {
      return fmt::format("Without the held coordinates ({}) everything closes: try {}", fmt::join(held, ", "), only_motors ? "a motor that starts where its joint is held, or without hold." : "fewer of these in hold; or start = \"raw\", if a joint is meant to start deflected.");
    }
  }
  if (const std::string loose = names_of_joints_in_play(system); !loose.empty()) return "Assembly puts joints in the middle of their play (" + loose + "): if the stated positions are meant within it, try start = \"raw\", which takes them as they are.";
  return "Try lengths that close the loop, or angles nearer to the intended position.";
}

// Joints with play whose bodies do not touch in the assembled position, for example where a held angle tilts a sleeve on its pole.
std::vector<bool> within_play(const System& system, const Vecs& q) {
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  kinematics_at(system, 0, q, Vecs(q.size(), S::Vec::Zero()), m, r);
  std::vector<bool> out(r.size());
  for (std::size_t j = 0; j < r.size(); ++j) out[j] = has_play(system.joints[j]) && !(system.joints[j].law.penetration(r[j].gap) > 0);
  return out;
}

// Throws if the displacement of a joint is not a number: no misfit could be compared with anything.
void demand_defined(const System& system, const Vecs& q) {
  const std::vector<JointKinematics> r = kinematics_at_rest(system, q);
  for (std::size_t j = 0; j < r.size(); ++j) {
    if (r[j].gap.allFinite()) continue;
    throw AssemblyError(fmt::format("joint {} ({}) has no displacement at the positions as assembled: it is not a number{}", system.joints[j].name, system.joints[j].type,
                                    system.joints[j].edge ? ". The height of its edge is not finite near the contact: try if(..., ..., ...) to continue the height beyond its range" : ""));
  }
}

// Throws if joints stay open, and notes smaller misfits, unless a small change of the held coordinates removes these.
void demand_closed(const Model& model, const System& system, Vecs& q, const std::vector<bool>& open, std::vector<std::string>& notes) {
  demand_defined(system, q);
  const auto left = misfits(system, q);
  const double size = mechanism_size(system, q);
  constexpr int kMostListed = 20;         // number of joints that the message names
  constexpr std::size_t kMostTried = 40;  // upper limit on the number of joints that are opened in turn
  std::vector<std::size_t> broken, misfitting;
  const std::vector<bool> loose = within_play(system, q);
  for (std::size_t j = 0; j < left.size(); ++j) {
    if (open[j] || loose[j]) continue;
    if (is_broken(left[j], size)) broken.push_back(j);
    else if (!is_closed(left[j], size) && !has_play(system.joints[j])) misfitting.push_back(j);  // play takes up the rest
  }
  const bool of_joints = std::any_of(misfitting.begin(), misfitting.end(), [&](std::size_t j) { return system.joints[j].servo < 0; });
  if (broken.empty() && of_joints && close_beside_holds(model, system, open, q, notes)) return;
  for (const std::size_t j : misfitting)
    notes.push_back(fmt::format("{} {}: misfit of {:.3g} m, {:.3g} rad after assembly; {}", system.joints[j].servo < 0 ? "joint" : "motor", system.joints[j].name, left[j][0], left[j][1],
                                system.joints[j].servo < 0 ? has_constraints(model.simulate.equations) ? "constraints leave it open" : "it preloads the joint"
                                                           : "the motor's target at t = 0 differs by that much from where its joint is held, or from where its loop closes. The start lets bodies move until all forces balance, so a held angle starts near the motor's target"));
  if (broken.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < broken.size() && i < kMostListed; ++i) {
    const JointData& joint = system.joints[broken[i]];
    list += joint.servo >= 0 ? fmt::format("\n  motor {} has a target that is {} away from the position of its joint", joint.name, length_and_angle(left[broken[i]], size))
                             : fmt::format("\n  joint {} ({}) stays open by {}", joint.name, joint.type, length_and_angle(left[broken[i]], size));
  }
  if (broken.size() > kMostListed) list += fmt::format("\n  and {} more", broken.size() - kMostListed);
  const bool only_motors = std::all_of(broken.begin(), broken.end(), [&](std::size_t j) { return system.joints[j].servo >= 0; });
  std::string lacking;
  if (!only_motors) {
    lacking = left.size() <= kMostTried ? loop_that_lacks(model, system, q, open) : "";
    if (lacking.empty()) lacking = "\n  loop: " + loop_through(system, list);
  }
  throw AssemblyError("the mechanism cannot be assembled from the stated positions:" + list + lacking + "\n  " + what_to_try(model, system, q, open, only_motors));
}

// A coordinate far beyond a stop is not an intended start. Angles count turns.
void demand_within_stops(const JointData& joint, double at, const StopBreach& breach, double most) {
  if (!(breach.depth > most)) return;
  const bool turns = breach.component == 2;
  const char* coordinate = turns ? "angle" : std::holds_alternative<Selection>(joint.displacement) ? "slide" : "stroke";
  const double unit = turns ? std::numbers::pi / 180 : 1, turn = 2 * std::numbers::pi;
  std::string advice = turns && breach.depth > turn - std::numbers::pi ? "Angles count turns: try the angles of its bodies a whole turn apart." : "Try a start position between the stops, or move the stop.";
  throw AssemblyError(fmt::format("joint {}: it starts with its {} at {:.6g} {}, beyond its {}_stop of {:.6g} {}.\n  {}", joint.name, coordinate, at / unit, turns ? "deg" : "m",
                                  breach.upper ? "upper" : "lower", breach.stop / unit, turns ? "deg" : "m", advice));
}

// A belt run has no length if one disc contains the other, or if a crossed belt's discs overlap.
void demand_reach(const JointData& joint, const Belt& belt, const S::Vec& z) {
  const double apart = std::hypot(z[0], z[1]), least = std::abs(belt.w());
  if (apart > least) return;
  throw AssemblyError(fmt::format("joint {}: its discs are {:.4g} m apart, and the belt cannot run between them: that takes more than {:.4g} m.\n  Try smaller radii, other sides, or markers further apart.", joint.name, apart, least));
}

// Bodies deep inside each other at a contact are on its wrong side, and its forces would be meaningless.
void demand_apart(const Model& model, const System& system, const Vecs& q, const std::vector<std::string>& notes) {
  constexpr double kDeep = 1e-2;  // as a fraction of the mechanism's size: bodies deeper inside each other are on the wrong side of a contact
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  const Vecs still(q.size(), S::Vec::Zero());
  kinematics_at(system, 0, q, still, m, r);
  const double size = mechanism_size(system, q);
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& joint = system.joints[j];
    if (const auto breach = joint.law.breach(r[j].gap)) demand_within_stops(joint, r[j].gap[breach->component], *breach, kDeep * (breach->component == 2 ? 1 : size));
    if (const auto belt = belt_of(joint.displacement)) demand_reach(joint, *belt, system.pose(joint.at, m).z);
    const double depth = joint.law.penetration(r[j].gap);
    if (depth <= kDeep * size || model.simulate.start == Start::kSettled) continue;  // a settled start pushes them apart first
    const bool loose = std::holds_alternative<Selection>(joint.displacement) && (joint.free_mask.head<2>().isZero() || joint.free_mask[2] == 0);  // a pin or a slide with clearance, which has no other side
    if (loose)
      throw AssemblyError(fmt::format("joint {}: at the stated positions its parts are {:.4g} m farther apart than its clearance.\n  Try positions nearer to each other, or start = \"assembled\" or \"seated\", which put them there",
                                      joint.name, depth));
    throw AssemblyError(fmt::format("joint {}: its bodies start {:.4g} m inside each other.\n  Try the other side of the edge (the first marker's axis turned by 180 deg: it presses along +y), its two markers in the other order (the first one carries the edge), a start position apart from it, or start = \"settled\", which lets them push each other apart.{}",
                                    joint.name, depth, notes.empty() ? "" : fmt::format("\n  {}", fmt::join(notes, "\n  "))));
  }
}

// The model with all stated coordinates held.
Model held_as_stated(Model model) {
  for (Body& body : model.bodies) {
    if (body.position) body.hold[0] = body.hold[1] = true;
    if (body.angle) body.hold[2] = true;
  }
  return model;
}

// Completes `system` and closes the positions q, starting from a guess.
System assemble_positions(const Model& model, System system, Vecs& q, std::vector<std::string>& notes) {
  std::vector<bool> open(system.joints.size());
  for (int j = 0; j < system.n_joints(); ++j) open[j] = is_open(model, system, j);
  system = unwind(std::move(system), q);
  if (model.simulate.start == Start::kRaw) {
    if (!all_positions_stated(model)) PositionSearch(held_as_stated(model), system, with_opened(open, contacts_of(system, open))).run(q);
  } else {
    const Vecs stated = q;
    PositionSearch(model, system, open).run(q);
    leave_contacts_apart(model, system, stated, open, q, notes);
    demand_closed(model, system, q, open, notes);
  }
  return fix_assembled_values(model, std::move(system), q, notes);
}

Assembly put_bodies(const Model& model, System system) {
  Assembly out;
  State& state = out.state;
  state.q = guess_positions(model, system);
  const Vecs guess = state.q;
  out.system = assemble_positions(model, std::move(system), state.q, out.notes);
  note_moved_bodies(model, guess, state.q, out.notes);
  note_discs_apart(out.system, state.q, out.notes);
  note_missing_units(model, characteristic_length(out.system, state.q), out.notes);
  note_unconnected_bodies(out.system, out.notes);
  for (std::size_t i = 0; i < guess.size(); ++i)
    if (model.bodies[i].position) out.largest_move = std::max(out.largest_move, (state.q[i] - guess[i]).head<2>().norm());
  const bool raw = model.simulate.start == Start::kRaw;
  state.v = raw ? stated_velocities(model) : guess_velocities(model, out.system, state.q);
  if (!raw) assemble_velocities(model, out.system, state.q, state.v);
  note_changed_velocities(model, out.system, state.v, out.notes);
  return out;
}

}  // namespace

Assembly assemble_bodies(const Model& model, const System* like) { return put_bodies(model, build_system(model, like)); }

Assembly assemble_unloaded(const Model& model, System system) {
  Assembly out = put_bodies(model, std::move(system));
  demand_apart(model, out.system, out.state.q, out.notes);
  return out;
}

Assembly assemble_system(const Model& model, System system) {
  Assembly out = assemble_unloaded(model, std::move(system));
  start_forces(out.system, model.simulate.start == Start::kAssembled, out.state);
  return out;
}

Assembly assemble(const Model& model) { return assemble_system(model, build_system(model)); }

}  // namespace pintle

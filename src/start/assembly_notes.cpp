#include "start/assembly_notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/constants.h"
#include "joints/belt.h"
#include "kinematics/position_search.h"
#include "laws/catalog.h"
#include "start/seat.h"

namespace pintle {
namespace {

using S = Planar;

constexpr double kFarTurned = std::numbers::pi / 6;  // angles are read off a drawing more accurately than this [rad]
constexpr double kOtherVelocity = 0.02;              // as a fraction of the larger of stated and assembled velocity: a smaller change, as from rounded figures, is not noted. From 1e-4 to 0.04 the same ones of 150 models get the note
constexpr double kManyTurns = 4 * std::numbers::pi;  // starting angles above this are hardly intended: 15 degrees without their unit are more [rad]
constexpr double kMuchLarger = 3;                    // ratio of a law's length to the mechanism's size above which it is noted: a missing unit makes a thousand, and a mechanism of one body hardly has a size
constexpr double kTeethApart = 0.02;                 // as a fraction of the smaller pitch radius: profile-shifted teeth may be cut for as much

// The diagonal of the box around all stated centres [m].
double extent_of_centres(const Model& model, const Vecs& guess) {
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t i = 0; i < guess.size(); ++i) {
    if (!model.bodies[i].position) continue;
    low = low.min(guess[i].head<2>().array());
    high = high.max(guess[i].head<2>().array());
  }
  return low[0] <= high[0] ? (high - low).matrix().norm() : 0;
}

// From the body's centre to its furthest marker [m].
double furthest_marker(const Body& body) {
  double most = 0;
  for (const Marker& marker : body.markers) most = std::max(most, std::hypot(marker.position[0], marker.position[1]));
  return most;
}

void note_teeth_apart(const JointData& joint, const S::Vec& z, std::vector<std::string>& notes) {
  double opening = 0, radius = 0;
  if (const auto* mesh = std::get_if<Mesh>(&joint.displacement)) {
    opening = mesh->opening(z).gap;
    radius = std::min(std::abs(mesh->radius_first), std::abs(mesh->radius_second));
  } else if (const auto* rack = std::get_if<RackMesh>(&joint.displacement)) {
    opening = rack->opening(z).gap;
    radius = rack->radius;
  }
  if (std::abs(opening) > kTeethApart * radius)
    notes.push_back(fmt::format("joint {}: its pitch circles do not touch, they {} by {:.4g} m; the teeth carry their load all the same. If that was not meant, look at the radii and where the centres are", joint.name,
                                opening > 0 ? "are apart" : "overlap", std::abs(opening)));
}

// Lengths of a law that are larger than the mechanism, such as of a pin whose unit is missing. Unstated ones are defaults.
void note_large_lengths(const std::string& joint, const LawChoice& choice, double size, std::vector<std::string>& notes) {
  const LawInfo* law = find_law(choice.word);
  if (law == nullptr) return;
  for (const KeyInfo& key : law->keys) {
    const auto stated = choice.values.find(std::string(key.key));
    if (key.unit != "m" || !key.angular_unit.empty() || stated == choice.values.end()) continue;
    for (const double length : stated->second)
      if (std::abs(length) > kMuchLarger * size && length != key.fallback) notes.push_back(fmt::format("joint {}: its {} of {:.4g} m is larger than the whole mechanism ({:.4g} m): check its unit; a number alone is in metres", joint, key.key, length, size));
  }
}

void note_wide_clearance(const std::string& joint, const LawChoice& law, std::vector<std::string>& notes) {
  const auto clearance = law.values.find("clearance"), radius = law.values.find("pin_radius");
  if (clearance == law.values.end() || radius == law.values.end() || clearance->second.empty() || radius->second.empty() || !(clearance->second[0] > radius->second[0])) return;
  notes.push_back(fmt::format("joint {}: its clearance of {:.4g} m is larger than the radius of its pin ({:.4g} m): check its unit; a number alone is in metres", joint, clearance->second[0], radius->second[0]));
}

void note_many_turns(const std::string& what, double angle, std::vector<std::string>& notes, double many = kManyTurns) {
  if (std::abs(angle) > many) notes.push_back(fmt::format("{} of {:.4g} rad is {:.3g} turns: without a unit angles are radians", what, angle, angle / (2 * std::numbers::pi)));
}

// Turns of a marker's axis have no meaning.
void note_turned_axes(const std::string& of, const std::vector<Marker>& markers, std::vector<std::string>& notes) {
  for (const Marker& marker : markers) note_many_turns(of + ": the axis angle of its marker " + marker.name, marker.axis, notes, kTurn);
}

void note_overlap(const JointData& joint, const S::Vec& z, std::vector<std::string>& notes) {
  const auto belt = belt_of(joint.displacement);
  if (!belt) return;
  const double overlap = std::abs(belt->radius_first) + std::abs(belt->radius_second) - std::hypot(z[0], z[1]);
  if (overlap > 0)
    notes.push_back(fmt::format("joint {}: its discs overlap by {:.4g} m; the belt pulls all the same. If that was not meant, look at the radii and where the centres are", joint.name, overlap));
}

}  // namespace

void note_moved_bodies(const Model& model, const Vecs& guess, const Vecs& q, std::vector<std::string>& notes) {
  const double extent = extent_of_centres(model, guess);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Body& body = model.bodies[i];
    const double turned = std::remainder(q[i][2] - guess[i][2], 2 * std::numbers::pi);
    if (body.angle && std::abs(turned) > kFarTurned)
      notes.push_back(fmt::format("body {}: assembly turned it by {:.3g} deg from its stated angle; if that was not meant, look at the angles of its markers", body.name, turned * 180 / std::numbers::pi));
    const double moved = (q[i] - guess[i]).head<2>().norm();
    const double size = std::max(extent, furthest_marker(body));
    if (body.position && size > 0 && moved > size)
      notes.push_back(fmt::format("body {}: assembly moved it by {:.3g} m from its stated position, more than the extent of the stated positions; if that was not meant, look at its markers and those that it is joined to: is a unit missing?", body.name, moved));
  }
}

void note_changed_velocities(const Model& model, const System& system, const Vecs& v, std::vector<std::string>& notes) {
  const std::string loose = names_of_joints_in_play(system);
  const std::string why = loose.empty() ? "joints or motors require it" : fmt::format("joints or motors require it, and the parts of joints with play ({}) start at rest relative to each other; start = \"raw\" keeps the stated velocities", loose);
  const auto differ = [](double change, double before, double after) { return change > kOtherVelocity * std::max(before, after); };
  constexpr double kNothing = 1e-9;  // as a fraction of the stated value: smaller values are roundoff and written as 0
  const auto plain = [](double x, double stated) { return std::abs(x) < kNothing * std::abs(stated) ? 0 : x; };
  double fastest = 0, most_turned = 0;
  for (const S::Vec& velocity : v) {
    fastest = std::max(fastest, velocity.head<2>().norm());
    most_turned = std::max(most_turned, std::abs(velocity[2]));
  }
  std::vector<std::string> not_at_rest;  // though stated to be
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Body& body = model.bodies[i];
    if ((body.spin == 0.0 && std::abs(v[i][2]) > kOtherVelocity * most_turned) || (body.velocity == Vec2{} && v[i].head<2>().norm() > kOtherVelocity * fastest)) not_at_rest.push_back(body.name);
    if (body.spin && *body.spin != 0 && differ(std::abs(v[i][2] - *body.spin), std::abs(*body.spin), std::abs(v[i][2])))
      notes.push_back(fmt::format("body {}: it starts with a spin of {:.4g} rad/s, not with the stated {:.4g} rad/s: {}", body.name, plain(v[i][2], *body.spin), *body.spin, why));
    if (!body.velocity) continue;
    const auto [x, y] = *body.velocity;
    const double stated = std::hypot(x, y);
    if (stated > 0 && differ(std::hypot(v[i][0] - x, v[i][1] - y), stated, std::hypot(v[i][0], v[i][1])))
      notes.push_back(fmt::format("body {}: it starts with a velocity of ({:.4g}, {:.4g}) m/s, not with the stated ({:.4g}, {:.4g}) m/s: {}", body.name, plain(v[i][0], stated), plain(v[i][1], stated), x, y, why));
  }
  if (!not_at_rest.empty())
    notes.push_back(fmt::format("{} {}: stated at rest, but moving at the start: {}", not_at_rest.size() == 1 ? "body" : "bodies", fmt::join(not_at_rest, ", "), why));
}

void note_discs_apart(const System& system, const Vecs& q, std::vector<std::string>& notes) {
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  kinematics_at(system, 0, q, Vecs(q.size(), S::Vec::Zero()), m, r);
  for (const JointData& joint : system.joints) {
    const S::Vec z = system.pose(joint.at, m).z;
    note_teeth_apart(joint, z, notes);
    note_overlap(joint, z, notes);
  }
}

void note_unconnected_bodies(const System& system, std::vector<std::string>& notes) {
  std::vector<bool> connected(system.bodies.size());
  const auto see = [&](int body) {
    if (body != kGround) connected[static_cast<std::size_t>(body)] = true;
  };
  const auto see_both = [&](const Placement& at) { see(at.a), see(at.b); };
  for (const JointData& joint : system.joints) see_both(joint.at);
  for (const LoadData& load : system.loads) see_both(load.at);
  for (const auto& force : system.applied) see(force.body);
  for (std::size_t b = 0; b < connected.size() && connected.size() > 1; ++b)
    if (!connected[b]) notes.push_back(fmt::format("body {} has no joint, spring or force: it moves independently of the others", system.bodies[b].name));
}

void note_missing_units(const Model& model, double size, std::vector<std::string>& notes) {
  for (const Body& body : model.bodies) {
    if (body.angle) note_many_turns("body " + body.name + ": its angle", *body.angle, notes);
    note_turned_axes("body " + body.name, body.markers, notes);
  }
  note_turned_axes("ground", model.ground, notes);
  for (const Joint& joint : model.joints)
    for (const char* key : {"lower_stop", "upper_stop"})
      if (const auto stop = joint.stops.values.find(key); joint.type == "revolute" && stop != joint.stops.values.end())
        for (const double angle : stop->second) note_many_turns("joint " + joint.name + ": its " + key, angle, notes);
  for (const Joint& joint : model.joints) note_wide_clearance(joint.name, joint.law, notes);
  for (const Joint& joint : model.joints)
    for (const LawChoice* law : {&joint.law, &joint.friction, &joint.stops, &joint.detent}) note_large_lengths(joint.name, *law, size, notes);
}

std::string held_that_moved(const Model& model, const Vecs& from, const Vecs& to, double turn, double way) {
  std::string moved;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    for (int k = 0; k < S::kDof; ++k) {
      const bool turns = k == S::kTurn;
      if (!model.bodies[i].hold[k] || !(std::abs(to[i][k] - from[i][k]) > (turns ? turn : way))) continue;
      const double unit = turns ? kTurn / 360 : 1;
      moved += fmt::format("{}{}.{} starts at {:.6g} {}, not at {:.6g}", moved.empty() ? "" : ", ", model.bodies[i].name, kCoordinates[k], to[i][k] / unit, turns ? "deg" : "m", from[i][k] / unit);
    }
  return moved;
}

}  // namespace pintle

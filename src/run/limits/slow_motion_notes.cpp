#include "run/limits/slow_motion_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "laws/catalog.h"

namespace pintle {
namespace {

// How a joint's free coordinate has moved, at the rows.
struct Travel {
  double path = 0, fastest = 0;  // [rad], [rad/s] or [m], [m/s]
};

Travel travel_of(const Trajectory& run, std::size_t rate) {
  Travel out;
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    const double speed = std::abs(run.at(row, rate));
    out.fastest = std::max(out.fastest, speed);
    if (row > 0) out.path += 0.5 * (speed + std::abs(run.at(row - 1, rate))) * (run.at(row, 0) - run.at(row - 1, 0));
  }
  return out;
}

// The touches of a joint's stops, or of its other surfaces.
struct Touches {
  int count = 0;
  double fastest = 0;  // speed of approach
  std::string unit;
};

Touches touches_of(const Trajectory& run, const std::string& joint, bool stops) {
  Touches out;
  for (const JointEvents& events : run.events) {
    if (events.joint != joint) continue;
    for (std::size_t c = 0; c < events.columns.size(); ++c) {
      if (!events.columns[c].name.starts_with(stops ? "stop_approach_speed" : "approach_speed")) continue;
      out.unit = events.columns[c].unit;
      for (const JointEvent& event : events.events) {
        if (!event.what.starts_with("touch") || event.what.ends_with(" stop") != stops) continue;
        ++out.count;
        out.fastest = std::max(out.fastest, event.values[c]);
      }
    }
  }
  return out;
}

// The values of this choice's keys, if it is a law with the key `key`.
std::optional<LawSetting> setting_with(const LawChoice& choice, std::string_view key) {
  const LawInfo* info = choice.word.empty() ? nullptr : find_law(choice.word);
  if (info == nullptr || std::none_of(info->keys.begin(), info->keys.end(), [key](const KeyInfo& one) { return one.key == key; })) return std::nullopt;
  LawSetting out;
  out.values = &choice.values;
  out.keys = info->keys;
  return out;
}

// Friction that rises from zero with the slip never reaches its full size.
std::string note_on_friction(const Joint& joint, const Trajectory& run) {
  constexpr double kOnTheRamp = 0.25;              // fraction of transition_speed: above it, the laws give three quarters of their kinetic friction, or a quarter of the static one
  constexpr double kTurns = 0.01, kSlides = 1e-3;  // [rad], [m]: a joint that moves less is held by its friction
  const std::optional<LawSetting> friction = setting_with(joint.friction, "transition_speed");
  const bool pin = joint.type == "revolute";
  const int column = friction ? run.column(fmt::format("joint.{}.{}", joint.name, pin ? "angle_rate" : "slide_rate")) : -1;
  if (column < 0) return "";
  const Travel travel = travel_of(run, static_cast<std::size_t>(column));
  const double transition = friction->number("transition_speed"), slip = travel.fastest * (pin ? friction->number("pin_radius") : 1);
  if (!(travel.path > (pin ? kTurns : kSlides) && slip < kOnTheRamp * transition)) return "";
  return fmt::format("joint {} slips at {:.3g} m/s at most, far below the transition_speed of its friction ({:.3g} m/s), up to which friction rises from zero: it stays far below "
                     "friction_coefficient times the load. Lower transition_speed below the joint's slip, or try friction = \"coulomb\"",
                     joint.name, slip, transition);
}

// The damping of slow impacts is that of impacts at the floor of the approach speed.
std::string note_on_touches(const Joint& joint, bool stops, const Trajectory& run) {
  constexpr double kCreeps = 1e-3;  // fraction of the floor: a slower touch hardly rebounds, whatever its restitution
  const std::string_view key = stops ? "stop_least_speed" : "least_approach_speed";
  const std::optional<LawSetting> law = setting_with(stops ? joint.stops : joint.law, key);
  if (!law) return "";
  const double floor = law->number(key);
  const Touches touches = touches_of(run, joint.name, stops);
  if (!(touches.count > 0 && touches.fastest > kCreeps * floor && touches.fastest < floor)) return "";
  return fmt::format("joint {0} touches at {1:.3g} {2} at most, below its {3} ({4:.3g} {2}): its damping is that of impacts at that speed, so that it rebounds faster than its "
                     "restitution says. Lower {3} if the rebound matters",
                     joint.name, touches.fastest, touches.unit, key, floor);
}

}  // namespace

std::vector<std::string> slow_motion_notes(const Model& model, const Trajectory& run) {
  std::vector<std::string> notes;
  for (const Joint& joint : model.joints)
    for (std::string& note : std::array{note_on_friction(joint, run), note_on_touches(joint, false, run), note_on_touches(joint, true, run)})
      if (!note.empty()) notes.push_back(std::move(note));
  return notes;
}

}  // namespace pintle

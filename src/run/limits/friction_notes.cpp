#include "run/limits/friction_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

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

}  // namespace

std::vector<std::string> friction_notes(const Model& model, const Trajectory& run) {
  constexpr double kOnTheRamp = 0.25;              // fraction of transition_speed: above it, the laws give three quarters of their kinetic friction, or a quarter of the static one
  constexpr double kTurns = 0.01, kSlides = 1e-3;  // [rad], [m]: a joint that moves less is held by its friction
  std::vector<std::string> notes;
  for (const Joint& joint : model.joints) {
    const LawInfo* info = joint.friction.word.empty() ? nullptr : find_law(joint.friction.word);
    if (info == nullptr || std::none_of(info->keys.begin(), info->keys.end(), [](const KeyInfo& key) { return key.key == "transition_speed"; })) continue;
    const bool pin = joint.type == "revolute";
    const int column = run.column(fmt::format("joint.{}.{}", joint.name, pin ? "angle_rate" : "slide_rate"));
    if (column < 0) continue;
    LawSetting friction;
    friction.values = &joint.friction.values;
    friction.keys = info->keys;
    const Travel travel = travel_of(run, static_cast<std::size_t>(column));
    const double transition = friction.number("transition_speed"), slip = travel.fastest * (pin ? friction.number("pin_radius") : 1);
    if (!(travel.path > (pin ? kTurns : kSlides) && slip < kOnTheRamp * transition)) continue;
    notes.push_back(fmt::format("joint {} slips at {:.3g} m/s at most, far below the transition_speed of its friction ({:.3g} m/s), up to which friction rises from zero: it stays far below "
                                "friction_coefficient times the load. Lower transition_speed below the joint's slip, or try friction = \"coulomb\"",
                                joint.name, slip, transition));
  }
  return notes;
}

}  // namespace pintle

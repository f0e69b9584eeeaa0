// The catalog's entries for dry friction.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "laws/friction/brown_mcphee.h"
#include "laws/catalog_parts.h"
#include "laws/friction/coulomb.h"
#include "laws/friction/lugre.h"
#include "laws/friction/stribeck.h"

namespace pintle {
namespace {

// Keys of friction by any law.
constexpr KeyInfo kKinetic{.key = "friction_coefficient", .unit = "", .fallback = 0.1, .minimum_exclusive = true, .meaning = "kinetic friction: of steady fast slip"};
constexpr KeyInfo kStatic{.key = "static_friction", .unit = "", .minimum_exclusive = true, .otherwise = "0.15, or friction_coefficient where that is more", .meaning = "coefficient at which slip begins; not below the kinetic one"};
constexpr KeyInfo kPinRadius{.key = "pin_radius", .unit = "m", .minimum_exclusive = true, .otherwise = "required of a pin", .meaning = "where a pin rubs; of no other joint"};
constexpr KeyInfo kTeeth{.key = "sliding_distance", .unit = "m", .minimum_exclusive = true, .otherwise = "required of gears and racks", .meaning = "where teeth rub: how far from the pitch point they touch on average, about 1.2 modules; of no other joint"};
constexpr KeyInfo kGuide{.key = "guide_length", .unit = "m", .meaning = "of a slider, centred on the second marker: its moment presses the edges; 0: only the force across does"};
constexpr KeyInfo kStribeck{.key = "stribeck_speed", .unit = "m/s", .fallback = 1e-3, .minimum_exclusive = true, .meaning = "slip at which friction has fallen most of the way to kinetic"};
constexpr KeyInfo kViscous{.key = "viscous_friction", .unit = "s/m", .meaning = "friction per slip speed and load"};
constexpr KeyInfo kPreload{.key = "friction_preload", .unit = "N", .meaning = "presses the surfaces together besides the joint's own force"};

constexpr KeyInfo kSealArea{.key = "seal_area", .unit = "m^2", .meaning = "of a cylinder: where the pressure in its chambers, over that of the surroundings, presses seals against bore and rod"};

constexpr std::array<KeyInfo, 11> kLuGreKeys{{
    kKinetic, kStatic, kPinRadius, kTeeth, kGuide, kStribeck,
    {.key = "bristle_stiffness", .unit = "m^-1", .fallback = 1e5, .minimum_exclusive = true, .meaning = "friction before slip, per displacement and load; slip begins at static_friction over this"},
    {.key = "bristle_damping", .unit = "s/m", .fallback = 10, .meaning = "the same per rate of the bristles"},
    kViscous, kPreload, kSealArea,
}};

constexpr std::array<KeyInfo, 10> kCoulombKeys{{
    kKinetic, kStatic, kPinRadius, kTeeth, kGuide,
    {.key = "stick_stiffness", .unit = "N/m", .fallback = 1e8, .minimum_exclusive = true, .meaning = "friction before slip, per displacement where it rubs"},
    {.key = "stick_damping", .unit = "N*s/m", .fallback = 1e5, .meaning = "the same per speed"},
    kViscous, kPreload, kSealArea,
}};

constexpr std::array<KeyInfo, 9> kBrownMcPheeKeys{{
    kKinetic, kStatic, kPinRadius, kTeeth, kGuide,
    {.key = "transition_speed", .unit = "m/s", .fallback = 1e-3, .minimum_exclusive = true, .meaning = "slip at which friction is largest; below it a joint creeps that should stick"},
    kViscous, kPreload, kSealArea,
}};

constexpr std::array<KeyInfo, 10> kStribeckKeys{{
    kKinetic, kStatic, kPinRadius, kTeeth, kGuide, kStribeck,
    {.key = "transition_speed", .unit = "m/s", .fallback = 1e-4, .minimum_exclusive = true, .meaning = "friction rises with tanh(slip / transition_speed); about this fast a joint creeps that should stick"},
    kViscous, kPreload, kSealArea,
}};

constexpr std::string_view kCylinder = "cylinder";
constexpr std::array<std::string_view, 8> kRubbing{"revolute", "prismatic", "slot", kCylinder, "gear", "rack", "cam", "edge"};

bool has_surfaces(const LawSetting& at) { return at.joint_type == "cam" || at.joint_type == "edge"; }
bool has_teeth(const LawSetting& at) { return at.joint_type == "gear" || at.joint_type == "rack"; }
// Turns but does not slide.
bool is_pin(const LawSetting& at) { return at.free[2] && !at.free[0]; }

// The coefficient at which slip begins.
double static_friction(const LawSetting& at) {
  constexpr double kUsual = 0.15;  // if neither coefficient is stated, or the kinetic one is smaller
  const double stated = at.number("static_friction");
  return stated > 0 ? stated : std::max(kUsual, at.number("friction_coefficient"));
}

LawFault friction_fault(const LawSetting& at) {
  if (const double stuck = static_friction(at); stuck < at.number("friction_coefficient"))
    return {"static_friction", fmt::format("{:g} is below the kinetic coefficient of {:g}: surfaces would hold more firmly when slipping than at rest", stuck, at.number("friction_coefficient")),
            "static_friction not below friction_coefficient"};
  if (at.joint_type != kCylinder && at.number("seal_area") > 0) return {"seal_area", "only cylinders have seals", "delete it; friction_preload is a constant load"};
  if (at.joint_type == kCylinder && at.number("guide_length") > 0) return {"guide_length", "the guide of a cylinder's rod carries no load: the force acts along it", "delete it"};
  if ((has_surfaces(at) || has_teeth(at)) && at.number("guide_length") > 0) return {"guide_length", "surfaces that touch in a point have no guide", "delete it"};
  if (has_teeth(at) && !(at.number("sliding_distance") > 0)) return {"sliding_distance", "teeth slide on each other at some distance from the pitch point, which is not stated", "about 1.2 modules: sliding_distance = \"2.4 mm\" of a module of 2 mm"};
  if (!has_teeth(at) && at.states("sliding_distance")) return {"sliding_distance", "only gears and racks have teeth", "delete it"};
  if (is_pin(at) && !(at.number("pin_radius") > 0)) return {"pin_radius", "a pin rubs at its radius, which is not stated", "pin_radius = \"10 mm\", or what it is"};
  if (at.free[2] && at.number("guide_length") > 0) return {"guide_length", "a joint that turns transmits no moment that could press the edges of a guide", "delete it"};
  return {};
}

// The settings that all friction laws have in common.
void set_friction(const LawSetting& at, Friction& friction) {
  const bool pin = is_pin(at), teeth = has_teeth(at);
  friction.free = pin || teeth ? 2 : has_surfaces(at) ? 1 : 0;
  friction.radius = pin ? at.number("pin_radius") : teeth ? at.number("sliding_distance") : 1;
  friction.normal = teeth ? 1 / std::cos(at.pressure_angle) : has_surfaces(at) ? 1 : 0;
  friction.guide = pin ? 0 : at.number("guide_length");
  friction.preload = at.number("friction_preload");
  friction.kinetic = at.number("friction_coefficient");
  friction.static_coefficient = static_friction(at);
  friction.viscous = at.number("viscous_friction");
  friction.seal_area = at.number("seal_area");
  friction.chambers = at.chambers;
}

void make_lugre(const LawSetting& at, Law& law) {
  LuGreLaw friction;
  set_friction(at, friction);
  friction.stribeck = at.number("stribeck_speed");
  friction.bristle_stiffness = at.number("bristle_stiffness");
  friction.bristle_damping = at.number("bristle_damping");
  law.add(std::make_unique<LawPartOf<LuGreLaw>>(friction));
}

void make_coulomb(const LawSetting& at, Law& law) {
  CoulombLaw friction;
  set_friction(at, friction);
  friction.stiffness = at.number("stick_stiffness");
  friction.damping = at.number("stick_damping");
  law.add(std::make_unique<LawPartOf<CoulombLaw>>(friction));
}

void make_brown_mcphee(const LawSetting& at, Law& law) {
  BrownMcPheeLaw friction;
  set_friction(at, friction);
  friction.transition = at.number("transition_speed");
  law.add(std::make_unique<LawPartOf<BrownMcPheeLaw>>(friction));
}

void make_stribeck(const LawSetting& at, Law& law) {
  StribeckLaw friction;
  set_friction(at, friction);
  friction.stribeck = at.number("stribeck_speed");
  friction.transition = at.number("transition_speed");
  law.add(std::make_unique<LawPartOf<StribeckLaw>>(friction));
}

LawInfo entry(std::string_view word, std::string_view meaning, std::span<const KeyInfo> keys, void (*make)(const LawSetting&, Law&)) {
  return {.word = word, .meaning = meaning, .keys = keys, .role = LawRole::kFriction, .joints = kRubbing, .make = make, .fault = friction_fault};
}

}  // namespace

void add_friction_laws(std::vector<LawInfo>& all) {
  all.push_back(entry("lugre", "dry friction of what the joint leaves free, pressed by the joint's own force (LuGre: bristles, stiction, Stribeck)", kLuGreKeys, make_lugre));
  all.push_back(entry("coulomb", "dry friction with stiction: the joint sticks on a spring and a damper until friction cannot carry its load, then slips", kCoulombKeys, make_coulomb));
  all.push_back(entry("brown-mcphee", "dry friction as a smooth function of the slip speed (Brown and McPhee); a joint that should stick creeps", kBrownMcPheeKeys, make_brown_mcphee));
  all.push_back(entry("stribeck", "Coulomb friction made smooth at rest, with the Stribeck drop and a viscous part; a joint that should stick creeps", kStribeckKeys, make_stribeck));
}

}  // namespace pintle

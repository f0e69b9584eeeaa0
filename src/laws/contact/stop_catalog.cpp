// The catalog's entries for stops.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "laws/catalog.h"
#include "laws/catalog_parts.h"
#include "laws/contact/damping_keys.h"
#include "laws/contact/stops.h"

namespace pintle {
namespace {

constexpr KeyInfo kLower{.key = "lower_stop", .unit = "m", .angular_unit = "rad", .fallback = -StopContact::kNowhere, .minimum = kAny, .otherwise = "no lower stop; of a cylinder 0",
                         .meaning = "smallest angle, slide or stroke of the joint: where the stop is touched"};
constexpr KeyInfo kUpper{.key = "upper_stop", .unit = "m", .angular_unit = "rad", .fallback = StopContact::kNowhere, .minimum = kAny, .otherwise = "no upper stop; of a cylinder its stroke",
                         .meaning = "largest angle, slide or stroke of the joint: where the stop is touched"};
constexpr KeyInfo kStiffness{.key = "stop_stiffness", .unit = "N/m", .angular_unit = "N*m/rad", .minimum_exclusive = true, .required = true,
                             .meaning = "force or moment at a depth of 1 m or 1 rad behind a stop; it goes as the depth to the power of stop_exponent"};
constexpr KeyInfo kExponent{.key = "stop_exponent", .unit = "", .fallback = 1, .minimum = 1, .meaning = "1: a spring; 1.5: Hertz' contact of a ball; 1 in the linear model"};
constexpr KeyInfo kModel{.key = "stop_model", .unit = "", .words = kContactModels,
                         .meaning = "damping of the stops; only exact returns the restitution that is asked for, linear is a spring and a damper"};
constexpr KeyInfo kRestitution{.key = "stop_restitution", .unit = "", .fallback = 0.8, .minimum_exclusive = true, .meaning = "speed after a free impact over the speed before, at most 1"};
constexpr KeyInfo kFixedDamping{.key = "stop_damping_factor", .unit = "s/m", .angular_unit = "s/rad", .meaning = "damping over elastic force and speed, instead of restitution and approach speed"};
constexpr KeyInfo kViscous{.key = "stop_damping", .unit = "N*s/m", .angular_unit = "N*m*s/rad", .meaning = "of the linear model"};
constexpr KeyInfo kLeastApproach{.key = "stop_least_speed", .unit = "m/s", .angular_unit = "rad/s", .fallback = 1e-3, .minimum_exclusive = true, .meaning = "floor of the approach speed that the restitution refers to"};
constexpr KeyInfo kCushion{.key = "stop_cushion", .unit = "m", .angular_unit = "rad", .minimum_exclusive = true, .required = true, .meaning = "depth behind a stop over which the damping grows from 0 to stop_damping"};
constexpr KeyInfo kGrownDamping{.key = "stop_damping", .unit = "N*s/m", .angular_unit = "N*m*s/rad", .required = true, .meaning = "force or moment per speed, at the depth of stop_cushion and beyond"};

constexpr std::array<KeyInfo, 9> kHardKeys{{kLower, kUpper, kStiffness, kExponent, kModel, kRestitution, kFixedDamping, kViscous, kLeastApproach}};
constexpr std::array<KeyInfo, 6> kCushionedKeys{{kLower, kUpper, kStiffness, kExponent, kCushion, kGrownDamping}};

constexpr DampingKeys kDamping{"stop_model", "stop_restitution", "stop_damping_factor", "stop_damping", "stop_exponent", "stop_least_speed"};
constexpr std::array<std::string_view, 4> kWithStops{"revolute", "prismatic", "slot", "cylinder"};

// If no stop is stated, the end of the stroke is used.
double lower_of(const LawSetting& at) { return std::max(at.number("lower_stop"), at.lower_end); }
double upper_of(const LawSetting& at) { return std::min(at.number("upper_stop"), at.upper_end); }

LawFault stop_fault(const LawSetting& at) {
  const double lower = lower_of(at), upper = upper_of(at);
  if (std::isfinite(at.number("lower_stop")) && at.number("lower_stop") < lower) return {"lower_stop", fmt::format("the stroke ends before, at {:g} m", lower), "a stop inside the stroke, or none: it is at the end then"};
  if (std::isfinite(at.number("upper_stop")) && at.number("upper_stop") > upper) return {"upper_stop", fmt::format("the stroke ends before, at {:g} m", upper), "a stop inside the stroke, or none: it is at the end then"};
  if (!std::isfinite(lower) && !std::isfinite(upper)) return {"stops", "neither lower_stop nor upper_stop says where they are", "lower_stop, upper_stop or both"};
  if (!(lower < upper)) return {"lower_stop", fmt::format("{:g} is not below upper_stop, {:g}: nothing is left between them", lower, upper), "the smaller of the two as lower_stop"};
  return {};
}

LawFault hard_fault(const LawSetting& at) {
  if (LawFault fault = stop_fault(at); !fault.key.empty()) return fault;
  return kDamping.fault(at);
}

template <class Stops>
Stops stops_of(const LawSetting& at) {
  Stops law;
  law.free = at.free[0] ? 0 : 2;
  law.lower = lower_of(at);
  law.upper = upper_of(at);
  law.contact.stiffness = at.number("stop_stiffness");
  return law;
}

void make_hard(const LawSetting& at, Law& law) {
  auto stops = stops_of<HardStops>(at);
  kDamping.set(at, stops.contact);
  law.add(std::make_unique<LawPartOf<HardStops>>(stops));
}

void make_cushioned(const LawSetting& at, Law& law) {
  auto stops = stops_of<CushionedStops>(at);
  stops.contact.exponent = at.number("stop_exponent");
  stops.contact.viscous = at.number("stop_damping");
  stops.contact.cushion = at.number("stop_cushion");
  law.add(std::make_unique<LawPartOf<CushionedStops>>(stops));
}

}  // namespace

void add_stop_laws(std::vector<LawInfo>& all) {
  all.push_back({.word = "hard", .meaning = "stops of the joint's angle, slide or stroke, by the contact models of law \"contact\": impact with a restitution, rest on the stop", .keys = kHardKeys,
                 .role = LawRole::kStops, .joints = kWithStops, .make = make_hard, .fault = hard_fault});
  all.push_back({.word = "cushioned", .meaning = "stops of the joint's angle, slide or stroke with an end cushion: a spring, and a damper that grows with the depth (the IMPACT function of Adams)", .keys = kCushionedKeys,
                 .role = LawRole::kStops, .joints = kWithStops, .make = make_cushioned, .fault = stop_fault});
}

}  // namespace pintle

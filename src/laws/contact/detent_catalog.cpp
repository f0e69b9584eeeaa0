// The catalog's entry for detents.
#include <array>
#include <fmt/format.h>
#include <memory>
#include <numbers>

#include "laws/catalog.h"
#include "laws/catalog_parts.h"
#include "laws/contact/detent.h"

namespace pintle {
namespace {

constexpr std::array<KeyInfo, 8> kKeys{{
    {.key = "ball_radius", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "of the ball"},
    {.key = "notch_radius", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "of the notch's round bottom, above the ball's"},
    {.key = "notch_width", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "of the notch at the surface, edge to edge; below twice its radius"},
    {.key = "detent_preload", .unit = "N", .required = true, .meaning = "force of the spring on the ball at the bottom of a notch"},
    {.key = "detent_rate", .unit = "N/m", .meaning = "of that spring: force per lift of the ball"},
    {.key = "detent_radius", .unit = "m", .minimum_exclusive = false, .meaning = "of a pin: where the ball runs, from the axis"},
    {.key = "detent_at", .unit = "m", .angular_unit = "rad", .minimum = kAny, .meaning = "angle or slide at which the ball is in the bottom of a notch"},
    {.key = "detent_pitch", .unit = "m", .angular_unit = "rad", .otherwise = "one notch", .meaning = "from notch to notch"},
}};
constexpr std::array<std::string_view, 2> kWithDetent{"revolute", "prismatic"};

double radius_of(const LawSetting& at) { return at.free[2] ? at.number("detent_radius") : 1; }

LawFault detent_fault(const LawSetting& at) {
  const double ball = at.number("ball_radius"), notch = at.number("notch_radius"), width = at.number("notch_width"), radius = radius_of(at), pitch = at.number("detent_pitch");
  if (!(notch > ball)) return {"notch_radius", fmt::format("a ball of {:g} m does not reach the bottom of a notch of {:g} m", ball, notch), "a notch_radius above ball_radius"};
  if (!(width < 2 * notch)) return {"notch_width", fmt::format("a notch of the radius {:g} m is at most {:g} m wide", notch, 2 * notch), "a notch_width below twice the notch_radius"};
  if (at.free[2] && !(radius > 0)) return {"detent_radius", "a pin's notches are on a circle", "detent_radius, the distance from the axis to where the ball runs"};
  if (!at.free[2] && at.number("detent_radius") > 0) return {"detent_radius", "the notches of a slide are on a line", "delete it"};
  if (pitch != 0 && pitch * radius < width) return {"detent_pitch", fmt::format("notches {:g} m apart overlap: each is {:g} m wide", pitch * radius, width), "a larger pitch, or narrower notches"};
  const double turns = 2 * std::numbers::pi / pitch;
  if (at.free[2] && pitch != 0 && std::abs(turns - std::round(turns)) > 1e-6 * turns)
    return {"detent_pitch", fmt::format("{:g} notches do not fill a turn", turns), "a turn over a whole number, \"360 deg/12\""};
  return {};
}

void make_detent(const LawSetting& at, Law& law) {
  DetentLaw detent;
  detent.free = at.free[2] ? 2 : 0;
  detent.radius = radius_of(at);
  detent.place = at.number("detent_at");
  detent.profile = {at.number("ball_radius"), at.number("notch_radius"), at.number("notch_width"), at.number("detent_pitch") * detent.radius};
  detent.preload = at.number("detent_preload");
  detent.rate = at.number("detent_rate");
  law.add(std::make_unique<LawPartOf<DetentLaw>>(detent));
}

}  // namespace

void add_detent_laws(std::vector<LawInfo>& all) {
  all.push_back({.word = DetentLaw::kWord, .meaning = "a ball that a spring presses into round notches, as the joint's angle or slide passes them", .keys = kKeys, .role = LawRole::kDetent, .joints = kWithDetent,
                 .make = make_detent, .fault = detent_fault});
}

}  // namespace pintle

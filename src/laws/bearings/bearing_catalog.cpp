// The catalog's entries for bearings and measured force tables; the head comments of their structs state the equations.
#include "laws/catalog_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/text/article.h"
#include "laws/bearings/journal_film.h"
#include "laws/bearings/rolling_bearing.h"
#include "laws/bearings/table.h"

namespace pintle {
namespace {

constexpr std::array<std::string_view, 1> kSlides{"prismatic"};
constexpr std::array<std::string_view, 1> kPins{"revolute"};
constexpr std::array<std::string_view, 2> kBushed{"revolute", "fixed"};

// Default stiffness and damping and their ranges: theory/bearings, section 1, from the paper's sections 4, 5, 7 and 8.
constexpr std::array<KeyInfo, 5> kGuideKeys{{
    {.key = "stiffness", .unit = "N/m", .fallback = 2e8, .minimum_exclusive = true, .meaning = "force per displacement across the guide; 1e8 to 30e8 N/m of rolling elements"},
    {.key = "damping", .unit = "N*s/m", .fallback = 3500, .meaning = "force per rate of it; 2e3 to 10e3 N*s/m of rolling elements"},
    {.key = "carriage_length", .unit = "m", .fallback = 0.1, .minimum_exclusive = true, .meaning = "over which the guide carries evenly: stiffness against turning is stiffness times its square over 12, and damping likewise"},
    {.key = "angular_stiffness", .unit = "N*m/rad", .meaning = "moment per angle; 0: from the carriage's length"},
    {.key = "angular_damping", .unit = "N*m*s/rad", .meaning = "moment per rate of the angle; 0: from the carriage's length"},
}};

void make_guide(const LawSetting& at, Law& law) {
  const double length = at.number("carriage_length"), even = length * length / 12;  // (1.1)
  const double k = at.number("stiffness"), c = at.number("damping"), turning = at.number("angular_stiffness"), lost = at.number("angular_damping");
  law.set_linear({{0, k, turning > 0 ? turning : k * even}, {0, c, lost > 0 ? lost : c * even}});
}

constexpr std::array<KeyInfo, 4> kRubberKeys{{
    {.key = "stiffness", .unit = "N/m", .fallback = 1e5, .minimum_exclusive = true, .per_component = true, .meaning = "force per displacement; from about 1e5 N/m down, flexibility shows in the results"},
    {.key = "damping", .unit = "N*s/m", .fallback = 500, .per_component = true, .meaning = "force per rate of it"},
    {.key = "angular_stiffness", .unit = "N*m/rad", .fallback = 100, .minimum_exclusive = true, .meaning = "moment per forbidden angle, in joints that forbid one"},
    {.key = "angular_damping", .unit = "N*m*s/rad", .fallback = 0.1, .meaning = "moment per rate of that angle"},
}};

constexpr std::array<std::string_view, 2> kElementWords{"lumped", "sum"};
constexpr std::array<KeyInfo, 12> kRollingKeys{{
    {.key = "stiffness", .unit = "N/m", .fallback = 2e8, .minimum_exclusive = true, .meaning = "radial, of a bearing whose balls or rollers are not stated; 1e8 to 30e8 N/m"},
    {.key = "damping", .unit = "N*s/m", .fallback = 3500, .meaning = "radial; 2e3 to 10e3 N*s/m"},
    {.key = "balls", .unit = "", .meaning = "number of balls of a deep-groove or angular-contact bearing; with ball_diameter it gives force against deflection"},
    {.key = "ball_diameter", .unit = "m", .meaning = "of the balls"},
    {.key = "rollers", .unit = "", .meaning = "number of cylindrical rollers; with roller_length"},
    {.key = "roller_length", .unit = "m", .meaning = "over which a roller carries"},
    {.key = "contact_angle", .unit = "rad", .meaning = "between the line through a ball's contacts and the radial plane"},
    {.key = "play", .unit = "m", .meaning = "radial play, diametral: how far the ring can be moved from side to side"},
    {.key = "preload", .unit = "N", .meaning = "load of each ball or roller of a centred bearing; with elements = \"sum\""},
    {.key = "elements", .unit = "", .words = kElementWords, .meaning = "the bearing as a whole, or the sum over its balls or rollers at fixed places round the first marker, the first on its axis"},
    {.key = "cage_angle", .unit = "rad", .minimum = kAny, .meaning = "of the first ball or roller from the first marker's axis, with elements = \"sum\""},
    {.key = "damping_depth", .unit = "m", .fallback = 1e-6, .minimum_exclusive = true, .meaning = "deflection over which damping grows after touch, where there is play"},
}};

struct Elements {
  double count = 0;      // Z
  double stiffness = 0;  // K_1, radial load of one element = K_1 (radial deflection)^n [N/m^n]
  double exponent = 1;   // n
  double share = 1;      // load of the most loaded element over load of the bearing
};

// Palmgren and Harris, formulas in N and mm: theory/bearings Eqs. (2.1), (2.2).
Elements elements_of(const LawSetting& at) {
  Elements e;
  const bool balls = at.number("balls") > 0;
  e.count = balls ? at.number("balls") : at.number("rollers");
  if (e.count == 0) return e;
  const double cosine = std::cos(at.number("contact_angle")), play = at.number("play");
  const double size = 1e3 * (balls ? at.number("ball_diameter") : at.number("roller_length"));
  e.exponent = balls ? 1.5 : 10.0 / 9;
  const double softness = balls ? 4.36e-4 / std::cbrt(size) : 7.68e-5 / std::pow(size, 0.8);  // mm per N^(1/n), along the contact
  e.stiffness = cosine * std::pow(1e3 * cosine / softness, e.exponent);
  e.share = (play > 0 ? 5 : balls ? 4.37 : 4.08) / (e.count * cosine);
  return e;
}

LawFault rolling_fault(const LawSetting& at) {
  const double balls = at.number("balls"), rollers = at.number("rollers");
  if (balls > 0 && rollers > 0) return {"rollers", "a bearing has balls or rollers", "delete one of the two"};
  for (const auto& [count, size, number, others] : {std::tuple("balls", "ball_diameter", balls, rollers), std::tuple("rollers", "roller_length", rollers, balls)}) {
    if (number != std::floor(number)) return {count, "this is a whole number", fmt::format("{} = {}", count, std::floor(number))};
    if (number > 0 && at.number(size) == 0) return {count, fmt::format("force against deflection follows from the number and the size of the {}", count), fmt::format("{} beside it, such as \"10 mm\"", size)};
    if (number == 0 && at.number(size) > 0) return {size, fmt::format("the bearing has no {}", count), others > 0 ? "delete it" : fmt::format("{} = 8, or another number of them", count)};
  }
  if (balls + rollers > 0 && at.states("stiffness")) return {"stiffness", fmt::format("that of the {} follows from their number and size", balls > 0 ? "balls" : "rollers"), fmt::format("delete it, or delete {0} and their size and state a stiffness alone", balls > 0 ? "balls" : "rollers")};
  if (at.number("contact_angle") >= 0.5 * std::numbers::pi - 1e-9) return {"contact_angle", "such a bearing carries no radial load", "an angle below 90 deg, of angular-contact bearings 15 to 40 deg"};
  if (at.number("preload") > 0 && at.number("play") > 0) return {"preload", "a bearing with play is not preloaded", "delete play or preload"};
  const bool sum = at.number("elements") == 1;
  if (!sum && at.number("preload") > 0) return {"preload", "preload acts on single balls and rollers", "elements = \"sum\" beside it"};
  if (sum && balls + rollers < 3) return {"elements", "a ring is held by three balls or rollers at least", "balls = 8 with a ball_diameter, or rollers = 12 with a roller_length"};
  return {};
}

void make_rolling(const LawSetting& at, Law& law) {
  const Elements e = elements_of(at);
  const double play = at.number("play"), damping = at.number("damping"), depth = at.number("damping_depth");
  if (e.count == 0 && play == 0) {
    law.set_linear({{at.number("stiffness"), at.number("stiffness"), 0}, {damping, damping, 0}});
    return;
  }
  RollingBearingLaw bearing{e.count > 0 ? e.stiffness / (e.share * std::cos(at.number("contact_angle"))) : at.number("stiffness"), e.exponent, damping, play, 0, depth, e.count > 0 ? e.share : 0, {}};
  if (at.number("elements") == 1) {
    const double cosine = std::cos(at.number("contact_angle"));
    bearing.stiffness = e.stiffness;
    bearing.damping = 2 * damping / e.count;
    bearing.interference = std::pow(at.number("preload") * cosine / e.stiffness, 1 / e.exponent);
    bearing.element_share = 1 / cosine;
    for (int j = 0; j < static_cast<int>(e.count); ++j) {
      const double angle = at.number("cage_angle") + 2 * std::numbers::pi * j / e.count;
      bearing.elements.push_back({std::cos(angle), std::sin(angle)});
    }
  }
  law.add(std::make_unique<LawPartOf<RollingBearingLaw>>(bearing));
}

constexpr std::array<std::string_view, 4> kFilmWords{"linear", "short", "long", "finite"};
constexpr std::array<KeyInfo, 9> kJournalKeys{{
    {.key = "film", .unit = "", .words = kFilmWords, .meaning = "a spring and a damper; or an oil film that cavitates, of a short bearing, a long one, or one of finite length"},
    {.key = "stiffness", .unit = "N/m", .fallback = 5e7, .minimum_exclusive = true, .meaning = "radial, with film = \"linear\"; 1e7 to 10e7 N/m"},
    {.key = "damping", .unit = "N*s/m", .fallback = 3e5, .meaning = "radial, with film = \"linear\"; 1e5 to 5e5 N*s/m"},
    {.key = "journal_radius", .unit = "m", .meaning = "of a film: radius of the pin"},
    {.key = "bearing_length", .unit = "m", .meaning = "of a film: along the axis; a finite film suits any, a short one up to a quarter of the diameter, a long one sealed ends"},
    {.key = "radial_clearance", .unit = "m", .meaning = "of a film: radius of the bush less that of the pin"},
    {.key = "viscosity", .unit = "N*s/m^2", .meaning = "of a film: dynamic viscosity of the oil, 0.1 for 100 cP"},
    {.key = "roughness", .unit = "m", .fallback = 1e-6, .minimum_exclusive = true, .meaning = "of a film: its least thickness, at which the surfaces touch"},
    {.key = "contact_stiffness", .unit = "N/m", .fallback = 1e9, .minimum_exclusive = true, .meaning = "of a film: of the surfaces where they touch"},
}};

LawFault journal_fault(const LawSetting& at) {
  const bool film = at.number("film") > 0;
  constexpr std::array<std::array<const char*, 2>, 4> kNeeded{{{"journal_radius", "\"20 mm\""}, {"bearing_length", "\"20 mm\""}, {"radial_clearance", "\"30 um\""}, {"viscosity", "\"0.03 N*s/m^2\""}}};
  for (const auto& [key, example] : kNeeded) {
    if (film && at.number(key) == 0) return {key, fmt::format("an oil film needs its {}, greater than 0", key), fmt::format("{} = {}", key, example)};
    if (!film && at.number(key) > 0) return {key, "a spring and a damper have no film", "film = \"finite\", or delete it"};
  }
  if (film && at.number("radial_clearance") >= 0.1 * at.number("journal_radius"))
    return {"radial_clearance", "the film is thin against the radius in this theory", "about a thousandth of the radius"};
  if (film && at.number("roughness") >= 0.5 * at.number("radial_clearance"))
    return {"roughness", fmt::format("half of the clearance, {:g} m, is no more than the roughness: there is no room for a film", 0.5 * at.number("radial_clearance")), "a roughness of a few hundredths of the clearance"};
  return {};
}

void make_journal(const LawSetting& at, Law& law) {
  if (at.number("film") == 0) {
    law.set_linear({{at.number("stiffness"), at.number("stiffness"), 0}, {at.number("damping"), at.number("damping"), 0}});
    return;
  }
  using Flow = JournalFilmLaw::Flow;
  constexpr std::array<Flow, 3> kFlows{Flow::kAxial, Flow::kAround, Flow::kBoth};  // for the words after "linear"
  law.add(std::make_unique<LawPartOf<JournalFilmLaw>>(JournalFilmLaw{at.number("journal_radius"), at.number("bearing_length"), at.number("radial_clearance"), at.number("viscosity"),
                                                                     at.number("roughness"), at.number("contact_stiffness"), kFlows.at(static_cast<std::size_t>(at.number("film")) - 1)}));
}

constexpr std::array<std::string_view, 2> kTablePoints{"displacement", "force"};
constexpr std::array<KeyInfo, 6> kTableKeys{{
    {.key = "displacement", .unit = "m", .minimum = kAny, .required = true, .list = true, .meaning = "of the table's points, rising; where the first is 0 the table is completed to both sides"},
    {.key = "force", .unit = "N", .minimum = kAny, .required = true, .list = true, .meaning = "with which the joint resists at these displacements, not falling"},
    {.key = "curve", .unit = "", .points = kTablePoints, .meaning = "a table of the model whose points these are, instead of the two lists"},
    {.key = "damping", .unit = "N*s/m", .meaning = "of a damper beside it"},
    {.key = "angular_stiffness", .unit = "N*m/rad", .fallback = 1e6, .minimum_exclusive = true, .meaning = "moment per forbidden rotation, for joints that forbid it"},
    {.key = "angular_damping", .unit = "N*m*s/rad", .fallback = 30, .meaning = "moment per rate of forbidden rotation"},
}};

LawFault table_fault(const LawSetting& at) {
  const std::vector<double> x = at.list("displacement"), force = at.list("force");
  if (x.size() < 2) return {"displacement", "a table has two points at least", "displacement = [0, \"0.1 mm\"] and force = [0, \"100 N\"]"};
  if (x.size() != force.size()) return {"force", fmt::format("{} forces for {} displacements", force.size(), x.size()), "one force for each entry of displacement"};
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (!(x[i] > x[i - 1])) return {"displacement", fmt::format("entry {}, {:g} m, is not above the one before it, {:g} m", i + 1, x[i], x[i - 1]), "displacements in rising order, each once"};
    if (force[i] < force[i - 1])
      return {"force", fmt::format("entry {}, {:g} N, is below the one before it, {:g} N: such a joint is not stable there", i + 1, force[i], force[i - 1]), "forces that do not fall"};
  }
  if (!(force.back() > force.front())) return {"force", "it is the same everywhere, so that it holds nothing", "forces that rise"};
  if (x.front() == 0 && force.front() != 0) return {"force", "a table that begins at 0 is completed to both sides, and its force there is 0", "0 as the first force, or a table that begins below 0"};
  if (at.held[0] && at.held[1] && x.front() != 0) return {"displacement", with_article(at.joint_type) + " joint is displaced in any direction, so that its table begins at 0", "displacement = [0, ...]"};
  return {};
}

void make_table(const LawSetting& at, Law& law) {
  const std::vector<double> x = at.list("displacement");
  const bool radial = at.held[0] && at.held[1];
  Planar::Vec k = at.by_component("damping", "angular_stiffness");
  k.head<2>().setZero();
  law.set_linear({k, at.by_component("damping", "angular_damping")});
  law.add(std::make_unique<LawPartOf<TableLaw>>(
      TableLaw{MonotoneTable(x, at.list("force"), x.front() == 0 ? MonotoneTable::Symmetry::kOdd : MonotoneTable::Symmetry::kNone), radial, at.held[0] ? 0 : 1}));
}

constexpr std::array<LawInfo, 5> kBearings{{
    {.word = "linear-guide", .meaning = "a linear bearing: a spring and a damper, and the resistance to turning of a carriage that carries evenly", .keys = kGuideKeys, .stiffens = true, .joints = kSlides, .make = make_guide},
    {.word = "rubber-bushing", .meaning = "a soft bushing: a spring and a damper; a torsion spring beside it is the twist of bonded rubber", .keys = kRubberKeys, .stiffens = true, .yields = true, .joints = kBushed, .make = make_linear},
    {.word = "rolling-bearing", .meaning = "a ball or roller bearing: a spring and a damper, or force against deflection from its balls or rollers, with play or preload", .keys = kRollingKeys, .joints = kPins, .make = make_rolling, .fault = rolling_fault},
    {.word = "journal-bearing", .meaning = "a plain bearing: a spring and a damper, or a film of oil between pin and bush", .keys = kJournalKeys, .joints = kPins, .make = make_journal, .fault = journal_fault},
    {.word = "table", .meaning = "a measured force against displacement, by smooth pieces that do not overshoot; of a pin against its length, in every direction alike", .keys = kTableKeys, .joints = kTwoSided, .make = make_table, .fault = table_fault},
}};

}  // namespace

void add_bearing_laws(std::vector<LawInfo>& all) { all.insert(all.end(), kBearings.begin(), kBearings.end()); }

}  // namespace pintle

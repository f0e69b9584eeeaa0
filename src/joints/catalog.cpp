#include "joints/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "joints/belt.h"

namespace pintle {
namespace {

constexpr ComponentInfo kX{.name = "x"}, kY{.name = "y", .place = 1}, kTurn{.name = "angle", .place = 2, .angular = true};
constexpr std::array<ComponentInfo, 2> kXY{kX, kY};
constexpr std::array<ComponentInfo, 2> kAcrossAngle{{{.name = "across", .place = 1}, kTurn}};
constexpr std::array<ComponentInfo, 3> kXYAngle{kX, kY, kTurn};
constexpr std::array<ComponentInfo, 1> kAcross{{{.name = "across", .place = 1}}};
constexpr std::array<ComponentInfo, 1> kAlong{{{.name = "along"}}};
constexpr std::array<ComponentInfo, 1> kPitch{{{.name = "pitch"}}};
constexpr std::array<ComponentInfo, 1> kNormal{{{.name = "normal"}}};
constexpr std::array<ComponentInfo, 1> kAngle{kTurn};
constexpr std::array<ComponentInfo, 1> kSlide{{{.name = "slide"}}};
constexpr std::array<ComponentInfo, 1> kStroke{{{.name = "stroke"}}};
constexpr std::array<ComponentInfo, 2> kSlideAngle{{{.name = "slide"}, kTurn}};

constexpr double kAny = -std::numeric_limits<double>::infinity();  // a minimum that allows all values
constexpr KeyInfo kStretch{.key = "stretch", .unit = "m", .minimum = kAny, .otherwise = "0: without load", .meaning = "how much longer than unloaded it is when assembled: its tension over its stiffness; negative: slack, or a rod that is compressed"};
constexpr std::array<KeyInfo, 2> kTie{{
    {.key = "length", .unit = "m", .minimum_exclusive = true, .of_time = true, .meaning = "distance between the points without load; as a function of t it is driven: a winch, an actuator"},
    kStretch,
}};
constexpr std::array<std::string_view, 2> kOfStroke{"stroke", "stroke_rate"};
constexpr std::array<KeyInfo, 7> kCylinder{{
    {.key = "bore", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "diameter of the piston"},
    {.key = "rod_diameter", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "diameter of the rod, below the bore"},
    {.key = "closed_length", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "distance between the points with the rod in"},
    {.key = "stroke", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "how far the rod comes out"},
    {.key = "cap_pressure", .unit = "Pa", .minimum = kAny, .of_time = true, .also_of = kOfStroke, .otherwise = "that of the surroundings", .meaning = "on the whole piston; it pushes the rod out"},
    {.key = "rod_pressure", .unit = "Pa", .minimum = kAny, .of_time = true, .also_of = kOfStroke, .otherwise = "that of the surroundings", .meaning = "on the piston's side with the rod; it pushes the rod in"},
    {.key = "ambient_pressure", .unit = "Pa", .otherwise = "0: pressures are those over the surroundings'", .meaning = "of the surroundings, where pressures are absolute: 1.01325 bar"},
}};
constexpr std::array<std::string_view, 2> kSides{"left", "right"};
constexpr std::array<KeyInfo, 5> kBelt{{
    {.key = "first_radius", .unit = "m", .otherwise = "0: the belt ends in the marker", .meaning = "of the disc about the first marker, up to the middle of the belt"},
    {.key = "second_radius", .unit = "m", .otherwise = "0: the belt ends in the marker", .meaning = "of the disc about the second marker"},
    {.key = "first_side", .unit = "", .words = kSides, .otherwise = "left", .meaning = "where the belt leaves the first disc, seen from there towards the second"},
    {.key = "second_side", .unit = "", .words = kSides, .otherwise = "that of the first disc", .meaning = "where it reaches the second disc, seen in the same way; the other side: crossed"},
    kStretch,
}};
constexpr KeyInfo kPressureAngle{.key = "pressure_angle", .unit = "rad", .otherwise = "0: no radial force", .meaning = "of the teeth, 20 deg mostly: with it they also push both apart"};
constexpr std::array<KeyInfo, 1> kGear{{kPressureAngle}};
constexpr std::array<KeyInfo, 2> kRack{{
    {.key = "radius", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "pitch radius of the pinion (the first body)"},
    kPressureAngle,
}};

double value(const Geometry& geometry, const char* key, double otherwise) {
  const auto it = geometry.find(key);
  return it == geometry.end() ? otherwise : it->second;
}
JointDisplacement make_pose(const Geometry&) { return Selection{}; }
JointDisplacement make_distance(const Geometry& g) { return Distance{value(g, "length", 0)}; }
JointDisplacement make_stroke(const Geometry& g) { return Distance{value(g, "closed_length", 0)}; }
GeometryFault cylinder_fault(const Geometry& g) {
  const double bore = value(g, "bore", 1), rod = value(g, "rod_diameter", 0), ambient = value(g, "ambient_pressure", 0);
  if (rod >= bore) return {"rod_diameter", fmt::format("the rod of {:g} m does not fit into the bore of {:g} m", rod, bore), "a rod thinner than the bore"};
  const double vacuum = vacuum_of(g);
  for (const char* key : {"cap_pressure", "rod_pressure"})
    if (value(g, key, 0) < vacuum)
      return {key, fmt::format("this is below vacuum, which is at {:g} Pa {}", vacuum, ambient > 0 ? "where ambient_pressure makes pressures absolute" : "over the surroundings"), "the other chamber's pressure, if the cylinder is to pull"};
  return {};
}
GeometryFault teeth_fault(const Geometry& g) {
  constexpr double kMost = std::numbers::pi / 4;
  if (const double angle = value(g, "pressure_angle", 0); angle > kMost) return {"pressure_angle", fmt::format("{:.4g} rad is more than 45 deg", angle), "20 deg, of most gears"};
  return {};
}
JointDisplacement make_mesh(const Geometry& g) {
  return Mesh{value(g, "radius_first", 1), value(g, "radius_second", 1), value(g, "internal", 0) > 0 ? -1.0 : 1.0, 0, value(g, "pressure_angle", 0) > 0};
}
JointDisplacement make_rack(const Geometry& g) { return RackMesh{value(g, "radius", 1), 1, 0, value(g, "pressure_angle", 0) > 0}; }

// A side is given by the index of its word.
JointDisplacement make_belt(const Geometry& g) {
  const double first = value(g, "first_side", 0), second = value(g, "second_side", first);
  const auto signed_radius = [&g](const char* key, double side) { return value(g, key, 0) * (side > 0 ? -1 : 1); };
  return function_of({signed_radius("first_radius", first), signed_radius("second_radius", second), 0, value(g, "stretch", 0)});
}
GeometryFault tie_fault(const Geometry& g) {
  if (!g.contains("length") || !g.contains("stretch")) return {};
  return {"stretch", "the length is stated already, and the assembled positions of the points determine the stretch", "delete one of the two: without length it is the distance as assembled, less the stretch"};
}
GeometryFault belt_fault(const Geometry& g) {
  const double first = value(g, "first_radius", 0), second = value(g, "second_radius", 0);
  if (first == 0 && second == 0) return {"first_radius", "a belt winds onto one disc at least", "first_radius, or type = \"rope\" between two points"};
  if (second == 0 && g.contains("second_side")) return {"second_side", "the belt ends in the second marker, which has no sides", "second_radius, or delete it"};
  if (first == 0 && g.contains("first_side")) return {"first_side", "the belt ends in the first marker, which has no sides", "first_radius, or delete it"};
  return {};
}

JointDisplacement make_cam(const Geometry&) { return CamGap{}; }
JointDisplacement make_edge(const Geometry&) { return EdgeGap{}; }

// The gear's keys `radii` and `mesh` are lists and words, which the reader turns into radius_first, radius_second, internal. The profiles of cams and edges belong to the model.
std::vector<JointTypeInfo>& types() {
  static std::vector<JointTypeInfo> all{
      {.word = "revolute", .meaning = "a pin: holds two points together, the angle is free", .gap = kXY, .free = kAngle, .keys = {}, .make = make_pose},
      {.word = "prismatic", .meaning = "a slider: keeps two axes collinear, the slide along them is free", .gap = kAcrossAngle, .free = kSlide, .keys = {}, .make = make_pose},
      {.word = "fixed", .meaning = "a weld with compliance: fixes point and angle", .gap = kXYAngle, .free = {}, .keys = {}, .make = make_pose},
      {.word = "slot", .meaning = "a pin (second) in a straight slot (first marker's axis)", .gap = kAcross, .free = kSlideAngle, .keys = {}, .make = make_pose},
      {.word = "rod", .meaning = "a massless rod: keeps two points at a distance", .gap = kAlong, .free = {}, .keys = kTie, .make = make_distance, .fault = tie_fault},
      {.word = "rope", .meaning = "a rope: limits the distance of two points to its length", .gap = kAlong, .free = {}, .keys = kTie, .one_sided = true, .make = make_distance, .fault = tie_fault},
      {.word = "belt", .meaning = "a free run of a belt, or a rope on a drum: it winds onto discs about its markers without slip, and pulls only", .gap = kAlong, .free = {}, .keys = kBelt, .one_sided = true, .make = make_belt,
       .fault = belt_fault},
      {.word = "cylinder", .meaning = "a hydraulic or pneumatic cylinder, pinned at two points: pressure times area pushes or pulls along the line between them", .gap = {}, .free = kStroke, .keys = kCylinder, .has_ends = true, .make = make_stroke,
       .fault = cylinder_fault},
      {.word = "gear", .meaning = "two gears in mesh, centred on the two markers", .gap = kPitch, .free = {}, .keys = kGear, .make = make_mesh, .fault = teeth_fault},
      {.word = "rack", .meaning = "a pinion (first) rolling along a rack (second marker's axis)", .gap = kPitch, .free = {}, .keys = kRack, .make = make_rack, .fault = teeth_fault},
      {.word = "cam", .meaning = "a cam (first) and what follows it (second): a roller, a pin or a flat face", .gap = kNormal, .free = {}, .keys = {}, .make = make_cam},
      {.word = "edge", .meaning = "a pin, roller or wheel (second) on the +y side of a curved edge (first): ramps, tracks, roads", .gap = kNormal, .free = {}, .keys = {}, .make = make_edge},
  };
  return all;
}

}  // namespace

std::span<const JointTypeInfo> joint_type_catalog() { return types(); }

const JointTypeInfo* find_joint_type(std::string_view word) {
  const auto it = std::find_if(types().begin(), types().end(), [&](const JointTypeInfo& type) { return type.word == word; });
  return it == types().end() ? nullptr : &*it;
}

void register_joint_type(const JointTypeInfo& info) {
  if (find_joint_type(info.word)) throw std::logic_error("there is a joint type '" + std::string(info.word) + "' already");
  types().push_back(info);
}

double vacuum_of(const Geometry& cylinder) {
  constexpr double kAtmosphere = 101325;  // standard [Pa]
  return value(cylinder, "ambient_pressure", 0) > 0 ? 0 : -kAtmosphere;
}

}  // namespace pintle

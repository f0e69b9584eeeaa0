#include "joints/catalog.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

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
constexpr std::array<ComponentInfo, 2> kSlideAngle{{{.name = "slide"}, kTurn}};

constexpr std::array<KeyInfo, 1> kLength{{
    {.key = "length", .unit = "m", .minimum_exclusive = true, .of_time = true, .meaning = "distance between the points; as a function of t it is driven: a winch, an actuator"},
}};
constexpr std::array<KeyInfo, 1> kRackRadius{{
    {.key = "radius", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "pitch radius of the pinion (the first body)"},
}};

double value(const Geometry& geometry, const char* key, double otherwise) {
  const auto it = geometry.find(key);
  return it == geometry.end() ? otherwise : it->second;
}
JointDisplacement make_pose(const Geometry&) { return Selection{}; }
JointDisplacement make_distance(const Geometry& g) { return Distance{value(g, "length", 0)}; }
JointDisplacement make_mesh(const Geometry& g) {
  return Mesh{value(g, "radius_first", 1), value(g, "radius_second", 1), value(g, "internal", 0) > 0 ? -1.0 : 1.0, 0};
}
JointDisplacement make_rack(const Geometry& g) { return RackMesh{value(g, "radius", 1), 1, 0}; }

JointDisplacement make_cam(const Geometry&) { return CamGap{}; }

// The gear's keys `radii` and `mesh` are lists and words; the reader turns them into radius_first, radius_second, internal. A cam's profile is the model's.
std::vector<JointTypeInfo>& types() {
  static std::vector<JointTypeInfo> all{
      {.word = "revolute", .meaning = "a pin: holds two points together, the angle is free", .gap = kXY, .free = kAngle, .keys = {}, .make = make_pose},
      {.word = "prismatic", .meaning = "a slider: keeps two axes collinear, the slide along them is free", .gap = kAcrossAngle, .free = kSlide, .keys = {}, .make = make_pose},
      {.word = "fixed", .meaning = "a weld with compliance: fixes point and angle", .gap = kXYAngle, .free = {}, .keys = {}, .make = make_pose},
      {.word = "slot", .meaning = "a pin (second) in a straight slot (first marker's axis)", .gap = kAcross, .free = kSlideAngle, .keys = {}, .make = make_pose},
      {.word = "rod", .meaning = "a massless rod: keeps two points at a distance", .gap = kAlong, .free = {}, .keys = kLength, .make = make_distance},
      {.word = "rope", .meaning = "a rope: limits the distance of two points to its length", .gap = kAlong, .free = {}, .keys = kLength, .one_sided = true, .make = make_distance},
      {.word = "gear", .meaning = "two gears in mesh, centred on the two markers", .gap = kPitch, .free = {}, .keys = {}, .make = make_mesh},
      {.word = "rack", .meaning = "a pinion (first) rolling along a rack (second marker's axis)", .gap = kPitch, .free = {}, .keys = kRackRadius, .make = make_rack},
      {.word = "cam", .meaning = "a cam (first) and what follows it (second): a roller, a pin or a flat face", .gap = kNormal, .free = {}, .keys = {}, .make = make_cam},
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

}  // namespace pintle

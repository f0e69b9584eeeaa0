#include "joints/catalog.h"

#include <algorithm>
#include <array>

namespace pintle {
namespace {

constexpr std::array<ComponentInfo, 2> kXY{{{.name = "x"}, {.name = "y"}}};
constexpr std::array<ComponentInfo, 2> kAcrossAngle{{{.name = "across"}, {.name = "angle", .angular = true}}};
constexpr std::array<ComponentInfo, 3> kXYAngle{{{.name = "x"}, {.name = "y"}, {.name = "angle", .angular = true}}};
constexpr std::array<ComponentInfo, 1> kAcross{{{.name = "across"}}};
constexpr std::array<ComponentInfo, 1> kAlong{{{.name = "along"}}};
constexpr std::array<ComponentInfo, 1> kPitch{{{.name = "pitch"}}};
constexpr std::array<ComponentInfo, 1> kAngle{{{.name = "angle", .angular = true}}};
constexpr std::array<ComponentInfo, 1> kSlide{{{.name = "slide"}}};
constexpr std::array<ComponentInfo, 2> kSlideAngle{{{.name = "slide"}, {.name = "angle", .angular = true}}};

constexpr std::array<KeyInfo, 1> kLength{{
    {.key = "length", .unit = "m", .minimum_exclusive = true, .meaning = "distance between the points; default: as assembled"},
}};
constexpr std::array<KeyInfo, 1> kRackRadius{{
    {.key = "radius", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "pitch radius of the pinion (the first body)"},
}};

// The gear's keys `radii` and `mesh` are lists and words; the reader turns them into radius_first, radius_second, internal.
constexpr std::array<JointTypeInfo, 8> kTypes{{
    {.word = "revolute", .meaning = "a pin: holds two points together, the angle is free", .gap = kXY, .free = kAngle, .keys = {}},
    {.word = "prismatic", .meaning = "a slider: keeps two axes collinear, the slide along them is free", .gap = kAcrossAngle, .free = kSlide, .keys = {}},
    {.word = "fixed", .meaning = "a weld with compliance: fixes point and angle", .gap = kXYAngle, .free = {}, .keys = {}},
    {.word = "slot", .meaning = "a pin (second) in a straight slot (first marker's axis)", .gap = kAcross, .free = kSlideAngle, .keys = {}},
    {.word = "rod", .meaning = "a massless rod: keeps two points at a distance", .gap = kAlong, .free = {}, .keys = kLength},
    {.word = "rope", .meaning = "a rope: limits the distance of two points to its length", .gap = kAlong, .free = {}, .keys = kLength},
    {.word = "gear", .meaning = "two gears in mesh, centred on the two markers", .gap = kPitch, .free = {}, .keys = {}},
    {.word = "rack", .meaning = "a pinion (first) rolling along a rack (second marker's axis)", .gap = kPitch, .free = {}, .keys = kRackRadius},
}};

}  // namespace

std::span<const JointTypeInfo> joint_type_catalog() { return kTypes; }

const JointTypeInfo* find_joint_type(std::string_view word) {
  const auto it = std::find_if(kTypes.begin(), kTypes.end(), [&](const JointTypeInfo& type) { return type.word == word; });
  return it == kTypes.end() ? nullptr : &*it;
}

}  // namespace pintle

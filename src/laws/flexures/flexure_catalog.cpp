// The catalog's entries for flexures; the head comments of their structs state the equations.
#include <fmt/format.h>

#include <memory>
#include <numbers>

#include "laws/catalog_parts.h"
#include "laws/flexures/cross_spring.h"
#include "laws/flexures/leaf_spring.h"
#include "laws/flexures/notch_hinge.h"

namespace pintle {
namespace {

constexpr std::array<std::string_view, 1> kWelds{"fixed"};
constexpr std::array<std::string_view, 2> kPlaneWords{"stress", "strain"}, kShearWords{"neglected", "included"};
constexpr double kSlenderness = 5, kShearFactor = 5.0 / 6;  // least ratio of a blade's length to its thickness; shear factor of a rectangle

constexpr KeyInfo kLength{.key = "length", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "of the blade between its clamps, the two markers"};
constexpr KeyInfo kBladeLength{.key = "length", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "of each of the two blades between its clamps"};
constexpr KeyInfo kWidth{.key = "width", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "out of the plane; of several blades side by side their sum"};
constexpr KeyInfo kThickness{.key = "thickness", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "in the plane, below a fifth of the length"};
constexpr KeyInfo kModulus{.key = "elastic_modulus", .unit = "Pa", .fallback = 207e9, .minimum_exclusive = true, .meaning = "Young's, E; the default is that of steel"};
constexpr KeyInfo kPoisson{.key = "poisson_ratio", .unit = "", .fallback = 0.3, .meaning = "nu, at most 0.5; in the shear modulus and in plane = \"strain\""};
constexpr KeyInfo kPlane{.key = "plane", .unit = "", .words = kPlaneWords, .meaning = "stress: as narrow as thick, modulus E; strain: much wider than thick, modulus E/(1 - nu^2)"};
constexpr KeyInfo kShear{.key = "shear", .unit = "", .words = kShearWords, .meaning = "deformation by shear (Timoshenko), of blades that are not thin"};
constexpr KeyInfo kDampingTime{.key = "damping_time", .unit = "s", .fallback = 1e-5, .meaning = "damping of the material (Kelvin and Voigt): stress E (strain + damping_time * strain rate); a mode of frequency w has the damping ratio w * damping_time / 2"};

constexpr std::array<KeyInfo, 8> kLeafKeys{{kLength, kWidth, kThickness, kModulus, kPoisson, kPlane, kShear, kDampingTime}};
constexpr std::array<KeyInfo, 10> kCrossKeys{{
    kBladeLength, kWidth, kThickness,
    {.key = "crossing_angle", .unit = "rad", .fallback = 0.5 * std::numbers::pi, .minimum_exclusive = true, .meaning = "between the two blades; the markers' axes halve it"},
    {.key = "crossing", .unit = "", .fallback = 0.5, .meaning = "where they cross: the part of a blade between the first body and the crossing, 0 to 1"},
    kModulus, kPoisson, kPlane, kShear, kDampingTime,
}};
constexpr std::array<KeyInfo, 9> kNotchKeys{{
    {.key = "thickness", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "of the neck, where it is thinnest"},
    {.key = "radius", .unit = "m", .meaning = "of circular cut-outs on both sides"},
    {.key = "semi_axis_x", .unit = "m", .meaning = "of elliptic ones instead: along the neck"},
    {.key = "semi_axis_y", .unit = "m", .meaning = "and across it"},
    {.key = "width", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "out of the plane"},
    kModulus, kPoisson, kPlane, kDampingTime,
}};

double modulus_of(const LawSetting& at) {
  const double poisson = at.number("poisson_ratio");
  return at.number("elastic_modulus") / (at.number("plane") > 0 ? 1 - poisson * poisson : 1);  // (1.1)
}
double shear_modulus_of(const LawSetting& at) { return at.number("elastic_modulus") / (2 * (1 + at.number("poisson_ratio"))); }

BladeSize blade_of(const LawSetting& at) {
  BladeSize blade{at.number("length"), at.number("width"), at.number("thickness"), modulus_of(at), 0, at.number("damping_time")};
  if (at.number("shear") > 0) blade.shear_stiffness = kShearFactor * shear_modulus_of(at) * blade.width * blade.thickness;  // (1.2)
  return blade;
}

LawFault material_fault(const LawSetting& at) {
  const double poisson = at.number("poisson_ratio");
  if (poisson > 0.5) return {"poisson_ratio", fmt::format("{:g} is above 0.5, the value of an incompressible material", poisson), "0.3 for metals"};
  return {};
}

LawFault blade_fault(const LawSetting& at) {
  const double length = at.number("length"), thickness = at.number("thickness");
  if (thickness >= length / kSlenderness)
    return {"thickness", fmt::format("{:g} m is not below a fifth of the length, {:g} m: this is a block and not a blade", thickness, length), "a thinner or a longer blade; a thick one is part of a body"};
  return material_fault(at);
}

LawFault cross_fault(const LawSetting& at) {
  if (at.number("crossing_angle") >= std::numbers::pi) return {"crossing_angle", "blades at such an angle do not cross", "an angle below 180 deg, such as \"90 deg\""};
  if (at.number("crossing") > 1) return {"crossing", fmt::format("{:g} is beyond the far end of the blades", at.number("crossing")), "a part between 0 and 1, such as 0.5"};
  return blade_fault(at);
}

NotchSize notch_of(const LawSetting& at) {
  const double radius = at.number("radius");
  return {at.number("thickness"), radius > 0 ? radius : at.number("semi_axis_x"), radius > 0 ? radius : at.number("semi_axis_y"), at.number("width"), modulus_of(at), shear_modulus_of(at)};
}

LawFault notch_fault(const LawSetting& at) {
  const double radius = at.number("radius"), x = at.number("semi_axis_x"), y = at.number("semi_axis_y"), thickness = at.number("thickness");
  if (radius > 0 && (x > 0 || y > 0)) return {x > 0 ? "semi_axis_x" : "semi_axis_y", "a notch is circular or elliptic", "delete it, or the radius"};
  if (radius == 0 && x == 0 && y == 0) return {"radius", "nothing says how long the neck is", "radius = \"5 mm\", or semi_axis_x and semi_axis_y"};
  if (radius == 0 && (x == 0 || y == 0)) return {x == 0 ? "semi_axis_x" : "semi_axis_y", "an ellipse has two semi-axes, each greater than 0", "state both, or a radius"};
  const NotchSize notch = notch_of(at);
  if (thickness > notch.semi_axis_y)
    return {"thickness", fmt::format("{:g} m is above {}, {:g} m: such a neck is no hinge", thickness, radius > 0 ? "the radius" : "semi_axis_y", notch.semi_axis_y), "a thickness below half of it"};
  return material_fault(at);
}

void make_leaf(const LawSetting& at, Law& law) { law.add(std::make_unique<LawPartOf<LeafSpringLaw>>(LeafSpringLaw(blade_of(at)))); }
Planar::Point leaf_rest(const LawSetting& at) { return {at.number("length"), 0}; }
void make_cross(const LawSetting& at, Law& law) {
  law.add(std::make_unique<LawPartOf<CrossSpringLaw>>(CrossSpringLaw(blade_of(at), 0.5 * at.number("crossing_angle"), at.number("crossing"))));
}
void make_notch(const LawSetting& at, Law& law) { law.add(std::make_unique<LawPartOf<NotchHingeLaw>>(NotchHingeLaw::of(notch_of(at), at.number("damping_time")))); }

constexpr std::array<LawInfo, 3> kFlexures{{
    {.word = "leaf-spring", .meaning = "a blade from the first marker to the second, along both axes, bent and stretched by any amount; unloaded the second marker is at (length, 0) of the first", .keys = kLeafKeys, .joints = kWelds, .make = make_leaf, .fault = blade_fault, .rest = leaf_rest},
    {.word = "notch-hinge", .meaning = "a neck between two circular or elliptic cut-outs; both markers are in its middle, along it", .keys = kNotchKeys, .joints = kWelds, .make = make_notch, .fault = notch_fault},
    {.word = "cross-spring", .meaning = "a pivot of two equal blades that cross; both markers are where they cross, along the bisector of the blades from the first body to the second", .keys = kCrossKeys, .joints = kWelds, .make = make_cross, .fault = cross_fault},
}};

}  // namespace

void add_flexure_laws(std::vector<LawInfo>& all) { all.insert(all.end(), kFlexures.begin(), kFlexures.end()); }

}  // namespace pintle

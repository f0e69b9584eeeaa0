// The catalog's entries for pins with clearance, contact with an edge, and teeth with play.
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>

#include "laws/catalog.h"
#include "laws/catalog_parts.h"
#include "laws/contact/backlash.h"
#include "laws/contact/damping_keys.h"
#include "laws/contact/gap_contact.h"
#include "laws/contact/guide_contact.h"
#include "laws/contact/pin_contact.h"

namespace pintle {
namespace {

constexpr std::array<std::string_view, 2> kAttraction{"cut-off", "kept"};

constexpr KeyInfo kClearance{.key = "clearance", .unit = "m", .minimum_exclusive = true, .required = true,
                             .meaning = "radius of the bush less that of the pin; in a slot or guide the play to either side"};
constexpr KeyInfo kPinRadius{.key = "pin_radius", .unit = "m", .fallback = 0.01, .minimum_exclusive = true, .meaning = "of the pin, which is on the second body; of a slider, at the edges of its ends"};
constexpr KeyInfo kRollerRadius{.key = "pin_radius", .unit = "m", .fallback = 0.01, .meaning = "of the pin or roller on the second body; 0: a point. On cams and curved edges for the stiffness only: their roller_radius is where it touches"};
constexpr KeyInfo kModel{.key = "contact_model", .unit = "", .words = kContactModels,
                         .meaning = "damping of the contact; only exact returns the restitution that is asked for, linear is a spring and a damper"};
constexpr KeyInfo kRestitution{.key = "restitution", .unit = "", .fallback = 0.8, .minimum_exclusive = true, .meaning = "speed after a free impact over the speed before, at most 1"};
constexpr KeyInfo kStiffness{.key = "contact_stiffness", .unit = "", .meaning = "force at a depth of 1 m [N/m^contact_exponent]; 0: Hertz' of elastic_modulus, pin_radius and clearance"};
constexpr KeyInfo kExponent{.key = "contact_exponent", .unit = "", .fallback = 1.5, .minimum = 1, .meaning = "the force goes as the depth to this power; 1 in the linear model"};
constexpr KeyInfo kModulus{.key = "elastic_modulus", .unit = "Pa", .fallback = 207e9, .minimum_exclusive = true, .meaning = "of pin and bush, where contact_stiffness is not stated"};
constexpr KeyInfo kPoisson{.key = "poisson_ratio", .unit = "", .fallback = 0.3, .meaning = "the same; at most 0.5"};
constexpr KeyInfo kFixedDamping{.key = "damping_factor", .unit = "s/m", .meaning = "damping over elastic force and speed, instead of restitution and approach speed (Hunt and Crossley: 3/2 of their alpha)"};
constexpr KeyInfo kViscous{.key = "contact_damping", .unit = "N*s/m", .meaning = "of the linear model"};
constexpr KeyInfo kLeastApproach{.key = "least_approach_speed", .unit = "m/s", .fallback = 1e-3, .minimum_exclusive = true, .meaning = "floor of the approach speed, also used for contacts that the run starts with"};
constexpr KeyInfo kAttracts{.key = "attraction", .unit = "", .words = kAttraction, .meaning = "where the damping would make the force pull: no force, or the formula as it stands"};
constexpr KeyInfo kFriction{.key = "friction_coefficient", .unit = "", .meaning = "of the pin's surface along the other one"};
constexpr KeyInfo kRampStart{.key = "friction_start_speed", .unit = "m/s", .meaning = "slip below which there is no friction"};
constexpr KeyInfo kRampEnd{.key = "friction_full_speed", .unit = "m/s", .fallback = 1e-3, .minimum_exclusive = true, .meaning = "slip above which there is all of it"};

constexpr KeyInfo kStiction{.key = "static_friction", .unit = "", .minimum_exclusive = true, .otherwise = "no stiction: friction on a ramp", .meaning = "coefficient at which slip begins, not below friction_coefficient, which it requires: with it surfaces stick that do not slip"};
constexpr KeyInfo kStickStiffness{.key = "stick_stiffness", .unit = "N/m", .fallback = 1e8, .minimum_exclusive = true, .meaning = "of surfaces that stick, along each other"};
constexpr KeyInfo kStickDamping{.key = "stick_damping", .unit = "N*s/m", .fallback = 1e5, .meaning = "the same per speed"};

constexpr KeyInfo kGuideLength{.key = "guide_length", .unit = "m", .fallback = 0.05, .minimum_exclusive = true, .meaning = "of a slider: between its two ends, which touch the guide"};

constexpr std::array<KeyInfo, 19> kClearanceKeys{{kClearance, kPinRadius, kGuideLength, kModel, kRestitution, kStiffness, kExponent, kModulus, kPoisson, kFixedDamping, kViscous, kLeastApproach, kAttracts,
                                                  kFriction, kStiction, kRampStart, kRampEnd, kStickStiffness, kStickDamping}};
constexpr std::array<KeyInfo, 17> kEdgeKeys{{kRollerRadius, kModel, kRestitution, kStiffness, kExponent, kModulus, kPoisson, kFixedDamping, kViscous, kLeastApproach, kAttracts,
                                             kFriction, kStiction, kRampStart, kRampEnd, kStickStiffness, kStickDamping}};

constexpr KeyInfo kBacklash{.key = "backlash", .unit = "m", .minimum_exclusive = true, .required = true, .meaning = "circumferential play between the flanks, on the pitch circles"};
constexpr KeyInfo kToothStiffness{.key = "contact_stiffness", .unit = "", .minimum_exclusive = true, .required = true, .meaning = "of the teeth along the pitch circles: force at a depth of 1 m [N/m^contact_exponent]"};
constexpr KeyInfo kToothExponent{.key = "contact_exponent", .unit = "", .fallback = 1, .minimum = 1, .meaning = "the force goes as the depth to this power; 1: teeth that bend"};
constexpr std::array<KeyInfo, 9> kBacklashKeys{{kBacklash, kModel, kRestitution, kToothStiffness, kToothExponent, kFixedDamping, kViscous, kLeastApproach, kAttracts}};

constexpr std::array<std::string_view, 2> kMeshes{"gear", "rack"};
constexpr std::array<std::string_view, 3> kWithClearance{"revolute", "slot", "prismatic"};
constexpr std::array<std::string_view, 3> kOneSided{"slot", "cam", "edge"};

constexpr double kFlat = std::numeric_limits<double>::infinity();

constexpr DampingKeys kDamping{"contact_model", "restitution", "damping_factor", "contact_damping", "contact_exponent", "least_approach_speed"};

LawFault contact_fault(const LawSetting& at) {
  if (LawFault fault = kDamping.fault(at); !fault.key.empty()) return fault;
  const double start = at.number("friction_start_speed"), end = at.number("friction_full_speed");
  const bool rubs = start > 0 || end > 0;  // teeth do not have these keys
  if (rubs && !(end > start)) return {"friction_full_speed", fmt::format("{:g} m/s is not above friction_start_speed, {:g} m/s", end, start), "a larger speed"};
  if (at.number("static_friction") > 0 && !(at.number("friction_coefficient") > 0)) return {"friction_coefficient", "what sticks by static_friction rubs when it slips", "friction_coefficient, at most static_friction"};
  if (const double stuck = at.number("static_friction"); stuck > 0 && stuck < at.number("friction_coefficient"))
    return {"static_friction", fmt::format("{:g} is below friction_coefficient, {:g}: surfaces would hold more firmly when slipping than at rest", stuck, at.number("friction_coefficient")), "static_friction not below friction_coefficient"};
  const double poisson = at.number("poisson_ratio");
  if (poisson > 0.5) return {"poisson_ratio", fmt::format("{:g} is above 0.5, the value of an incompressible material", poisson), "0.3 for metals"};
  const bool linear = kDamping.model_of(at) == ContactModel::kViscous, stated = at.number("contact_stiffness") > 0;
  if (linear && !stated) return {"contact_model", "the linear model has no stiffness from elastic_modulus", "state contact_stiffness in N/m"};
  if (at.joint_type != "revolute" && !stated && !(at.number("pin_radius") > 0)) return {"pin_radius", "a point has no Hertzian stiffness", "a radius, or contact_stiffness"};
  return {};
}

// bearing: the radius of the surface that surrounds the pin.
ContactForce contact_of(const LawSetting& at, double bearing) {
  ContactForce contact;
  contact.stiffness = at.number("contact_stiffness");
  if (!(contact.stiffness > 0)) contact.stiffness = hertz_stiffness(at.number("elastic_modulus"), at.number("poisson_ratio"), at.number("pin_radius"), bearing);
  kDamping.set(at, contact);
  contact.attracts = at.number("attraction") > 0;
  return contact;
}

void set_friction(const LawSetting& at, RubbingContact& law) {
  law.friction = {at.number("friction_coefficient"), at.number("friction_start_speed"), at.number("friction_full_speed")};
  if (const double stuck = at.number("static_friction"); stuck > 0) law.grip = StickSlip{law.friction.coefficient, stuck, 0, at.number("stick_stiffness"), at.number("stick_damping")};
}

void set_contact(const LawSetting& at, PinContact& law) {
  law.radius = at.number("pin_radius");
  law.clearance = at.number("clearance");
  law.contact = contact_of(at, law.shape == PinContact::Shape::kBush ? law.radius + law.clearance : kFlat);
  set_friction(at, law);
}

void make_clearance(const LawSetting& at, Law& law) {
  if (at.held[2]) {
    GuideContactLaw guide;
    guide.clearance = at.number("clearance");
    guide.length = at.number("guide_length");
    guide.contact = contact_of(at, kFlat);
    set_friction(at, guide);
    law.add(std::make_unique<LawPartOf<GuideContactLaw>>(guide));
    return;
  }
  ClearanceLaw contact;
  contact.shape = at.held[0] ? PinContact::Shape::kBush : PinContact::Shape::kSlot;
  set_contact(at, contact);
  law.add(std::make_unique<LawPartOf<ClearanceLaw>>(contact));
}

void make_edge(const LawSetting& at, Law& law) {
  if (at.joint_type != "slot") {
    GapContactLaw surfaces;
    surfaces.contact = contact_of(at, kFlat);
    set_friction(at, surfaces);
    if (at.joint_type == "cam") law.add(std::make_unique<LawPartOf<GapContactLaw>>(surfaces));
    else law.add(std::make_unique<LawPartOf<RoadContactLaw>>(RoadContactLaw{surfaces}));
    return;
  }
  EdgeContactLaw contact;
  contact.shape = PinContact::Shape::kEdge;
  set_contact(at, contact);
  law.add(std::make_unique<LawPartOf<EdgeContactLaw>>(contact));
}

void make_backlash(const LawSetting& at, Law& law) {
  BacklashLaw mesh;
  mesh.set_play(at.number("backlash"));
  mesh.contact = contact_of(at, kFlat);
  law.add(std::make_unique<LawPartOf<BacklashLaw>>(mesh));
}

}  // namespace

void add_contact_laws(std::vector<LawInfo>& all) {
  all.push_back({.word = "clearance", .meaning = "a pin with clearance in its bush or slot, a slider with clearance in its guide: free flight, impact, contact with friction and wear", .keys = kClearanceKeys,
                 .rubs = true, .joints = kWithClearance, .make = make_clearance, .fault = contact_fault});
  all.push_back({.word = "contact", .meaning = "a contact that presses and does not pull: of a pin or roller (second) on the +y side of a straight edge, the first marker's axis (stops, feet, wheels), of a follower on its cam, or of what runs on a curved edge", .keys = kEdgeKeys,
                 .rubs = true, .joints = kOneSided, .make = make_edge, .fault = contact_fault});
  all.push_back({.word = "backlash", .meaning = "teeth with play between their flanks: free travel, impact, and contact of one flank or the other", .keys = kBacklashKeys,
                 .joints = kMeshes, .make = make_backlash, .fault = contact_fault});
}

}  // namespace pintle

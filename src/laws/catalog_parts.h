// The parts from which the catalog of laws is assembled, one file each.
#pragma once

#include <array>
#include <limits>
#include <string_view>
#include <vector>

#include "laws/catalog.h"

namespace pintle {

inline constexpr double kAny = -std::numeric_limits<double>::infinity();  // a minimum that allows all values
/// Joint types whose laws push as well as pull.
inline constexpr std::array<std::string_view, 7> kTwoSided{"revolute", "prismatic", "fixed", "slot", "rod", "gear", "rack"};

/// A spring and a damper in each forbidden component, from "stiffness", "damping" and their angular twins.
void make_linear(const LawSetting& at, Law& law);

/// Dry friction.
void add_friction_laws(std::vector<LawInfo>& all);
/// Bearings, oil films and measured forces.
void add_bearing_laws(std::vector<LawInfo>& all);
/// Leaf springs, notch hinges, cross-spring pivots.
void add_flexure_laws(std::vector<LawInfo>& all);
/// Clearance and contact.
void add_contact_laws(std::vector<LawInfo>& all);
/// Stops for the free coordinate of a joint.
void add_stop_laws(std::vector<LawInfo>& all);
/// Detents for the free coordinate of a joint.
void add_detent_laws(std::vector<LawInfo>& all);
/// Words of `contact_model` and the like, in the order of ContactModel.
inline constexpr std::array<std::string_view, 6> kContactModels{"exact", "lankarani-nikravesh", "hunt-crossley", "flores", "gonthier", "linear"};

}  // namespace pintle

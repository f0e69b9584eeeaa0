// The parts that the catalog of laws is put together from, each a file.
#pragma once

#include <vector>

#include "laws/catalog.h"

namespace pintle {

/// Dry friction.
void add_friction_laws(std::vector<LawInfo>& all);
/// Bearings, oil films and measured forces.
void add_bearing_laws(std::vector<LawInfo>& all);
/// Clearance and contact.
void add_contact_laws(std::vector<LawInfo>& all);

}  // namespace pintle

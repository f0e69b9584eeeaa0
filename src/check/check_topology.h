// Loops and loose parts of the joint graph.
#pragma once

#include "pintle/check.h"
#include "system/system.h"

namespace pintle {

CheckTopology check_topology(const System& system);

}  // namespace pintle

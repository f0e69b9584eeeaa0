// The catalog's entries for bearings and measured force tables; the head comments of their structs state the equations.
#pragma once

#include <span>

#include "laws/catalog.h"

namespace pintle {

std::span<const LawInfo> bearing_laws();

}  // namespace pintle

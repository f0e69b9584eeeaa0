// Checks the values of a law in a model that a program has made; files are checked while they are read, with places and remedies.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "laws/catalog.h"

namespace pintle {

/// A key that no law has or that is missing, a list where one number is due, or a number out of the key's range; empty if there is none of these.
std::string fault_of_values(const LawInfo& law, const std::map<std::string, std::vector<double>>& values);

}  // namespace pintle

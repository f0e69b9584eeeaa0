// The setting of a law in a fixed joint, for the tests of laws.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "laws/catalog.h"

namespace pintle {

inline LawSetting setting_of(const LawInfo& info, const std::map<std::string, std::vector<double>>& values) {
  LawSetting at;
  at.joint_type = "fixed";
  at.held = {true, true, true};
  at.values = &values;
  at.keys = info.keys;
  return at;
}

}  // namespace pintle

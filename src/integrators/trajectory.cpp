#include "pintle/trajectory.h"

#include <algorithm>

namespace pintle {

int Trajectory::column(const std::string& name) const {
  const auto it = std::find_if(columns.begin(), columns.end(), [&](const Column& entry) { return entry.name == name; });
  return it == columns.end() ? -1 : static_cast<int>(it - columns.begin());
}

}  // namespace pintle

#include "run/limits/vacuum_notes.h"

#include <fmt/format.h>

#include <cstddef>

#include "joints/catalog.h"

namespace pintle {

std::vector<std::string> vacuum_notes(const Model& model, const Trajectory& run) {
  constexpr double kBar = 1e5;  // [Pa]
  std::vector<std::string> notes;
  for (const Joint& joint : model.joints)
    for (const char* chamber : {"cap", "rod"}) {
      const int column = run.column(fmt::format("joint.{}.{}_pressure", joint.name, chamber));
      if (column < 0 || run.n_rows() == 0) continue;
      const auto at = [&](std::size_t row) { return run.at(row, static_cast<std::size_t>(column)); };
      std::size_t lowest = 0;
      for (std::size_t row = 1; row < run.n_rows(); ++row)
        if (at(row) < at(lowest)) lowest = row;
      const double vacuum = vacuum_of(joint.geometry);
      if (!(at(lowest) < vacuum)) continue;
      notes.push_back(fmt::format("the pressure on the {} side of cylinder {} falls to {:.4g} bar at t = {:.4g} s, below vacuum ({:.4g} bar): no fluid pulls, oil would cavitate there, and the stated forces are too large. "
                                  "max(..., {:.6g} bar) limits the expression of {}_pressure",
                                  chamber, joint.name, at(lowest) / kBar, run.at(lowest, 0), vacuum / kBar, vacuum / kBar, chamber));
    }
  return notes;
}

}  // namespace pintle

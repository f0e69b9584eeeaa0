// The crossings of borders in a run: those of laws with states and of laws that report their borders, each with the law's report just after it.
#pragma once

#include <vector>

#include "system/state.h"

namespace pintle {

/// One crossing of a border.
struct LawCrossing {
  double t = 0;              // [s]
  int joint = 0, part = 0;   // of the system, of its law
  int border = 0;            // of that part
  bool rising = false;       // its function turned positive
  std::vector<double> seen;  // the columns of all parts of the law there, BasicLaw::columns
};

/// Whether a border at which a law sets its states lies between the values of the switching functions `before` and `after`.
template <class S>
bool is_border_between(const BasicSystem<S>& system, const double* before, const double* after) {
  const auto& functions = system.switching_functions();
  for (std::size_t f = 0; f < functions.size(); ++f)
    if (functions[f].is_crossing(before[f], after[f])) return true;
  return false;
}

/// Appends the crossings between the values of the switching functions `before` and `after`. The latter are those of `state`, where forces and the
/// laws' states are already the new ones. Borders of one name that are crossed together are one event. Beyond kMostCrossings nothing is kept.
template <class S>
void record_crossings(const BasicSystem<S>& system, const BasicState<S>& state, const double* before, const double* after, std::vector<LawCrossing>& crossings) {
  constexpr std::size_t kMostCrossings = 100000;  // crossings of borders that are kept for events.csv
  for (std::size_t f = 0; f < system.switching_functions().size(); ++f) {
    const SwitchingFunction& function = system.switching_functions()[f];
    if (!function.is_reported || !function.is_event(before[f], after[f]) || crossings.size() >= kMostCrossings) continue;
    const BasicLaw<S>& law = system.joints[static_cast<std::size_t>(function.index)].law;
    const auto name = [&](int border, bool rising) { return law.parts()[static_cast<std::size_t>(function.part)]->border_name(border, rising); };
    if (name(function.border, after[f] > 0).empty()) continue;
    if (!crossings.empty()) {
      const LawCrossing& last = crossings.back();
      if (last.t == state.t && last.joint == function.index && last.part == function.part && name(last.border, last.rising) == name(function.border, after[f] > 0)) continue;
    }
    LawCrossing& crossing = (crossings.push_back({state.t, function.index, function.part, function.border, after[f] > 0, {}}), crossings.back());
    law.observe(law_point(system, function.index, state), state.force[static_cast<std::size_t>(function.index)], crossing.seen);
  }
}

}  // namespace pintle

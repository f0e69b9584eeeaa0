// What the search for a slow motion of free bodies has in common with that over a tree. theory/assembly section 4.
#pragma once

#include <limits>

namespace pintle {

inline constexpr int kSweeps = 5;            // over the joints, at most
inline constexpr double kConverged = 1e-10;  // relative change of the gaps below which sweeps end
inline constexpr double kDiverged = std::numeric_limits<double>::infinity();
inline constexpr double kSettled = 0.1;      // relative change of the gaps in the last sweep that is taken for convergence
inline constexpr int kSpans = 4;             // times over which the slow motion is looked for, each a quarter of the one before

/// A step that a rough integration by `Method` takes, once it is under way: the gaps are smooth over about that time. 0: it takes none.
template <class Method, class System, class State>
double natural_step(const System& system, const State& start, double duration) {
  constexpr double kScoutTolerance = 1e-3;  // of the rough integration
  constexpr int kScoutSteps = 3;            // of it: the last one counts
  Method scout(system, kScoutTolerance);
  scout.start(start, 1e-3 * duration);
  for (int i = 0; i < kScoutSteps; ++i)
    if (!scout.step(duration)) return 0;
  return scout.state().t - scout.previous().t;
}

}  // namespace pintle

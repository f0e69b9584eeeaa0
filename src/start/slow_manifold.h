// The slow manifold from a given start: the gaps required by the motion over a short interval, free of ringing, by
// fixed-point iteration on polynomials. theory/assembly Eqs. (4.1)-(4.4), and section 5 for soft joints.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "dynamics/time_scales.h"
#include "system/state.h"

namespace pintle {

// Shared by starts of free bodies and starts over a tree.
inline constexpr int kSweeps = 5;            // upper limit on sweeps over the joints
inline constexpr double kConverged = 1e-10;  // relative change of the gaps below which sweeps end
inline constexpr double kDiverged = std::numeric_limits<double>::infinity();
inline constexpr double kSettledSweep = 0.1;  // sweeps count as converged if the last one changes the gaps by less than this, relatively
inline constexpr int kSpans = 4;             // number of intervals over which the slow motion is looked for, each a quarter of the previous one

/// Sweeps over the joints of `motion` as long as each sweep at least halves the change. motion.write_start moves a state to the gaps of a sweep and
/// returns false if it is not a valid start. The state becomes the last one written, after the second sweep or later. Returns the relative change of
/// the gaps in that sweep: 0 where the joints carry nothing; kDiverged, with the state unchanged, where no state was written.
template <class Motion, class State>
double sweep_onto(Motion& motion, State& state) {
  double last = kDiverged;
  std::optional<State> best;
  for (int sweep = 0; sweep < kSweeps && last > kConverged; ++sweep) {
    const double change = motion.sweep();
    if (change == 0 && sweep == 0) return 0;
    if (sweep > 0) {
      State next = state;
      if (!(change < 0.5 * last) || !motion.write_start(next)) break;
      best = std::move(next);
    }
    last = change;
  }
  if (!best) return kDiverged;
  state = std::move(*best);
  return last;
}

/// The step that a rough integration by `Method` takes once it is under way: the gaps are smooth over about that time. 0 if a step fails.
template <class Method, class System, class State>
double natural_step(const System& system, const State& start, double duration) {
  constexpr double kScoutTolerance = 1e-3;  // tolerance of the rough integration
  constexpr int kScoutSteps = 3;            // its steps: the last one counts
  Method scout(system, kScoutTolerance);
  scout.start(start, 1e-3 * duration);
  for (int i = 0; i < kScoutSteps; ++i)
    if (!scout.step(duration)) return 0;
  return scout.state().t - scout.previous().t;
}

/// An interval of time, at most `longest`, that is short compared with the motion with closed joints: a quarter of an interval
/// over which a polynomial follows its forces. It does not depend on the joints' stiffness. 0 if there is none.
template <class S>
double span_of_motion(const BasicSystem<S>& system, const BasicState<S>& state, double longest);

/// The largest couple of any joint, the counterpart of largest_force [N*m].
template <class S>
double largest_couple(const VecsOf<S>& force) {
  double largest = 0;
  for (const typename S::Vec& f : force) largest = std::max(largest, f.template tail<S::kDof - S::kDim>().norm());
  return largest;
}

template <class S>
struct BasicSoftStart {
  bool placed = false;    // false: the state is unchanged
  double change = kDiverged;  // relative change of the gaps in the last sweep
  VecsOf<S> share;             // per component: how far it follows the motion, from 1, entirely (all fast ones), to 0, not at all
};
using SoftStart = BasicSoftStart<Planar>;

/// Moves soft joints to where the motion would take them if it were slow compared with them: to gaps that carry the
/// forces, with the matching rates as far as these make sense. `span` is only the interval over which derivatives are
/// taken.
template <class S>
BasicSoftStart<S> place_soft_joints(const BasicSystem<S>& system, const BasicTimeScales<S>& time_scales, double span, BasicState<S>& state);

/// Given positions, velocities and forces of `start_forces`, finds gap rates and accelerations of the fast joints at the
/// start by following the motion over `span` seconds, and moves the state onto them. Soft joints follow their own dynamics
/// from where the state has them. Returns the last relative change of the gaps; a large number, with the state unchanged,
/// when the iteration does not contract (a kink, a long span).
template <class S>
double move_onto_slow_manifold(const BasicSystem<S>& system, const BasicTimeScales<S>& time_scales, double span, BasicState<S>& state);

}  // namespace pintle

// The passes of a run: integrate with a tolerance, compare the joint forces of the last two passes, and tighten until their difference shows
// that the tolerance is met. theory/time section 6.
#pragma once

#include <functional>
#include <memory>

#include "base/stopwatch.h"
#include "run/nominal_run.h"

namespace pintle {

/// What the passes of a run need besides the mechanism, its start and the settings.
template <class S>
struct BasicPassContext {
  std::function<std::unique_ptr<BasicForceRecorder<S>>()> make_recorder;  // one recorder for each pass
  BasicRunShape<S> shape;
  const Observer& observer;
  Stopwatch clock;  // since the run began
  const VecsOf<S>* effective_mass = nullptr;  // of the joints, found at the start [kg], [kg*m^2]
};

/// Integrates the motion of `system` from `start` until the stated errors of the joint forces (or of the motion) meet the settings' tolerance, or
/// no tolerance can. Fills in all of `out` except the time taken, and adds to its notes. Returns the recorder of the reported pass.
/// Throws std::invalid_argument if the space has no such method.
template <class S>
std::unique_ptr<BasicForceRecorder<S>> run_passes(const BasicSystem<S>& system, const BasicState<S>& start, const SimulateSettings& settings, const BasicPassContext<S>& context, Trajectory& out);

}  // namespace pintle

// Joint forces inside a step, at all instants of ForceSamples at once: positions and velocities from the curves through the
// nodes, velocities moved onto the gaps' rates, forces balanced with the gaps' accelerations. theory/time section 5.
#pragma once

#include <array>
#include <memory>

#include "integrators/dense/force_samples.h"
#include "integrators/radau/step_nodes.h"
#include "system/state.h"

namespace pintle {

class DenseForces {
 public:
  using Sampled = std::array<Vecs, ForceSamples::kAll>;  // one entry per joint

  virtual ~DenseForces() = default;
  /// Of the step from `begin` to `end`; both ends of `sampled` are theirs.
  virtual void find(const State& begin, const State& end, const StepNodes& nodes, Sampled& sampled) = 0;
};

/// With the widest registers that the processor has; `system` must outlive it.
std::unique_ptr<DenseForces> make_dense_forces(const System& system);

}  // namespace pintle

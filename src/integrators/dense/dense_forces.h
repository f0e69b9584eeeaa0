// Joint forces inside a step, at all instants of ForceSamples at once: positions and velocities from the curves through the
// nodes, velocities projected onto the gaps' rates, forces balanced with the gaps' accelerations. theory/time section 5.
#pragma once

#include <array>
#include <memory>

#include "integrators/dense/force_samples.h"
#include "integrators/radau/step_nodes.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicDenseForces {
 public:
  using Sampled = std::array<VecsOf<S>, ForceSamples::kAll>;  // one entry per joint

  virtual ~BasicDenseForces() = default;
  /// For the step from `begin` to `end`; the ends of `sampled` are the forces there.
  virtual void find(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes, Sampled& sampled) = 0;
};
using DenseForces = BasicDenseForces<Planar>;

/// With the widest registers that the processor has; `system` must outlive it.
template <class S>
std::unique_ptr<BasicDenseForces<S>> make_dense_forces(const BasicSystem<S>& system);

}  // namespace pintle

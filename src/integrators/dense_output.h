// The state at any time inside the last step, with joint forces as accurate as those at its ends: curves through the
// accelerations of bodies and gaps (at the method's nodes, or quintic Hermite ones through both ends), then the forces
// that go with them.
// theory/time section 5.
#pragma once

#include "integrators/gap_projector.h"
#include "integrators/step_nodes.h"
#include "system/state.h"

namespace pintle {

class DenseOutput {
 public:
  explicit DenseOutput(const System& system);

  /// The state at time t between `begin` and `end`; mu > 0 is the frequency that separates resolved joint vibration from
  /// what the step has averaged (the method's eigenvalue over the step).
  const State& at(double t, const State& begin, const State& end, double mu);
  /// The same with the accelerations and powers at the nodes of the step.
  const State& at(double t, const State& begin, const State& end, double mu, const StepNodes& nodes);

 private:
  void find_forces(double mu);

  const System& system_;
  GapProjector projector_;
  State out_;
  std::vector<Planar::Motion> m_;
  Vecs wanted_, move_, Q_;
};

}  // namespace pintle

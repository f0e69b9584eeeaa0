// The state at any time inside the last step, with joint forces as accurate as those at its ends: quintic Hermite curves
// through positions, velocities and accelerations (of bodies and gaps), then the forces that go with them.
// theory/time section 5.
#pragma once

#include "integrators/gap_projector.h"
#include "system/state.h"

namespace pintle {

class DenseOutput {
 public:
  explicit DenseOutput(const System& system);

  /// The state at time t between `begin` and `end`; mu > 0 is the frequency that separates resolved joint vibration from
  /// what the step has averaged (the method's eigenvalue over the step).
  const State& at(double t, const State& begin, const State& end, double mu);

 private:
  const System& system_;
  GapProjector projector_;
  State out_;
  std::vector<Planar::Motion> m_;
  Vecs wanted_, move_, Q_;
};

}  // namespace pintle

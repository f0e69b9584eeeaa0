// The state at any time inside the last step, with joint forces as accurate as those at its ends: curves through what the
// implicit method knows at its nodes, or quintic Hermite ones through both ends and the forces that go with them.
// theory/time section 5.
#pragma once

#include <array>
#include <vector>

#include "integrators/gap_projector.h"
#include "integrators/step_nodes.h"
#include "system/state.h"

namespace pintle {

class DenseOutput {
 public:
  explicit DenseOutput(const System& system);

  /// The state at time t between `begin` and `end`; mu > 0 is the frequency that separates resolved joint vibration from
  /// what the step has averaged.
  const State& at(double t, const State& begin, const State& end, double mu);
  /// The same with what the step knows at its nodes.
  const State& at(double t, const State& begin, const State& end, const StepNodes& nodes);

 private:
  using Coefficients = std::array<Planar::Vec, RadauTable::kMaxNodes>;  // of powers of the share of the step
  struct Curve {
    Coefficients c;              // of the acceleration
    Planar::Vec bend_q, bend_v;  // what its integrals miss the far end by
  };
  void find_forces(double mu);
  void find_curves(const State& begin, const State& end, const StepNodes& nodes);

  const System& system_;
  GapProjector projector_;
  State out_;
  std::vector<Planar::Motion> m_;
  Vecs wanted_, move_, Q_;
  // The last step's curves, found when they are first asked for.
  double curves_from_ = 0, curves_to_ = 0;
  int n_ = 0;  // coefficients
  std::vector<Curve> body_, gap_;
  std::vector<Coefficients> force_;
  std::array<std::array<double, 2>, RadauTable::kMaxNodes> power_{};  // supplied, lost
  std::array<double, 2> bend_work_{};
};

}  // namespace pintle

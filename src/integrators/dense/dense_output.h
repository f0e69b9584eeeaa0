// The state at any time inside the last step, with joint forces as accurate as those at its ends: curves through the
// implicit method's data at its nodes, or quintic Hermite curves through both ends and the corresponding forces.
// theory/time section 5.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "integrators/dense/curve_weights.h"
#include "integrators/dense/dense_forces.h"
#include "integrators/radau/step_nodes.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicDenseOutput {
 public:
  explicit BasicDenseOutput(const BasicSystem<S>& system);

  /// The state at time t between `begin` and `end`, of a method that resolves every vibration.
  const BasicState<S>& at(double t, const BasicState<S>& begin, const BasicState<S>& end);
  /// The same from an implicit step's data at its nodes.
  const BasicState<S>& at(double t, const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes);

 private:
  static constexpr int kMost = CurveWeights::kMost;                 // coefficients, at most
  using Coefficients = std::array<typename S::Vec, kMost>;          // of powers of the share of the step
  struct Curve {
    Coefficients c;              // of the acceleration
    typename S::Vec bend_q, bend_v;  // what its integrals miss at the far end
  };
  void make_room();
  void find_curves(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes);
  void find_forces(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes);
  void follow(double t, const BasicState<S>& begin, const BasicState<S>& end);
  void follow_states(double x, const BasicStepNodes<S>& nodes);

  const BasicSystem<S>& system_;
  std::unique_ptr<BasicDenseForces<S>> dense_forces_;  // made together with the storage for curves
  typename BasicDenseForces<S>::Sampled sampled_;
  BasicState<S> out_;
  std::vector<std::size_t> slipping_;  // joints with a slip
  // The last step's curves, found when first needed.
  double curves_from_ = 0, curves_to_ = 0;
  int n_ = 0, n_force_ = 0;  // coefficients of accelerations, of forces
  std::vector<Curve> body_, gap_;  // in curved spaces `body_` gives velocities and accelerations only
  std::vector<Coefficients> increment_;  // of the rates of increments there, and what their integrals miss at the far end
  VecsOf<S> increment_bend_;
  std::vector<Coefficients> force_;
  std::array<std::array<double, 2>, kMost> power_{};  // supplied, lost
  std::array<double, 2> bend_work_{};
};
using DenseOutput = BasicDenseOutput<Planar>;

}  // namespace pintle

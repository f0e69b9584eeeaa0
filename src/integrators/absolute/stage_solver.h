// The stage equations of one implicit step. theory/time Eqs. (3.5)-(3.11).
#pragma once

#include <memory>
#include <vector>

#include "integrators/load_scale.h"
#include "integrators/radau/predictor.h"
#include "integrators/radau/radau_table.h"
#include "integrators/radau/step_nodes.h"
#include "pintle/trajectory.h"
#include "linalg/block.h"
#include "simd/lanes.h"
#include "system/state.h"

namespace pintle {

/// One stage of a step: positions, motions and forces. Where only springs and dampers act, stages before the last one have
/// accelerations and joint forces only.
template <class S>
struct BasicStage {
  PositionsOf<S> q;                           // bodies
  VecsOf<S> v, a, Q;
  VecsOf<S> gap, gap_rate, gap_accel, force;       // joints
  std::vector<double> law_state, law_rate;    // of the laws' own states
  std::vector<typename S::Motion> m;
  double loss = 0;                            // power lost in the springs and dampers that are joints [W]
  VecsOf<S> increment_rate{};                 // in curved spaces: rates of the bodies' increments from the start of the step
};
using Stage = BasicStage<Planar>;

/// Four numbers side by side for each coordinate of a body, or component of a gap.
template <class S>
using RowOf4 = BlockVec<Lanes<4>, S::kDof>;

/// The last three Legendre coefficients of the bodies' accelerations and of the gaps' own, the last one first; the fourth number is
/// free for the reader. Those of the bodies include the start of the step; those of the gaps do not, since their error there is
/// that of the last step.
template <class S>
struct BasicStageTails {
  std::vector<RowOf4<S>> bodies, gaps;
  std::vector<RowOf4<S>> of_states{};  // those of the forces of laws with states of their own, including the start of the step, by joint
};
using StageTails = BasicStageTails<Planar>;

template <class S>
class BasicStageSolver {
 public:

  virtual ~BasicStageSolver() = default;

  /// Solves the step of h from `begin`, predicted from `before`, the previous step of last_h, if there is one. False
  /// when the iteration fails.
  virtual bool solve(const BasicState<S>& begin, double h, const BasicStepNodes<S>* before, double last_h, const BasicLoadScale<S>& scale, Counters& counters) = 0;
  /// Writes the solution from `begin`: one entry per stage, and the tails.
  virtual void write(const BasicState<S>& begin, std::vector<BasicStage<S>>& stages, BasicStageTails<S>& tails) const = 0;
  /// Ratio by which the last iterations reduced the error of the stages; 0: there was only one iteration.
  virtual double contraction() const = 0;
  /// The residual of joint j's equation at the end of the step [m/s^2 or rad/s^2].
  virtual double residual(int j) const = 0;
  /// Turns four sets of body forces, side by side, into the accelerations that they cause within the step: mu^2
  /// Z(mu)^-1 of theory/time Eq. (3.8) with the real mu. A mode of frequency w responds by mu^2 / (mu^2 + w^2).
  virtual void filter_accelerations(std::vector<RowOf4<S>>& forces) const = 0;
};

/// The solver with the stages of `table`.
template <class S>
std::unique_ptr<BasicStageSolver<S>> make_stage_solver(const BasicSystem<S>& system, const RadauTable& table, double tolerance, Steps steps = Steps::kAccurate);

}  // namespace pintle

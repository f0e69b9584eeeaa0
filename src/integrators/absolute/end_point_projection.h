// The end of an implicit step: positions and velocities are moved onto the gaps that the joints carry, and forces are balanced
// with them. theory/time section 4. GapProjector performs the same operations one by one; here each pass through the joints
// combines as many as it can.
#pragma once

#include <memory>
#include <vector>

#include "integrators/absolute/stage_solver.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicEndPointProjection {
 public:
  virtual ~BasicEndPointProjection() = default;

  /// Factorises mu^2 M + G' (K + mu C) G at the last stage, which ends at t, and solves for its gaps: for their tails, and for their
  /// difference from the gaps of the bodies' poses. False when singular.
  virtual bool prepare(double t, double mu, const BasicStage<S>& last, BasicStageTails<S>& tails) = 0;
  /// By body: accelerations that correct the gaps' tails [m/s^2, m/s^2, rad/s^2], and in fourth place the displacement that closes the
  /// gaps [m, m, rad].
  virtual const std::vector<RowOf4<S>>& corrections() const = 0;
  /// The size of the tails of the bodies' forces, and of the forces that the gaps' own tails require, over the load scale. Eqs.
  /// (3.12), (3.13).
  virtual double error(const BasicStageTails<S>& tails, const BasicLoadScale<S>& scale) const = 0;
  /// Fills `end` from the last stage of a step of h: moved onto its gaps; the gaps and their rates as carried, but from the geometry
  /// where no motion could bring them there (redundant joints); forces balanced. Eqs. (4.1)-(4.4). m: motions at the end. Raises the
  /// scale to the loads there.
  virtual void finish(const BasicStage<S>& last, double h, BasicState<S>& end, std::vector<typename S::Motion>& m, BasicLoadScale<S>& scale) = 0;
};
using EndPointProjection = BasicEndPointProjection<Planar>;

template <class S>
std::unique_ptr<BasicEndPointProjection<S>> make_end_point_projection(const BasicSystem<S>& system);

}  // namespace pintle

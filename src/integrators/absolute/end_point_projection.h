// The end of an implicit step: positions and velocities are moved onto the gaps that the joints carry, and forces balanced with
// them. theory/time section 4. GapProjector answers the same questions one by one; here each pass through the joints asks all that
// it can.
#pragma once

#include <memory>
#include <vector>

#include "integrators/absolute/stage_solver.h"
#include "system/state.h"

namespace pintle {

class EndPointProjection {
 public:
  virtual ~EndPointProjection() = default;

  /// Factorises mu^2 M + G' (K + mu C) G at the last stage, which ends at t, and answers what its gaps demand: their tails, and what
  /// they differ from those of the bodies' poses. False when singular.
  virtual bool prepare(double t, double mu, const Stage& last, StageTails& tails) = 0;
  /// By body: accelerations that correct the gaps' tails [m/s^2, m/s^2, rad/s^2], and in the fourth place the displacement that closes
  /// the gaps [m, m, rad].
  virtual const std::vector<Vec3x4>& corrections() const = 0;
  /// The size of the tails of the bodies' forces, and of what the gaps' own demand of them, over the load scale. Eqs. (3.12), (3.13).
  virtual double error(const StageTails& tails, const LoadScale& scale) const = 0;
  /// Fills `end` from the last stage of a step of h: moved onto its gaps, the gaps and their rates as carried but as the geometry has
  /// them where no motion could bring them there (redundant joints), forces balanced. Eqs. (4.1)-(4.4). m: motions at the end. The
  /// scale is raised to what acts there.
  virtual void finish(const Stage& last, double h, State& end, std::vector<Planar::Motion>& m, LoadScale& scale) = 0;
};

std::unique_ptr<EndPointProjection> make_end_point_projection(const System& system);

}  // namespace pintle

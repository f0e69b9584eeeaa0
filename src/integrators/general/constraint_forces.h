// Ideal joints for the methods of the alpha family: their forces are not functions of positions and velocities, but are found
// in the iteration of a step so that it ends on the constraints.
#pragma once

#include <string>

#include "system/state.h"

namespace pintle {

class ConstraintForces {
 public:
  virtual ~ConstraintForces() = default;

  /// Projects positions and velocities onto the constraints, then does the same as `complete`.
  virtual bool start(State& state) = 0;
  /// Fills in everything of `state` except t, q and v. Returns false if this fails.
  virtual bool complete(State& state) = 0;
  /// Call before the iteration of a step from `begin`, in which an acceleration moves its body by `reach` times the acceleration [s^2].
  virtual void begin_step(const State& begin, double reach) = 0;
  /// All forces on the bodies at an iterate.
  virtual void find_forces(double t, const Vecs& q, const Vecs& v, Vecs& F) = 0;
  /// For every joint, at the last iterate: the force, and the stiffness against a gap. Zero for joints that are not ideal.
  virtual const Vecs& force() const = 0;
  virtual const Vecs& stiffness() const = 0;
  /// Whether steps end on the constraints, with velocities and accelerations projected by `project` after the iteration.
  virtual bool projects() const { return true; }
  virtual bool project(double t, const Vecs& q, Vecs& v, Vecs& a) = 0;
  /// For the notes of the run.
  virtual std::string remark() const = 0;
};

}  // namespace pintle

// Ideal joints as the methods of the alpha family see them: their forces are no laws of positions and velocities, but found in
// the iteration of a step so that it ends on the constraints.
#pragma once

#include <string>

#include "system/state.h"

namespace pintle {

class ConstraintForces {
 public:
  virtual ~ConstraintForces() = default;

  /// Moves positions and velocities onto the constraints; then as `complete`.
  virtual bool start(State& state) = 0;
  /// Fills in everything of `state` but t, q and v. False when that cannot be found.
  virtual bool complete(State& state) = 0;
  /// Before the iteration of a step from `begin`, in which an acceleration moves its body by `reach` times itself [s^2].
  virtual void begin_step(const State& begin, double reach) = 0;
  /// All forces on the bodies at an iterate.
  virtual void find_forces(double t, const Vecs& q, const Vecs& v, Vecs& F) = 0;
  /// Of every joint, at the last iterate: the force, and what opposes a gap. Joints that are not ideal have none.
  virtual const Vecs& force() const = 0;
  virtual const Vecs& stiffness() const = 0;
  /// Whether steps end on the constraints, by `project` after the iteration: velocities and accelerations onto them.
  virtual bool projects() const { return true; }
  virtual bool project(double t, const Vecs& q, Vecs& v, Vecs& a) = 0;
  /// For the notes of the run.
  virtual std::string remark() const = 0;
};

}  // namespace pintle

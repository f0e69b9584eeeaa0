// Ideal joints by an augmented Lagrangian: in each iteration of a step the multipliers take over what the penalties carry, and
// velocities and accelerations are projected afterwards. theory/penalty section 2.
#pragma once

#include <string>

#include "integrators/general/constraint_forces.h"
#include "integrators/ideal/ideal_equations.h"

namespace pintle {

class AugmentedLagrangian final : public ConstraintForces {
 public:
  /// `factor`: of the penalties in the iteration, over what resists them in a step. The result does not depend on it.
  explicit AugmentedLagrangian(const System& system, double factor = 1e7);

  bool start(State& state) override;
  bool complete(State& state) override { return equations_.complete(state); }
  void begin_step(const State& begin, double reach) override;
  void find_forces(double t, const Vecs& q, const Vecs& v, Vecs& F) override;
  /// Those that the iteration of the last step has found, which are not the joint forces that go with projected accelerations: section 3.
  const Vecs& force() const override { return multipliers_; }
  const Vecs& stiffness() const override { return stiffness_; }
  bool project(double t, const Vecs& q, Vecs& v, Vecs& a) override;
  std::string remark() const override { return equations_.violation_text("augmented Lagrangian"); }

 private:
  void take_over();

  const System& system_;
  double factor_;
  IdealEquations equations_;
  Vecs multipliers_, stiffness_;  // of joints; what is not kept is zero
  bool begins_ = true;            // no iterate has been looked at
  State iterate_;
};

}  // namespace pintle

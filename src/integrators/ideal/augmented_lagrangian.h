// Ideal joints by an augmented Lagrangian: in each iteration of a step the multipliers take over the penalty forces;
// velocities and accelerations are projected afterwards. theory/penalty section 2.
#pragma once

#include <string>

#include "integrators/general/constraint_forces.h"
#include "integrators/ideal/ideal_equations.h"

namespace pintle {

class AugmentedLagrangian final : public ConstraintForces {
 public:
  /// `factor`: ratio of the penalties in the iteration to the inertia that resists them in a step. The result does not depend on it.
  explicit AugmentedLagrangian(const System& system, double factor = 1e7);

  bool start(State& state) override;
  bool complete(State& state) override { return equations_.complete(state); }
  void begin_step(const State& begin, double reach) override;
  void find_forces(double t, const Vecs& q, const Vecs& v, Vecs& F) override;
  /// The multipliers found by the iteration of the last step. They are not the joint forces that go with projected accelerations: section 3.
  const Vecs& force() const override { return multipliers_; }
  const Vecs& stiffness() const override { return stiffness_; }
  bool project(double t, const Vecs& q, Vecs& v, Vecs& a) override;
  std::string remark() const override { return equations_.violation_text("augmented Lagrangian"); }

 private:
  void take_over();

  const System& system_;
  double factor_;
  IdealEquations equations_;
  Vecs multipliers_, stiffness_;  // per joint; zero for unconstrained components
  bool begins_ = true;            // no iterate yet in this step
  State iterate_;
};

}  // namespace pintle

// Ideal joints by penalties for the methods of the alpha family, which then iterate on the accelerations as the penalties' authors
// do. theory/penalty section 1.
#pragma once

#include <string>

#include "integrators/general/constraint_forces.h"
#include "integrators/ideal/ideal_equations.h"

namespace pintle {

class PenaltyForces final : public ConstraintForces {
 public:
  PenaltyForces(const System& system, const PenaltySettings& penalty);

  bool start(State& state) override { return close_loops(system_, state) && equations_.complete(state); }
  bool complete(State& state) override { return equations_.complete(state); }
  void begin_step(const State&, double) override {}
  void find_forces(double t, const Vecs& q, const Vecs& v, Vecs& F) override;
  const Vecs& force() const override { return none_; }
  const Vecs& stiffness() const override { return none_; }
  bool projects() const override { return false; }
  bool project(double t, const Vecs& q, Vecs& v, Vecs& a) override;
  std::string remark() const override { return equations_.violation_text("penalties"); }

 private:
  const System& system_;
  IdealEquations equations_;
  Vecs none_;  // penalties are soft compared with the inertia of a step, so they need no tangents
  State iterate_;
};

}  // namespace pintle

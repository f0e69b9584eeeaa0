#include "integrators/ideal/augmented_lagrangian.h"

#include "integrators/force_evaluator.h"

namespace pintle {
namespace {

using S = Planar;

}  // namespace

AugmentedLagrangian::AugmentedLagrangian(const System& system, double factor)
    : system_(system), factor_(factor), equations_(system, Equations::kAugmentedLagrangian), multipliers_(system.joints.size(), S::Vec::Zero()), stiffness_(multipliers_),
      iterate_(zero_state(system)) {}

bool AugmentedLagrangian::start(State& state) { return close_loops(system_, state) && equations_.complete(state); }

// theory/penalty Eq. (2.5).
void AugmentedLagrangian::begin_step(const State& begin, double reach) {
  const auto& rows = equations_.rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [joint, k] = rows[i];
    multipliers_[joint][k] = begin.force[joint][k];
    stiffness_[joint][k] = factor_ * equations_.resisting_mass(i) / reach;
  }
  begins_ = true;
}

// theory/penalty Eqs. (2.3), (2.4).
void AugmentedLagrangian::take_over() {
  if (!begins_)
    for (const auto [joint, k] : equations_.rows()) multipliers_[joint][k] -= stiffness_[joint][k] * equations_.gap(joint)[k];
  begins_ = false;
}

// theory/penalty Eq. (2.1).
void AugmentedLagrangian::find_forces(double t, const Vecs& q, const Vecs& v, Vecs& F) {
  iterate_.t = t;
  iterate_.q = q;
  iterate_.v = v;
  equations_.find_applied_forces(iterate_);
  take_over();
  F = iterate_.a;
  for (const auto [joint, k] : equations_.rows()) iterate_.force[joint][k] = multipliers_[joint][k] - stiffness_[joint][k] * equations_.gap(joint)[k];
  equations_.add_constraint_forces(iterate_.force, F);
}

bool AugmentedLagrangian::project(double t, const Vecs& q, Vecs& v, Vecs& a) {
  equations_.look_at(t, q, v);
  equations_.measure_violation();
  take_over();
  return equations_.close_velocities(t, q, v) && equations_.close_accelerations(t, q, v, a);
}

}  // namespace pintle

#include "run/errors/ringing_loss.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "dynamics/inverse_dynamics.h"
#include "dynamics/time_scales.h"
#include "integrators/unresolved_ringing.h"
#include "laws/law.h"
#include "run/record/force_table.h"

namespace pintle {

template <class S>
BasicRingingLoss<S>::BasicRingingLoss(const BasicSystem<S>& system, const BasicState<S>& start, const VecsOf<S>* effective_mass)
    : system_(&system), start_(&start), known_mass_(effective_mass) {
  reset();
}

template <class S>
void BasicRingingLoss<S>::reset() {
  lost_.assign(system_->joints.size(), S::Vec::Zero());
  most_lost_ = lost_;
  n_steps_ = 0;
}

template <class S>
void BasicRingingLoss<S>::find_masses() {
  mass_ = damping_ = stiffness_ = decay_ = VecsOf<S>(lost_.size(), S::Vec::Zero());
  const VecsOf<S> closed = known_mass_ == nullptr || known_mass_->empty() ? BasicInverseDynamics<S>(*system_).effective_masses(*start_).closed : *known_mass_;
  for (std::size_t j = 0; j < closed.size(); ++j) {
    const BasicResponse<S> response = respond(system_->joints[j].law, start_->gap[j], start_->gap_rate[j]);
    for (int k = 0; k < S::kDof; ++k) {
      const double m = closed[j][k];
      if (!(response.stiffness(k, k) > 0) || !(m > 0)) continue;
      mass_[j][k] = m;
      damping_[j][k] = response.damping(k, k);
      stiffness_[j][k] = response.stiffness(k, k);
      decay_[j][k] = own_rates(m, damping_[j][k], stiffness_[j][k]).decay;
    }
  }
}

// The acceleration of a gap is almost zero except for its ringing. If the curve through the stages misses the acceleration at the start of the step by J, the step
// has taken about J^2 / A off a ringing of amplitude A: the error at the end of a step goes with the square of the error of its curve.
template <class S>
void BasicRingingLoss<S>::see_step(const BasicStepNodes<S>& nodes, double h) {
  if (mass_.empty()) find_masses();
  ++n_steps_;
  const RadauTable& table = *nodes.table;
  for (std::size_t j = 0; j < lost_.size(); ++j)
    for (int k = 0; k < S::kDof; ++k) {
      if (mass_[j][k] == 0) continue;
      double missed = nodes.gap_accel[0][j][k], amplitude = std::abs(missed), last = 0;
      for (int s = 0; s < table.n; ++s) {
        const double x = nodes.gap_accel[s + 1][j][k];
        missed -= table.stages_to_powers(0, s) * x;
        last += table.stages_to_legendre(table.n - 1, s) * x;
        amplitude = std::max(amplitude, std::abs(x));
      }
      if (!(amplitude > 0)) continue;
      const double share = std::min(std::abs(missed) / amplitude, 1.0), missed_rate = h * last / (2 * table.n - 1);
      lost_[j][k] = std::exp(-decay_[j][k] * h) * (lost_[j][k] + share * share * std::max(mass_[j][k] * amplitude, ringing_force(mass_[j][k], damping_[j][k], stiffness_[j][k], missed_rate)));
    }
  for (std::size_t j = 0; j < lost_.size(); ++j) most_lost_[j] = most_lost_[j].cwiseMax(lost_[j]);
}

// The phases of the vibrations are unrelated, so their squares are added.
template <class S>
void BasicRingingLoss<S>::add_transmitted(double least_force, double least_couple) {
  if (mass_.empty() || system_->n_joints() > kMostJointsWithMasses) return;
  std::optional<BasicInverseDynamics<S>> dynamics;
  VecsOf<S> squares(lost_.size(), S::Vec::Zero());
  for (std::size_t j = 0; j < lost_.size(); ++j)
    for (int k = 0; k < S::kDof; ++k) {
      if (!(most_lost_[j][k] > (k < S::kDim ? least_force : least_couple))) continue;
      if (!dynamics && !dynamics.emplace(*system_).prepare_unit_gap_accelerations(*start_)) return;
      const double acceleration = most_lost_[j][k] / mass_[j][k];
      const VecsOf<S>& force = dynamics->forces_of_unit_gap_acceleration(static_cast<int>(j), k);
      for (std::size_t i = 0; i < lost_.size(); ++i)
        if (i != j) squares[i] += (acceleration * force[i]).cwiseAbs2();
    }
  for (std::size_t j = 0; j < lost_.size(); ++j) most_lost_[j] = (most_lost_[j].cwiseAbs2() + squares[j]).cwiseSqrt();
}

template class BasicRingingLoss<Planar>;
PINTLE_IN_SPACE(template class BasicRingingLoss<Spatial>;)

}  // namespace pintle

#include "system/state.h"

#include <algorithm>
#include <cmath>

namespace pintle {

template <class S>
void find_gap_accelerations(const BasicSystem<S>& system, const std::vector<BasicJointKinematics<S>>& r, BasicState<S>& state) {
  for (int j = 0; j < system.n_joints(); ++j) {
    state.gap_accel[j] = r[j].bias;
    add_gap(system.joints[j].at, r[j], state.a, state.gap_accel[j]);
  }
}

template <class S>
void find_joint_forces(const BasicSystem<S>& system, BasicState<S>& state) {
  for (int j = 0; j < system.n_joints(); ++j) state.force[j] = system.joints[j].law.force(law_point(system, j, state));
}

template <class S>
void find_law_rates(const BasicSystem<S>& system, BasicState<S>& state) {
  if (system.n_law_states() == 0) return;
  for (int j = 0; j < system.n_joints(); ++j)
    system.joints[j].law.state_rates(law_point(system, j, state), state.law_rate.data() + system.joints[j].first_state);
}

template <class S>
void rest_laws(const BasicSystem<S>& system, BasicState<S>& state) {
  state.law_state.assign(system.n_law_states(), 0.0);
  state.law_rate.assign(system.n_law_states(), 0.0);
  if (system.n_law_states() == 0) return;
  for (int j = 0; j < system.n_joints(); ++j)
    system.joints[j].law.rest(law_point(system, j, state), state.law_state.data() + system.joints[j].first_state);
  find_law_rates(system, state);
}

template <class S>
void find_accelerations(const BasicSystem<S>& system, const std::vector<typename S::Motion>& m, const std::vector<BasicJointKinematics<S>>& r, BasicState<S>& state) {
  system.external(state.t, m, state.a, state.sliding);
  for (int j = 0; j < system.n_joints(); ++j) add_force(system.joints[j].at, r[j], state.force[j], state.a);
  for (int i = 0; i < system.n_bodies(); ++i) state.a[i] = state.a[i].cwiseQuotient(system.bodies[i].mass);
  find_gap_accelerations(system, r, state);
}

template <class S>
double energy_of_joints(const BasicSystem<S>& system, const BasicState<S>& state) {
  double stored = 0;
  for (int j = 0; j < system.n_joints(); ++j)
    if (system.joints[j].servo < 0 && !system.joints[j].ideal) stored += system.joints[j].law.energy(law_point(system, j, state));
  return stored;
}

// The coordinates and vectors of a body begin with its translations.
template <class Vec>
constexpr int kTranslations = Vec::SizeAtCompileTime == Planar::kDof ? Planar::kDim : Spatial::kDim;

template <class Vec>
double largest_coordinate(const std::vector<Vec>& x) {
  double largest = 1e-3;
  for (const auto& xi : x)
    for (int k = 0; k < kTranslations<Vec>; ++k) largest = std::max(largest, std::abs(xi[k]));
  return largest;
}
template <>
double largest_coordinate(const PositionsOf<Spatial>& x) {
  double largest = 1e-3;
  for (const auto& xi : x) largest = std::max(largest, xi.p.cwiseAbs().maxCoeff());
  return largest;
}

template <class S>
double largest_angle(const PositionsOf<S>& q) {
  double largest = 1;
  if constexpr (S::kDof - S::kDim == 1)
    for (const auto& body : q) largest = std::max(largest, std::abs(body[S::kDim]));
  return largest;
}

template <class S>
double largest_stiffness(const BasicSystem<S>& system) {
  double stiffest = 0;
  for (const BasicJointData<S>& joint : system.joints) stiffest = std::max(stiffest, joint.law.engaged_stiffness().template head<S::kDim>().maxCoeff());
  return stiffest;
}

template <class Vec>
double largest_force(const std::vector<Vec>& force) {
  double largest = 0;
  for (const auto& f : force) largest = std::max(largest, f.template head<kTranslations<Vec>>().norm());
  return largest;
}

template <class S>
bool is_finite(const BasicState<S>& state) {
  const auto finite = [](const VecsOf<S>& x) { return std::all_of(x.begin(), x.end(), [](const typename S::Vec& y) { return y.allFinite(); }); };
  const bool positions = std::all_of(state.q.begin(), state.q.end(), [](const auto& q) { return S::is_finite(q); });
  const bool laws = std::all_of(state.law_state.begin(), state.law_state.end(), [](double z) { return std::isfinite(z); });
  return std::isfinite(state.t) && laws && positions && finite(state.v) && finite(state.a) && finite(state.gap) && finite(state.force);
}

template double largest_coordinate(const VecsOf<Planar>&);
PINTLE_IN_SPACE(template double largest_coordinate(const VecsOf<Spatial>&);)
template double largest_angle<Planar>(const PositionsOf<Planar>& q);
PINTLE_IN_SPACE(template double largest_angle<Spatial>(const PositionsOf<Spatial>& q);)
template double largest_stiffness(const BasicSystem<Planar>& system);
PINTLE_IN_SPACE(template double largest_stiffness(const BasicSystem<Spatial>& system);)
template double largest_force(const VecsOf<Planar>&);
PINTLE_IN_SPACE(template double largest_force(const VecsOf<Spatial>&);)
template void find_gap_accelerations(const BasicSystem<Planar>& system, const std::vector<BasicJointKinematics<Planar>>& r, BasicState<Planar>& state);
template double energy_of_joints(const BasicSystem<Planar>& system, const BasicState<Planar>& state);
template void find_joint_forces(const BasicSystem<Planar>& system, BasicState<Planar>& state);
PINTLE_IN_SPACE(template void find_joint_forces(const BasicSystem<Spatial>& system, BasicState<Spatial>& state);)
template void find_law_rates(const BasicSystem<Planar>& system, BasicState<Planar>& state);
template void rest_laws(const BasicSystem<Planar>& system, BasicState<Planar>& state);
template void find_accelerations(const BasicSystem<Planar>& system, const std::vector<Planar::Motion>& m, const std::vector<BasicJointKinematics<Planar>>& r, BasicState<Planar>& state);
template bool is_finite(const BasicState<Planar>& state);
PINTLE_IN_SPACE(template void find_gap_accelerations(const BasicSystem<Spatial>& system, const std::vector<BasicJointKinematics<Spatial>>& r, BasicState<Spatial>& state);)
PINTLE_IN_SPACE(template double energy_of_joints(const BasicSystem<Spatial>& system, const BasicState<Spatial>& state);)
PINTLE_IN_SPACE(template void find_law_rates(const BasicSystem<Spatial>& system, BasicState<Spatial>& state);)
PINTLE_IN_SPACE(template void rest_laws(const BasicSystem<Spatial>& system, BasicState<Spatial>& state);)
PINTLE_IN_SPACE(template void find_accelerations(const BasicSystem<Spatial>& system, const std::vector<Spatial::Motion>& m, const std::vector<BasicJointKinematics<Spatial>>& r, BasicState<Spatial>& state);)
PINTLE_IN_SPACE(template bool is_finite(const BasicState<Spatial>& state);)

}  // namespace pintle

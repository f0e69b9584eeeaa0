#include "integrators/load_scale.h"

#include "integrators/thresholds.h"

namespace pintle {

template <class S>
void grow_load_scale(const BasicSystem<S>& system, const std::vector<typename S::Motion>& m, const VecsOf<S>& Q, const BasicState<S>& state, BasicLoadScale<S>& scale, VecsOf<S>& load) {
  load.resize(system.bodies.size());
  for (std::size_t i = 0; i < load.size(); ++i) load[i] = Q[i].cwiseAbs() + system.bodies[i].mass.cwiseProduct(state.a[i]).cwiseAbs();
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicPlacement<S>& at = system.joints[j].at;
    typename S::Vec on_ground;
    const BasicJointKinematics<S> r = system.kinematics(j, state.t, m);
    const auto push = [&](const typename S::Vec& force) { r.map.push_magnitudes(force.data(), at.a != kGround ? load[at.a] : on_ground, at.b != kGround ? load[at.b] : on_ground); };
    // What the joint holds and what else acts in it are counted separately: on a light link, the couple of a pin's friction and the moment of the pin's
    // force cancel. So do friction and what it holds still, such as the pressure in a cylinder.
    const BasicLaw<S>& law = system.joints[j].law;
    if (!law.rubs()) {
      push(state.force[j]);
      continue;
    }
    const typename S::Vec& free = system.joints[j].free_mask;
    typename S::Vec rest = free.cwiseProduct(state.force[j]);
    push(state.force[j] - rest);
    if (law.n_states() > 0 && law.parts().size() > 1) {
      const typename S::Vec of_states = free.cwiseProduct(law.force_of_states(law_point(system, j, state)));
      push(of_states);
      rest -= of_states;
    }
    push(rest);
  }
  for (std::size_t i = 0; i < load.size(); ++i) raise_scale(system.bodies[i], load[i], scale.body[i]);
}

template <class S>
std::vector<double> loads_above_rounding(const BasicSystem<S>& system, const std::vector<int>& joints, const BasicState<S>& state, double tolerance) {
  const double size = largest_coordinate(state.q);
  std::vector<double> loads(system.bodies.size(), 0.0);
  for (const int j : joints) {
    const BasicJointData<S>& joint = system.joints[j];
    BasicLawTangents<S> law;
    joint.law.linearize(law_point(system, j, state), law);
    const double least = load_above_rounding(law.stiffness.diagonal().template head<S::kDim>().maxCoeff(), size, tolerance);
    for (const int body : {joint.at.a, joint.at.b})
      if (body != kGround) loads[body] = std::max(loads[body], least);
  }
  return loads;
}

template <class S>
typename S::Vec rounding_of_gaps(const PositionsOf<S>& q) {
  typename S::Vec rounding = S::Vec::Constant(kLastBits * largest_angle<S>(q));
  rounding.template head<S::kDim>() *= largest_coordinate(q);
  return rounding;
}

template <class S>
void find_rounding_of_joint_forces(const BasicSystem<S>& system, const PositionsOf<S>& q, VecsOf<S>& rounding) {
  const double far = largest_coordinate(q), turned = largest_angle<S>(q);
  rounding.assign(system.bodies.size(), S::Vec::Zero());
  for (const BasicJointData<S>& joint : system.joints) {
    const typename S::Vec stiffness = joint.law.engaged_stiffness();
    const double force = far * stiffness.template head<S::kDim>().maxCoeff(), moment = turned * stiffness.template tail<S::kDof - S::kDim>().maxCoeff() + far * force;
    for (const int body : {joint.at.a, joint.at.b}) {
      if (body == kGround) continue;
      rounding[body].template head<S::kDim>().array() += kLastBits * force;
      rounding[body].template tail<S::kDof - S::kDim>().array() += kLastBits * moment;
    }
  }
}

template std::vector<double> loads_above_rounding(const BasicSystem<Planar>& system, const std::vector<int>& joints, const BasicState<Planar>& state, double tolerance);
PINTLE_IN_SPACE(template std::vector<double> loads_above_rounding(const BasicSystem<Spatial>& system, const std::vector<int>& joints, const BasicState<Spatial>& state, double tolerance);)
template Planar::Vec rounding_of_gaps<Planar>(const PositionsOf<Planar>& q);
PINTLE_IN_SPACE(template Spatial::Vec rounding_of_gaps<Spatial>(const PositionsOf<Spatial>& q);)
template void find_rounding_of_joint_forces(const BasicSystem<Planar>& system, const PositionsOf<Planar>& q, VecsOf<Planar>& rounding);
PINTLE_IN_SPACE(template void find_rounding_of_joint_forces(const BasicSystem<Spatial>& system, const PositionsOf<Spatial>& q, VecsOf<Spatial>& rounding);)
template void grow_load_scale(const BasicSystem<Planar>& system, const std::vector<Planar::Motion>& m, const VecsOf<Planar>& Q, const BasicState<Planar>& state, BasicLoadScale<Planar>& scale, VecsOf<Planar>& load);
PINTLE_IN_SPACE(template void grow_load_scale(const BasicSystem<Spatial>& system, const std::vector<Spatial::Motion>& m, const VecsOf<Spatial>& Q, const BasicState<Spatial>& state, BasicLoadScale<Spatial>& scale, VecsOf<Spatial>& load);)

}  // namespace pintle

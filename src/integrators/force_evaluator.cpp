#include "integrators/force_evaluator.h"

namespace pintle {

template <class S>
void BasicForceEvaluator<S>::complete(BasicState<S>& state) {
  find_gaps(state);
  const ExternalWork work = system_.external_work(state.t, state.q, m_, state.sliding);
  state.supply_power = work.supplied;
  state.loss_power = work.lost;
  for (int j = 0; j < system_.n_joints(); ++j) {
    const BasicJointData<S>& joint = system_.joints[j];
    const BasicLawPoint<S> at = law_point(system_, j, state);
    state.force[j] = joint.law.force(at);
    state.supply_power += system_.drive_power(joint, state.t, m_, state.force[j]);
    if (joint.servo < 0) state.loss_power += joint.law.loss(at);
  }
  find_law_rates(system_, state);
  find_accelerations(system_, m_, r_, state);
}

template <class S>
void BasicForceEvaluator<S>::find_gaps(BasicState<S>& state) {
  system_.motions(state.q, state.v, m_);
  system_.joint_kinematics(state.t, m_, r_);
  for (int j = 0; j < system_.n_joints(); ++j) {
    state.gap[j] = r_[j].gap;
    state.gap_rate[j] = r_[j].rate;
  }
}

template <class S>
void BasicForceEvaluator<S>::find_roots(BasicState<S>& state, double* value) {
  find_gaps(state);
  system_.evaluate_switching_functions(state.t, m_, state.gap, state.gap_rate, state.law_state, state.sliding, value);
}

template <class S>
BasicState<S> zero_state(const BasicSystem<S>& system) {
  BasicState<S> state;
  state.q.assign(system.bodies.size(), S::at_origin());
  state.v = state.a = VecsOf<S>(system.bodies.size(), S::Vec::Zero());
  state.gap = state.gap_rate = state.gap_accel = state.force = VecsOf<S>(system.joints.size(), S::Vec::Zero());
  state.law_state.resize(system.n_law_states());
  state.law_rate.resize(system.n_law_states());
  return state;
}

template BasicState<Planar> zero_state(const BasicSystem<Planar>& system);
PINTLE_IN_SPACE(template BasicState<Spatial> zero_state(const BasicSystem<Spatial>& system);)

template class BasicForceEvaluator<Planar>;
PINTLE_IN_SPACE(template class BasicForceEvaluator<Spatial>;)

}  // namespace pintle

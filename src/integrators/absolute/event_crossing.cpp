// Free bodies and their joints inside a step, ahead of it and beyond its end, as its events need them. theory/time section 7.
#include <cmath>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/load_scale.h"
#include "integrators/radau/step_events.h"

namespace pintle {
namespace {

// Taylor's series to the second order.
Planar::Coordinates along(const Planar::Coordinates& q, double d, const Planar::Vec& v, double half, const Planar::Vec& a) { return q + d * v + half * a; }
[[maybe_unused]] Spatial::Coordinates along(const Spatial::Coordinates& q, double d, const Spatial::Vec& v, double half, const Spatial::Vec& a) {
  return Spatial::moved(q, d * v + half * a);
}

}  // namespace

template <class S>
void BasicRadauStepper<S>::evaluate_switching_functions(double x, double h, double* value) {
  const auto [v, q] = table_.stage_integrals(x);
  for (std::size_t b = 0; b < inside_q_.size(); ++b) {
    if constexpr (S::kCurved) {
      typename S::Vec dq = S::Vec::Zero();
      for (int i = 0; i < n_; ++i) dq += h * v[i] * stage_[i].increment_rate[b];
      inside_q_[b] = S::moved(begin_.q[b], dq);
    } else {
      inside_q_[b] = begin_.q[b] + x * h * begin_.v[b];
    }
    inside_v_[b] = begin_.v[b];
    for (int i = 0; i < n_; ++i) {
      if constexpr (!S::kCurved) inside_q_[b] += h * h * q[i] * stage_[i].a[b];
      inside_v_[b] += h * v[i] * stage_[i].a[b];
    }
  }
  for (std::size_t j = 0; j < inside_gap_.size(); ++j) {
    inside_gap_[j] = begin_.gap[j] + x * h * begin_.gap_rate[j];
    inside_rate_[j] = begin_.gap_rate[j];
    for (int i = 0; i < n_; ++i) {
      inside_gap_[j] += h * h * q[i] * stage_[i].gap_accel[j];
      inside_rate_[j] += h * v[i] * stage_[i].gap_accel[j];
    }
  }
  for (std::size_t z = 0; z < inside_law_state_.size(); ++z) {
    inside_law_state_[z] = begin_.law_state[z];
    for (int i = 0; i < n_; ++i) inside_law_state_[z] += h * v[i] * stage_[i].law_rate[z];
  }
  system_.motions(inside_q_, inside_v_, inside_m_);
  open_contacts_.follow_positions([this](int j) { return law_point(system_, j, begin_); }, [&](int j) { return system_.kinematics(j, begin_.t + x * h, inside_m_); },
                                  [this](int j) -> const typename S::Vec& { return inside_gap_[j]; }, largest_coordinate(inside_q_), [this](int j, const BasicJointKinematics<S>& r) {
                                    inside_gap_[j] = r.gap;
                                    inside_rate_[j] = r.rate;
                                  });
  system_.evaluate_switching_functions(begin_.t + x * h, inside_m_, inside_gap_, inside_rate_, inside_law_state_, begin_.sliding, value);
}

template <class S>
void BasicRadauStepper<S>::extrapolate_gaps(double d) {
  const double half = 0.5 * d * d;
  for (std::size_t j = 0; j < end_.gap.size(); ++j) {
    inside_gap_[j] = begin_.gap[j] + d * begin_.gap_rate[j] + half * begin_.gap_accel[j];
    inside_rate_[j] = begin_.gap_rate[j] + d * begin_.gap_accel[j];
  }
  for (std::size_t z = 0; z < inside_law_state_.size(); ++z) inside_law_state_[z] = begin_.law_state[z] + d * begin_.law_rate[z];
}

template <class S>
bool BasicRadauStepper<S>::forces_stay_constant(double d) {
  const double most = most_force_change(tolerance_);
  extrapolate_gaps(kShareBeforeEvent * d);
  for (int j = 0; j < system_.n_joints(); ++j) {
    const BasicJointData<S>& joint = system_.joints[j];
    const typename S::Vec load = load_on(joint.at, scale_), force = joint.law.force({begin_.t + kShareBeforeEvent * d, inside_gap_[j], inside_rate_[j], inside_law_state_.data() + joint.first_state});
    for (int k = 0; k < S::kDof; ++k)
      if (!(std::abs(force[k] - begin_.force[j][k]) <= most * load[k])) return false;
  }
  return loads_stay_constant(system_, begin_.t, kShareBeforeEvent * d, end_m_, begin_.sliding, most, scale_, load_change_, loads_then_);
}

template <class S>
void BasicRadauStepper<S>::extrapolate_switching_functions(double d, double* value) {
  const double half = 0.5 * d * d;
  for (std::size_t b = 0; b < end_.q.size(); ++b) {
    inside_q_[b] = along(begin_.q[b], d, begin_.v[b], half, begin_.a[b]);
    inside_v_[b] = begin_.v[b] + d * begin_.a[b];
  }
  extrapolate_gaps(d);
  system_.motions(inside_q_, inside_v_, inside_m_);
  system_.evaluate_switching_functions(begin_.t + d, inside_m_, inside_gap_, inside_rate_, inside_law_state_, begin_.sliding, value);
}

template <class S>
void BasicRadauStepper<S>::evaluate_switching_functions_at_end(double* value) const {
  system_.evaluate_switching_functions(end_.t, end_m_, end_.gap, end_.gap_rate, end_.law_state, end_.sliding, value);
}

// Change of the joints' loss power in a time d after the end: a contact whose force has vanished loses what it still stores.
template <class S>
double BasicRadauStepper<S>::change_in_loss_power(double d) const {
  if (end_.loss_power == 0) return 0;
  double change = 0;
  for (int j = 0; j < system_.n_joints(); ++j) {
    const BasicJointData<S>& joint = system_.joints[j];
    if (joint.servo >= 0) continue;
    const BasicLawPoint<S> now = law_point(system_, j, end_);
    const typename S::Vec gap = now.gap + d * now.rate + 0.5 * d * d * end_.gap_accel[j], rate = now.rate + d * end_.gap_accel[j];
    change += joint.law.loss({now.t + d, gap, rate, now.state}) - joint.law.loss(now);
  }
  return change;
}

template <class S>
void BasicRadauStepper<S>::extrapolate_end_state(double d) {
  const double half = 0.5 * d * d;
  end_.supplied += d * end_.supply_power;
  end_.dissipated += d * (end_.loss_power + 0.5 * change_in_loss_power(kShareBeforeEvent * d));
  end_.t += d;
  for (std::size_t b = 0; b < end_.q.size(); ++b) {
    end_.q[b] = along(end_.q[b], d, end_.v[b], half, end_.a[b]);
    end_.v[b] += d * end_.a[b];
  }
  for (std::size_t j = 0; j < end_.gap.size(); ++j) {
    end_.gap[j] += d * end_.gap_rate[j] + half * end_.gap_accel[j];
    end_.gap_rate[j] += d * end_.gap_accel[j];
  }
  for (std::size_t z = 0; z < end_.law_state.size(); ++z) end_.law_state[z] += d * end_.law_rate[z];
  system_.motions(end_.q, end_.v, end_m_);
}

template <class S>
const std::vector<typename S::Motion>& BasicRadauStepper<S>::motions_after(double d) {
  for (std::size_t b = 0; b < end_.q.size(); ++b) {
    inside_q_[b] = S::moved(end_.q[b], d * end_.v[b]);
    inside_v_[b] = end_.v[b] + d * end_.a[b];
  }
  system_.motions(inside_q_, inside_v_, inside_m_);
  return inside_m_;
}

template <class S>
bool BasicRadauStepper<S>::cross_borders() {
  return system_.cross_borders(end_.t, end_.gap, end_.gap_rate, search_.start(), search_.end(), end_.law_state, end_.dissipated);
}

template <class S>
void BasicRadauStepper<S>::shift_gap(int joint, double d, double rate) {
  const BasicJointData<S>& driven = system_.joints[joint];
  const double before = driven.law.energy(law_point(system_, joint, end_));
  end_.gap[joint][driven.driven] += d;
  end_.gap_rate[joint][driven.driven] += rate;
  if (driven.servo < 0) end_.supplied += driven.law.energy(law_point(system_, joint, end_)) - before;
}

template <class S>
void BasicRadauStepper<S>::balance_end() {
  system_.joint_kinematics(end_.t, end_m_, end_r_);
  find_joint_forces(system_, end_);
  find_law_rates(system_, end_);
  find_accelerations(system_, end_m_, end_r_, end_);
  find_power();
}

// theory/time section 3.4, error floor.
template <class S>
void BasicRadauStepper<S>::rebalance_end() {
  before_rebalancing_ = end_.a;
  find_rounding_of_joint_forces(system_, end_.q, rounding_);
  balance_end();
  for (int b = 0; b < system_.n_bodies(); ++b) {
    const typename S::Vec change = system_.bodies[b].mass.cwiseProduct((end_.a[b] - before_rebalancing_[b]).cwiseAbs());
    const typename S::Vec of_rounding = (change.array() <= rounding_[b].array()).select(change.array(), 0.0).matrix();
    raise_load_scale_above_rounding(b, StepControl::kAboveRounding * of_rounding);
  }
}

// Otherwise all passes miss the same impulse. A ball that strikes a damper 1e-10 s late reaches its next contact 2e-7 s late through the error of its speed, and the
// force there is wrong by 5e-4.
template <class S>
void BasicRadauStepper<S>::compensate_late_crossing(double late) {
  before_compensation_ = end_;
  for (std::size_t b = 0; b < end_.v.size(); ++b) end_.v[b] += late * (end_.a[b] - begin_.a[b]);
  for (std::size_t j = 0; j < end_.gap_rate.size(); ++j) end_.gap_rate[j] += late * (end_.gap_accel[j] - begin_.gap_accel[j]);
  end_.supplied += late * (end_.supply_power - begin_.supply_power);
  end_.dissipated += late * (end_.loss_power - begin_.loss_power);
  system_.motions(end_.q, end_.v, end_m_);
  balance_end();
}

template <class S>
void BasicRadauStepper<S>::undo_compensation() {
  end_ = before_compensation_;
  system_.motions(end_.q, end_.v, end_m_);
  balance_end();
}

template void BasicRadauStepper<Planar>::evaluate_switching_functions(double x, double h, double* value);
template void BasicRadauStepper<Planar>::extrapolate_switching_functions(double d, double* value);
template void BasicRadauStepper<Planar>::extrapolate_gaps(double d);
template bool BasicRadauStepper<Planar>::forces_stay_constant(double d);
template void BasicRadauStepper<Planar>::evaluate_switching_functions_at_end(double* value) const;
template double BasicRadauStepper<Planar>::change_in_loss_power(double d) const;
template void BasicRadauStepper<Planar>::extrapolate_end_state(double d);
template const std::vector<Planar::Motion>& BasicRadauStepper<Planar>::motions_after(double d);
template bool BasicRadauStepper<Planar>::cross_borders();
template void BasicRadauStepper<Planar>::shift_gap(int joint, double d, double rate);
template void BasicRadauStepper<Planar>::balance_end();
template void BasicRadauStepper<Planar>::rebalance_end();
template void BasicRadauStepper<Planar>::compensate_late_crossing(double late);
template void BasicRadauStepper<Planar>::undo_compensation();
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::evaluate_switching_functions(double x, double h, double* value);)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::extrapolate_switching_functions(double d, double* value);)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::extrapolate_gaps(double d);)
PINTLE_IN_SPACE(template bool BasicRadauStepper<Spatial>::forces_stay_constant(double d);)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::evaluate_switching_functions_at_end(double* value) const;)
PINTLE_IN_SPACE(template double BasicRadauStepper<Spatial>::change_in_loss_power(double d) const;)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::extrapolate_end_state(double d);)
PINTLE_IN_SPACE(template const std::vector<Spatial::Motion>& BasicRadauStepper<Spatial>::motions_after(double d);)
PINTLE_IN_SPACE(template bool BasicRadauStepper<Spatial>::cross_borders();)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::shift_gap(int joint, double d, double rate);)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::balance_end();)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::rebalance_end();)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::compensate_late_crossing(double late);)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::undo_compensation();)

}  // namespace pintle

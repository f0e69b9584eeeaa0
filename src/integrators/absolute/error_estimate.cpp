// The error of a step, and its end: moved onto its gaps, with the work done on the way.
#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/radau/stage_lanes.h"
#include "integrators/radau/step_error.h"
#include "integrators/thresholds.h"
#include "integrators/unresolved_ringing.h"

namespace pintle {

// The part of the forces that the step's polynomials leave unresolved, over the load scale. theory/time Eqs. (3.12), (3.13).
template <class S>
bool BasicRadauStepper<S>::error_estimate(double h, double& error) {
  const double mu = kProjectionShare * table_.real_eigenvalue / std::abs(h);
  if (!end_point_->prepare(begin_.t + h, mu, stage_[n_ - 1], tails_)) return false;
  const auto force_at = [this](int node, int j) -> const typename S::Vec& { return node == 0 ? begin_.force[j] : stage_[node - 1].force[j]; };
  error = of_motion_ ? std::max(motion_tail(), missed_behind_event(h)) : std::max({end_point_->error(tails_, scale_), change_of_loads(h), force_tail_.size(table_, scale_, force_at), open_contact_error(h), missed_behind_event(h),
                                                     bends_.missed_between_samples(begin_.t, h, end_m_, stage_[n_ - 1].m, scale_)});
  return std::isfinite(error);
}

// The change of the loads as the bodies are moved onto their gaps: positions are known no better. theory/time Eq. (3.20).
template <class S>
double BasicRadauStepper<S>::change_of_loads(double h) {
  if (system_.loads.empty() && system_.applied.empty()) return 0;
  load_change_.assign(system_.bodies.size(), S::Vec::Zero());
  const std::vector<RowOf4<S>>& moves = end_point_->corrections();
  system_.external_tangents(begin_.t + h, stage_[n_ - 1].m, [&](int i, int j, const typename S::Mat& dq, const typename S::Mat&) {
    for (int c = 0; c < S::kDof; ++c) load_change_[i] += dq.col(c) * moves[j][c][3];
  }, end_.sliding);
  double largest = 0;
  for (std::size_t b = 0; b < load_change_.size(); ++b) {
    if (!load_change_[b].allFinite()) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, load_change_[b].cwiseAbs().cwiseQuotient(scale_.body[b]).maxCoeff());
  }
  return kPlaceError * largest;
}

// theory/time Eq. (3.23).
template <class S>
double BasicRadauStepper<S>::open_contact_error(double h) const {
  if (open_contacts_.empty()) return 0;
  const BasicStage<S>& last = stage_[n_ - 1];
  const double t = begin_.t + h;
  return open_contacts_.error(h, [&](int j) { return BasicLawPoint<S>{t, last.gap[j], last.gap_rate[j], last.law_state.data() + system_.joints[j].first_state}; },
                              [&](int j) { return system_.kinematics(j, t, last.m); },
                              [&](int b) {
                                typename S::Vec last_coefficient;
                                for (int c = 0; c < S::kDof; ++c) last_coefficient[c] = tails_.bodies[b][c][0];
                                return last_coefficient;
                              },
                              largest_coordinate(last.q), scale_);
}

// theory/time Eqs. (3.24), (3.26). In a smooth motion it is next to zero.
template <class S>
double BasicRadauStepper<S>::missed_behind_event(double h) const {
  if (!control_.behind_event) return 0;
  const BasicStage<S>& last = stage_[n_ - 1];
  const double t = begin_.t + h;
  double largest = 0;
  for (int j = 0; j < system_.n_joints(); ++j) {
    typename S::Vec last_coefficient = S::Vec::Zero();
    for (int s = 0; s < n_; ++s) last_coefficient += table_.stages_to_legendre(n_ - 1, s) * stage_[s].gap_accel[j];
    const BasicLawPoint<S> at{t, last.gap[j], last.gap_rate[j], last.law_state.data() + system_.joints[j].first_state};
    const BasicJointKinematics<S> r = system_.kinematics(j, t, last.m);
    largest = std::max(largest, of_motion_ ? unresolved_motion(system_, j, at, r, last_coefficient, h, n_, motion_scale_.loads()) : unresolved_ringing(system_, j, at, r, last_coefficient, h, n_, scale_));
  }
  return largest;
}

// Legendre coefficients of the body forces M a, as accelerations that the bodies can follow within the step: stiff joints hold back
// the rest, and the step damps what it does not resolve of their vibration. theory/time Eq. (3.14).
template <class S>
double BasicRadauStepper<S>::motion_tail() {
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int c = 0; c < S::kDof; ++c) tails_.bodies[i][c] = system_.bodies[i].mass[c] * tails_.bodies[i][c];
  solver_->filter_accelerations(tails_.bodies);
  TailSize size;
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int k = 0; k < S::kDof; ++k) size.add((system_.bodies[i].mass[k] / motion_scale_.loads().body[i][k]) * tails_.bodies[i][k]);
  return size.value();
}

// theory/time Eqs. (4.1)-(4.3).
template <class S>
void BasicRadauStepper<S>::finish_step(double h) {
  nodes_.a[0] = begin_.a;
  nodes_.gap_accel[0] = begin_.gap_accel;
  nodes_.force[0] = begin_.force;
  nodes_.law_state[0] = begin_.law_state;
  nodes_.law_rate[0] = begin_.law_rate;
  end_.t = begin_.t + h;
  end_point_->finish(stage_[n_ - 1], h, end_, end_m_, scale_);
  raise_above_rounding_of_servos();
  add_work(h);
  for (int s = 0; s < n_; ++s) {
    nodes_.a[s + 1].swap(stage_[s].a);
    nodes_.gap_accel[s + 1].swap(stage_[s].gap_accel);
    nodes_.force[s + 1].swap(stage_[s].force);
    nodes_.law_state[s + 1].swap(stage_[s].law_state);
    nodes_.law_rate[s + 1].swap(stage_[s].law_rate);
    if (S::kCurved) nodes_.increment_rate[s + 1].swap(stage_[s].increment_rate);
  }
  nodes_.force[n_] = end_.force;
  if (S::kCurved) find_increments(h);
  control_.step_made(h);
  this->update_switching();
}

template <class S>
void BasicRadauStepper<S>::taylor_step(double h) {
  for (int node = 0; node <= n_; ++node) {
    const double d = h * table_.nodes[node];
    nodes_.a[node] = begin_.a;
    nodes_.gap_accel[node] = begin_.gap_accel;
    nodes_.force[node] = begin_.force;
    nodes_.law_rate[node] = begin_.law_rate;
    for (std::size_t z = 0; z < begin_.law_state.size(); ++z) nodes_.law_state[node][z] = begin_.law_state[z] + d * begin_.law_rate[z];
    nodes_.power[node] = {begin_.supply_power, begin_.loss_power};
    if (S::kCurved)
      for (std::size_t b = 0; b < begin_.v.size(); ++b) nodes_.increment_rate[node][b] = begin_.v[b] + d * begin_.a[b];
  }
  extrapolate_end_state(h);
  balance_end();
  if (S::kCurved) find_increments(h);
  control_.step_made(h);
  this->update_switching();
}

// What the integrals of the increments' rates miss at the end, which is the projection. theory/space Eq. (2.3).
template <class S>
void BasicRadauStepper<S>::find_increments(double h) {
  nodes_.increment_rate[0] = begin_.v;
  RadauTable::Vec weight(n_ + 1);
  for (int node = 0; node <= n_; ++node) {
    weight[node] = 0;
    for (int k = 0; k <= n_; ++k) weight[node] += table_.to_powers(k, node) / (k + 1);
  }
  for (std::size_t b = 0; b < end_.q.size(); ++b) {
    typename S::Vec dq = S::Vec::Zero();
    for (int node = 0; node <= n_; ++node) dq += h * weight[node] * nodes_.increment_rate[node][b];
    nodes_.increment_bend[b] = S::rate_of_increment(dq, S::difference(end_.q[b], S::moved(begin_.q[b], dq)));
  }
}

template <class S>
void BasicRadauStepper<S>::add_work(double h) {
  nodes_.power[0] = {begin_.supply_power, begin_.loss_power};
  for (int s = 0; s < n_; ++s) {
    const BasicStage<S>& stage = stage_[s];
    Power& power = nodes_.power[s + 1];
    power = power_of_loads(begin_.t + h * table_.c[s], stage.q, stage.m);
    power[1] += stage.loss;
    for (const int j : powered_) {
      const BasicJointData<S>& joint = system_.joints[j];
      const BasicLawPoint<S> at{begin_.t + h * table_.c[s], stage.gap[j], stage.gap_rate[j], stage.law_state.data() + joint.first_state};
      add_power(joint, stage.m, at, stage.force[j], power);
    }
  }
  end_.supplied = begin_.supplied;
  end_.dissipated = begin_.dissipated;
  for (int s = 0; s < n_; ++s) {
    end_.supplied += h * table_.b[s] * nodes_.power[s + 1][0];
    end_.dissipated += h * table_.b[s] * nodes_.power[s + 1][1];
  }
  for (const int j : powered_)
    if (system_.joints[j].servo >= 0) end_.supplied += servo_work_missed_by_quadrature(j, h);
  end_.supply_power = nodes_.power[n_][0];
  end_.loss_power = nodes_.power[n_][1];
}

template <class S>
double BasicRadauStepper<S>::servo_work_missed_by_quadrature(int j, double h) const {
  const BasicJointData<S>& joint = system_.joints[j];
  const auto target_rate = [&](int node) { return target_of(joint, begin_.t + h * table_.nodes[node])[1]; };
  return work_missed_by_quadrature(
      table_, h, [&](int node) { return stage_[node - 1].force[j][joint.servo]; },
      [&](int node) { return (node == 0 ? begin_.gap_rate : stage_[node - 1].gap_rate)[j][joint.servo] + target_rate(node); });
}

template <class S>
typename BasicRadauStepper<S>::Power BasicRadauStepper<S>::power_of_loads(double t, const PositionsOf<S>& q, const std::vector<typename S::Motion>& m) const {
  if (!system_.has_loads()) return {};
  const ExternalWork work = system_.external_work(t, q, m, end_.sliding);
  return {work.supplied, work.lost};
}

template <class S>
void BasicRadauStepper<S>::add_power(const BasicJointData<S>& joint, const std::vector<typename S::Motion>& m, const BasicLawPoint<S>& at, const typename S::Vec& force, Power& power) const {
  power[0] += system_.drive_power(joint, at.t, m, force);
  if (joint.servo < 0) power[1] += joint.law.loss(at);
}

// At end_.
template <class S>
void BasicRadauStepper<S>::find_power() {
  Power power = power_of_loads(end_.t, end_.q, end_m_);
  for (int j = 0; j < system_.n_joints(); ++j) add_power(system_.joints[j], end_m_, law_point(system_, j, end_), end_.force[j], power);
  end_.supply_power = power[0];
  end_.loss_power = power[1];
}

template bool BasicRadauStepper<Planar>::error_estimate(double h, double& error);
template double BasicRadauStepper<Planar>::change_of_loads(double h);
template double BasicRadauStepper<Planar>::open_contact_error(double h) const;
template double BasicRadauStepper<Planar>::missed_behind_event(double h) const;
template double BasicRadauStepper<Planar>::servo_work_missed_by_quadrature(int j, double h) const;
template double BasicRadauStepper<Planar>::motion_tail();
template void BasicRadauStepper<Planar>::finish_step(double h);
template void BasicRadauStepper<Planar>::taylor_step(double h);
template void BasicRadauStepper<Planar>::find_increments(double h);
template void BasicRadauStepper<Planar>::add_work(double h);
template BasicRadauStepper<Planar>::Power BasicRadauStepper<Planar>::power_of_loads(double t, const PositionsOf<Planar>& q, const std::vector<Planar::Motion>& m) const;
template void BasicRadauStepper<Planar>::add_power(const BasicJointData<Planar>& joint, const std::vector<Planar::Motion>& m, const BasicLawPoint<Planar>& at, const Planar::Vec& force, Power& power) const;
template void BasicRadauStepper<Planar>::find_power();
PINTLE_IN_SPACE(template bool BasicRadauStepper<Spatial>::error_estimate(double h, double& error);)
PINTLE_IN_SPACE(template double BasicRadauStepper<Spatial>::change_of_loads(double h);)
PINTLE_IN_SPACE(template double BasicRadauStepper<Spatial>::open_contact_error(double h) const;)
PINTLE_IN_SPACE(template double BasicRadauStepper<Spatial>::missed_behind_event(double h) const;)
PINTLE_IN_SPACE(template double BasicRadauStepper<Spatial>::servo_work_missed_by_quadrature(int j, double h) const;)
PINTLE_IN_SPACE(template double BasicRadauStepper<Spatial>::motion_tail();)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::finish_step(double h);)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::taylor_step(double h);)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::find_increments(double h);)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::add_work(double h);)
PINTLE_IN_SPACE(template BasicRadauStepper<Spatial>::Power BasicRadauStepper<Spatial>::power_of_loads(double t, const PositionsOf<Spatial>& q, const std::vector<Spatial::Motion>& m) const;)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::add_power(const BasicJointData<Spatial>& joint, const std::vector<Spatial::Motion>& m, const BasicLawPoint<Spatial>& at, const Spatial::Vec& force, Power& power) const;)
PINTLE_IN_SPACE(template void BasicRadauStepper<Spatial>::find_power();)

}  // namespace pintle

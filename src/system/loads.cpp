// Forces that are not a joint's: gravity, springs and dampers, motors with a torque law, applied forces.
#include <algorithm>
#include <array>

#include "system/applied_wrench.h"
#include "system/load_displacement.h"

namespace pintle {

Spatial::Vec gyroscopic_force(const BasicBodyData<Spatial>& body, const Spatial::Motion& m) {
  Spatial::Vec f;
  f << Eigen::Vector3d::Zero(), Eigen::Vector3d(body.mass.tail<3>().cwiseProduct(m.w_body)).cross(m.w_body);
  return f;
}

Spatial::Mat gyroscopic_tangent(const BasicBodyData<Spatial>& body, const Spatial::Motion& m) {
  Spatial::Mat slope = Spatial::Mat::Zero();
  const Eigen::Vector3d I = body.mass.tail<3>(), spin = I.cwiseProduct(m.w_body);
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(c);
    slope.block<3, 1>(3, 3 + c) = spin.cross(unit) + I[c] * unit.cross(m.w_body);
  }
  return slope;
}

namespace {

template <class S>
double value_of(const BasicSystem<S>& system, const BasicSignal<S>& signal, double t, const std::vector<typename S::Motion>& m) {
  if (signal.is_time) return t;
  const typename S::RelativePose pose = system.pose(signal.at, m);
  return signal.rate ? pose.rate[signal.component] : pose.z[signal.component];
}

double power_on(const Planar::Motion& body, const PlanarWrench& w, const Planar::Point& arm) {
  return w.force.dot(body.v + body.w * Planar::perp(arm)) + w.couple * body.w;
}
[[maybe_unused]] double power_on(const Spatial::Motion& body, const SpatialWrench& w, const Spatial::Point& arm) {
  return w.force.dot(body.v + body.w.cross(arm)) + w.couple.dot(body.w);
}

// The change of the force on a body as the body turns.
Planar::Mat turning_tangent(const AppliedData& force, const PlanarWrench& w, const Planar::Motion& body) {
  const Planar::Point arm = body.turned(force.at.p);
  Planar::Mat dq = Planar::Mat::Zero();
  if (force.body_axes) {
    dq.block<2, 1>(0, 2) = Planar::perp(w.force);  // the moment does not change: arm and force turn together
  } else {
    dq(2, 2) = -arm.dot(w.force);
  }
  return dq;
}
// theory/space Eq. (4.3).
[[maybe_unused]] Spatial::Mat turning_tangent(const BasicAppliedData<Spatial>& force, const SpatialWrench& w, const Spatial::Motion& body) {
  Spatial::Mat dq = Spatial::Mat::Zero();
  const Eigen::Vector3d f = body.R.transpose() * w.force, couple = body.R.transpose() * w.couple;
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3d turn = Eigen::Vector3d::Unit(c);
    if (force.body_axes) dq.block<3, 1>(0, 3 + c) = body.R * turn.cross(f);
    else dq.block<3, 1>(3, 3 + c) = couple.cross(turn) + force.at.p.cross(f.cross(turn));
  }
  return dq;
}

}  // namespace

template <class S>
const Expression::Ramp* BasicSystem<S>::ramp_of(const BasicLoadData<S>& load, SlidingModes sliding) const {
  for (const SlidingMode& jump : sliding)
    if (&loads[jump.load] == &load) return &jump.ramp;
  return nullptr;
}

template <class S>
typename BasicSystem<S>::LoadState BasicSystem<S>::load_state(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m, SlidingModes sliding) const {
  LoadState state;
  state.displacement = displacement_of(load);
  state.pose = pose(load.at, m);
  state.kinematics = read(state.displacement, state.pose);
  state.slot = slot_of(load);
  if (load.kind == LoadKind::kEffort) {
    const auto values = signal_values(load, t, m);
    const std::size_t n = load.signals.size();
    const auto at = std::span(values).first(n);
    const auto slopes = std::span(state.df_dsignal).first(n);
    const Expression::Ramp* ramp = ramp_of(load, sliding);
    state.effort = ramp ? load.law.gradient(at, slopes, *ramp) : load.law.gradient(at, slopes);
  } else {
    state.effort = -(load.constant + load.k * state.kinematics.gap[state.slot] + load.c * state.kinematics.rate[state.slot]);
    state.df_dgap = -load.k;
    state.df_drate = -load.c;
  }
  return state;
}

template <class S>
std::array<double, kMaxSignals> BasicSystem<S>::signal_values(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m) const {
  std::array<double, kMaxSignals> values{};
  const std::size_t n = std::min<std::size_t>(load.signals.size(), kMaxSignals);
  for (std::size_t s = 0; s < n; ++s) values[s] = value_of(*this, load.signals[s], t, m);
  return values;
}

template <class S>
double BasicSystem<S>::load_effort(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m, SlidingModes sliding) const {
  return load_state(load, t, m, sliding).effort;
}

template <class S>
void BasicSystem<S>::external(double t, const std::vector<typename S::Motion>& m, VecsOf<S>& Q, SlidingModes sliding) const {
  Q.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) Q[i] = bodies[i].gravity;
  for (const BasicLoadData<S>& load : loads) {
    const LoadState s = load_state(load, t, m, sliding);
    if (load.at.a != kGround) Q[load.at.a] += s.kinematics.GA().row(s.slot).transpose() * s.effort;
    if (load.at.b != kGround) Q[load.at.b] += s.kinematics.GB().row(s.slot).transpose() * s.effort;
  }
  for (const BasicAppliedData<S>& force : applied) {
    const typename S::Motion& body = m[force.body];
    const auto w = wrench(force, t, body);
    Q[force.body] += body.wrench(w.force, w.couple, body.turned(force.at.p));
  }
  if constexpr (S::kGyroscopic)
    for (std::size_t i = 0; i < bodies.size(); ++i) Q[i] += gyroscopic_force(bodies[i], m[i]);
}

template <class S>
ExternalWork BasicSystem<S>::external_work(double t, const PositionsOf<S>& q, const std::vector<typename S::Motion>& m, SlidingModes sliding) const {
  ExternalWork work;
  for (std::size_t i = 0; i < bodies.size(); ++i) work.potential -= bodies[i].gravity.template head<S::kDim>().dot(S::position(q[i]));
  for (const BasicLoadData<S>& load : loads) {
    const ExternalWork own = work_of(load, t, m, sliding);
    work.potential += own.potential;
    work.supplied += own.supplied;
    work.lost += own.lost;
  }
  for (const BasicAppliedData<S>& force : applied) work.supplied += power_of(force, t, m);
  return work;
}

template <class S>
ExternalWork BasicSystem<S>::work_of(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m, SlidingModes sliding) const {
  const LoadState s = load_state(load, t, m, sliding);
  const double gap = s.kinematics.gap[s.slot], rate = s.kinematics.rate[s.slot];
  if (load.kind == LoadKind::kEffort) return {0, s.effort * rate, 0};
  return {(load.constant + 0.5 * load.k * gap) * gap, 0, load.c * rate * rate};
}

template <class S>
double BasicSystem<S>::power_of(const BasicAppliedData<S>& force, double t, const std::vector<typename S::Motion>& m) const {
  const typename S::Motion& body = m[force.body];
  return power_on(body, wrench(force, t, body), body.turned(force.at.p));
}

template <class S>
void BasicSystem<S>::evaluate_switching_functions(double t, const std::vector<typename S::Motion>& m, const VecsOf<S>& gap, const VecsOf<S>& rate, const std::vector<double>& law_state, SlidingModes sliding,
                                                  double* value) const {
  const auto find = [&value](const Expression& e, std::span<const double> at, const Expression::Ramp* ramp) {
    const int n = e.n_switches();
    if (n > 0) e.evaluate_switching_functions(at, value, ramp);
    value += n;
  };
  const std::array<double, 1> time{t};
  const auto find_at_t = [&](const Expression& e) { find(e, std::span(time).first(e.variables().size()), nullptr); };
  for (int j = 0; j < n_joints(); ++j) {
    const BasicJointData<S>& joint = joints[j];
    joint.law.borders({t, gap[j], rate[j], law_state.data() + joint.first_state}, value);
    value += joint.law.n_borders();
    if (joint.driven >= 0) find_at_t(joint.target);
  }
  for (const BasicLoadData<S>& load : loads) {
    if (load.kind != LoadKind::kEffort || load.law.n_switches() == 0) continue;
    const auto values = signal_values(load, t, m);
    find(load.law, std::span(values).first(load.signals.size()), ramp_of(load, sliding));
  }
  for (const BasicAppliedData<S>& force : applied)
    for (const Expression* e : force.functions()) find_at_t(*e);
}

template <class S>
bool BasicSystem<S>::cross_borders(double t, const VecsOf<S>& gap, const VecsOf<S>& rate, const double* before, const double* after, std::vector<double>& law_state, double& lost) const {
  bool crossed = false;
  for (std::size_t f = 0; f < switching_.size(); ++f) {
    const SwitchingFunction& function = switching_[f];
    if (!function.is_crossing(before[f], after[f])) continue;
    const BasicJointData<S>& joint = joints[function.index];
    double* const state = law_state.data() + joint.first_state;
    joint.law.cross({t, gap[function.index], rate[function.index], state}, function.part, function.border, state, lost);
    crossed = true;
  }
  return crossed;
}

template <class S>
std::optional<SlidingMode> BasicSystem<S>::jump_between(double t0, const std::vector<typename S::Motion>& m0, double t1, const std::vector<typename S::Motion>& m1) const {
  for (const BasicLoadData<S>& load : loads) {
    if (load.kind != LoadKind::kEffort || load.law.n_switches() == 0) continue;
    const auto from = signal_values(load, t0, m0), to = signal_values(load, t1, m1);
    const std::size_t n = load.signals.size();
    if (const auto jump = load.law.jump_between(std::span(from).first(n), std::span(to).first(n)))
      return SlidingMode{static_cast<int>(&load - loads.data()), {*jump}};
  }
  return {};
}

template <class S>
double BasicSystem<S>::margin(const SlidingMode& jump, double t, const std::vector<typename S::Motion>& m) const {
  const BasicLoadData<S>& load = loads[jump.load];
  const auto values = signal_values(load, t, m);
  return load.law.margin(jump.ramp.jump, std::span(values).first(load.signals.size()));
}

template <class S>
void BasicSystem<S>::load_tangents(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m, SlidingModes sliding, std::vector<Tangent>& out) const {
  const LoadState s = load_state(load, t, m, sliding);
  using Row = Eigen::Matrix<double, 1, S::kDof>;
  constexpr int n = S::kDof;
  const std::array<int, 2> body{load.at.a, load.at.b};
  const std::array<Row, 2> G{s.kinematics.GA().row(s.slot), s.kinematics.GB().row(s.slot)};
  const auto geometric = geometric_stiffness(s.displacement, s.pose, Vec::Unit(s.slot) * s.effort);
  const auto rate_slope = rate_gradient(s.displacement, s.pose, motion_of(load.at.a, m), motion_of(load.at.b, m));
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      if (body[i] == kGround || body[j] == kGround) continue;
      const Row rate_j = rate_slope.template block<1, n>(s.slot, n * j);
      out.push_back({body[i], body[j],
                     geometric.template block<n, n>(n * i, n * j) + G[i].transpose() * (s.df_dgap * G[j] + s.df_drate * rate_j),
                     G[i].transpose() * (s.df_drate * G[j])});
    }
  for (std::size_t k = 0; k < load.signals.size(); ++k) {
    const BasicSignal<S>& signal = load.signals[k];
    if (signal.is_time) continue;
    const BasicPlacement<S>& at = signal.at;
    const typename S::RelativePose p = pose(at, m);
    const auto slope = p.rate_gradient(motion_of(at.a, m), motion_of(at.b, m));
    const std::array<int, 2> source{at.a, at.b};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        if (body[i] == kGround || source[j] == kGround) continue;
        const Row dz = j == 0 ? p.GA().row(signal.component) : p.GB().row(signal.component);
        const Row dq = signal.rate ? Row(slope.template block<1, n>(signal.component, n * j)) : dz;
        const Mat zero = Mat::Zero();
        out.push_back({body[i], source[j], G[i].transpose() * (s.df_dsignal[k] * dq),
                       signal.rate ? Mat(G[i].transpose() * (s.df_dsignal[k] * dz)) : zero});
      }
  }
}

template <class S>
void BasicSystem<S>::applied_tangents(const BasicAppliedData<S>& force, double t, const std::vector<typename S::Motion>& m, std::vector<Tangent>& out) const {
  const typename S::Motion& body = m[force.body];
  out.push_back({force.body, force.body, turning_tangent(force, wrench(force, t, body), body), Mat::Zero()});
}

template const Expression::Ramp* BasicSystem<Planar>::ramp_of(const BasicLoadData<Planar>& load, SlidingModes sliding) const;
template BasicSystem<Planar>::LoadState BasicSystem<Planar>::load_state(const BasicLoadData<Planar>& load, double t, const std::vector<Planar::Motion>& m, SlidingModes sliding) const;
template std::array<double, kMaxSignals> BasicSystem<Planar>::signal_values(const BasicLoadData<Planar>& load, double t, const std::vector<Planar::Motion>& m) const;
template double BasicSystem<Planar>::load_effort(const BasicLoadData<Planar>& load, double t, const std::vector<Planar::Motion>& m, SlidingModes sliding) const;
template void BasicSystem<Planar>::external(double t, const std::vector<Planar::Motion>& m, VecsOf<Planar>& Q, SlidingModes sliding) const;
template ExternalWork BasicSystem<Planar>::external_work(double t, const PositionsOf<Planar>& q, const std::vector<Planar::Motion>& m, SlidingModes sliding) const;
template bool BasicSystem<Planar>::cross_borders(double t, const VecsOf<Planar>& gap, const VecsOf<Planar>& rate, const double* before, const double* after, std::vector<double>& law_state, double& lost) const;
template ExternalWork BasicSystem<Planar>::work_of(const BasicLoadData<Planar>& load, double t, const std::vector<Planar::Motion>& m, SlidingModes sliding) const;
template double BasicSystem<Planar>::power_of(const BasicAppliedData<Planar>& force, double t, const std::vector<Planar::Motion>& m) const;
template void BasicSystem<Planar>::evaluate_switching_functions(double t, const std::vector<Planar::Motion>& m, const VecsOf<Planar>& gap, const VecsOf<Planar>& rate, const std::vector<double>& law_state, SlidingModes sliding, double* value) const;
template std::optional<SlidingMode> BasicSystem<Planar>::jump_between(double t0, const std::vector<Planar::Motion>& m0, double t1, const std::vector<Planar::Motion>& m1) const;
template double BasicSystem<Planar>::margin(const SlidingMode& jump, double t, const std::vector<Planar::Motion>& m) const;
template void BasicSystem<Planar>::load_tangents(const BasicLoadData<Planar>& load, double t, const std::vector<Planar::Motion>& m, SlidingModes sliding, std::vector<Tangent>& out) const;
template void BasicSystem<Planar>::applied_tangents(const BasicAppliedData<Planar>& force, double t, const std::vector<Planar::Motion>& m, std::vector<Tangent>& out) const;
PINTLE_IN_SPACE(template const Expression::Ramp* BasicSystem<Spatial>::ramp_of(const BasicLoadData<Spatial>& load, SlidingModes sliding) const;)
PINTLE_IN_SPACE(template BasicSystem<Spatial>::LoadState BasicSystem<Spatial>::load_state(const BasicLoadData<Spatial>& load, double t, const std::vector<Spatial::Motion>& m, SlidingModes sliding) const;)
PINTLE_IN_SPACE(template std::array<double, kMaxSignals> BasicSystem<Spatial>::signal_values(const BasicLoadData<Spatial>& load, double t, const std::vector<Spatial::Motion>& m) const;)
PINTLE_IN_SPACE(template double BasicSystem<Spatial>::load_effort(const BasicLoadData<Spatial>& load, double t, const std::vector<Spatial::Motion>& m, SlidingModes sliding) const;)
PINTLE_IN_SPACE(template void BasicSystem<Spatial>::external(double t, const std::vector<Spatial::Motion>& m, VecsOf<Spatial>& Q, SlidingModes sliding) const;)
PINTLE_IN_SPACE(template ExternalWork BasicSystem<Spatial>::external_work(double t, const PositionsOf<Spatial>& q, const std::vector<Spatial::Motion>& m, SlidingModes sliding) const;)
PINTLE_IN_SPACE(template bool BasicSystem<Spatial>::cross_borders(double t, const VecsOf<Spatial>& gap, const VecsOf<Spatial>& rate, const double* before, const double* after, std::vector<double>& law_state, double& lost) const;)
PINTLE_IN_SPACE(template ExternalWork BasicSystem<Spatial>::work_of(const BasicLoadData<Spatial>& load, double t, const std::vector<Spatial::Motion>& m, SlidingModes sliding) const;)
PINTLE_IN_SPACE(template double BasicSystem<Spatial>::power_of(const BasicAppliedData<Spatial>& force, double t, const std::vector<Spatial::Motion>& m) const;)
PINTLE_IN_SPACE(template void BasicSystem<Spatial>::evaluate_switching_functions(double t, const std::vector<Spatial::Motion>& m, const VecsOf<Spatial>& gap, const VecsOf<Spatial>& rate, const std::vector<double>& law_state, SlidingModes sliding, double* value) const;)
PINTLE_IN_SPACE(template std::optional<SlidingMode> BasicSystem<Spatial>::jump_between(double t0, const std::vector<Spatial::Motion>& m0, double t1, const std::vector<Spatial::Motion>& m1) const;)
PINTLE_IN_SPACE(template double BasicSystem<Spatial>::margin(const SlidingMode& jump, double t, const std::vector<Spatial::Motion>& m) const;)
PINTLE_IN_SPACE(template void BasicSystem<Spatial>::load_tangents(const BasicLoadData<Spatial>& load, double t, const std::vector<Spatial::Motion>& m, SlidingModes sliding, std::vector<Tangent>& out) const;)
PINTLE_IN_SPACE(template void BasicSystem<Spatial>::applied_tangents(const BasicAppliedData<Spatial>& force, double t, const std::vector<Spatial::Motion>& m, std::vector<Tangent>& out) const;)

}  // namespace pintle

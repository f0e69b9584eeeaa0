// Forces that are not a joint's: gravity, springs and dampers, motors with a torque law, applied forces.
#include <algorithm>
#include <array>

#include "system/system.h"

namespace pintle {
namespace {

using S = Planar;
constexpr int kMaxSignals = 16;

JointDisplacement displacement_of(const LoadData& load) {
  if (load.kind == LoadKind::kSpring) return Distance{load.free};
  return Selection{S::Vec::Unit(load.component) * (load.kind == LoadKind::kTorsionSpring ? load.free : 0.0)};
}

// Values of the signals an effort expression reads.
std::array<double, kMaxSignals> signal_values(const System& system, const LoadData& load, double t, const std::vector<S::Motion>& m) {
  std::array<double, kMaxSignals> values{};
  const std::size_t n = std::min<std::size_t>(load.signals.size(), kMaxSignals);
  for (std::size_t s = 0; s < n; ++s) {
    const Signal& signal = load.signals[s];
    if (signal.joint < 0) {
      values[s] = t;
      continue;
    }
    const RelativePose pose = system.pose(system.joints[signal.joint].at, m);
    values[s] = signal.rate ? pose.rate[signal.component] : pose.z[signal.component];
  }
  return values;
}

// An applied force in world axes, at time t.
struct Wrench {
  S::Point force;
  double torque;
};
Wrench wrench(const AppliedData& load, double t, const S::Motion& body) {
  const std::array<double, 1> time{t};
  const auto at_t = [&time](const Expression& e) { return e.value(std::span(time).first(e.variables().size())); };
  const S::Point f(at_t(load.fx), at_t(load.fy));
  return {load.body_axes ? body.turned(f) : f, at_t(load.torque)};
}

}  // namespace

// A load at an instant: its kinematics, its force conjugate to their components, and the slopes of that force.
struct System::LoadState {
  JointDisplacement displacement;
  RelativePose pose;
  JointKinematics kinematics;
  double effort = 0;  // force along the component [N] or [N*m]; a spring in tension has a negative one
  int slot = 0;       // component of the displacement
  double df_dgap = 0, df_drate = 0;
  std::array<double, kMaxSignals> df_dsignal{};
};

const Expression::Ramp* System::ramp_of(const LoadData& load, SlidingModes sliding) const {
  for (const SlidingMode& jump : sliding)
    if (&loads[jump.load] == &load) return &jump.ramp;
  return nullptr;
}

System::LoadState System::load_state(const LoadData& load, double t, const std::vector<S::Motion>& m, SlidingModes sliding) const {
  LoadState state;
  state.displacement = displacement_of(load);
  state.pose = pose(load.at, m);
  state.kinematics = read(state.displacement, state.pose);
  state.slot = load.kind == LoadKind::kSpring ? 0 : load.component;
  if (load.kind == LoadKind::kEffort) {
    const auto values = signal_values(*this, load, t, m);
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

double System::load_effort(const LoadData& load, double t, const std::vector<S::Motion>& m, SlidingModes sliding) const {
  return load_state(load, t, m, sliding).effort;
}

void System::external(double t, const std::vector<S::Motion>& m, Vecs& Q, SlidingModes sliding) const {
  Q.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) Q[i] = bodies[i].gravity;
  for (const LoadData& load : loads) {
    const LoadState s = load_state(load, t, m, sliding);
    if (load.at.a != kGround) Q[load.at.a] += s.kinematics.GA().row(s.slot).transpose() * s.effort;
    if (load.at.b != kGround) Q[load.at.b] += s.kinematics.GB().row(s.slot).transpose() * s.effort;
  }
  for (const AppliedData& force : applied) {
    const S::Motion& body = m[force.body];
    const Wrench w = wrench(force, t, body);
    Q[force.body] += Vec(w.force.x(), w.force.y(), w.torque + S::cross(body.turned(force.at.p), w.force));
  }
}

ExternalWork System::external_work(double t, const Vecs& q, const std::vector<S::Motion>& m, SlidingModes sliding) const {
  ExternalWork work;
  for (std::size_t i = 0; i < bodies.size(); ++i) work.potential -= bodies[i].gravity.dot(q[i]);
  for (const LoadData& load : loads) {
    const LoadState s = load_state(load, t, m, sliding);
    const double gap = s.kinematics.gap[s.slot], rate = s.kinematics.rate[s.slot];
    if (load.kind == LoadKind::kEffort) {
      work.supplied += s.effort * rate;
    } else {
      work.potential += (load.constant + 0.5 * load.k * gap) * gap;
      work.lost += load.c * rate * rate;
    }
  }
  for (const AppliedData& force : applied) {
    const S::Motion& body = m[force.body];
    const Wrench w = wrench(force, t, body);
    work.supplied += w.force.dot(body.v + body.w * S::perp(body.turned(force.at.p))) + w.torque * body.w;
  }
  return work;
}

void System::find_switching(double t, const std::vector<S::Motion>& m, const Vecs& gap, const Vecs& rate, const std::vector<double>& law_state, SlidingModes sliding,
                            double* value) const {
  const auto find = [&value](const Expression& e, std::span<const double> at, const Expression::Ramp* ramp) {
    const int n = e.n_switches();
    if (n > 0) e.find_switching(at, value, ramp);
    value += n;
  };
  const std::array<double, 1> time{t};
  const auto find_at_t = [&](const Expression& e) { find(e, std::span(time).first(e.variables().size()), nullptr); };
  for (int j = 0; j < n_joints(); ++j) {
    const JointData& joint = joints[j];
    joint.law.borders({t, gap[j], rate[j], law_state.data() + joint.first_state}, value);
    value += joint.law.n_borders();
    if (joint.servo >= 0) find_at_t(joint.target);
  }
  for (const LoadData& load : loads) {
    if (load.kind != LoadKind::kEffort || load.law.n_switches() == 0) continue;
    const auto values = signal_values(*this, load, t, m);
    find(load.law, std::span(values).first(load.signals.size()), ramp_of(load, sliding));
  }
  for (const AppliedData& force : applied)
    for (const Expression* e : {&force.fx, &force.fy, &force.torque}) find_at_t(*e);
}

std::optional<SlidingMode> System::jump_between(double t0, const std::vector<S::Motion>& m0, double t1, const std::vector<S::Motion>& m1) const {
  for (const LoadData& load : loads) {
    if (load.kind != LoadKind::kEffort || load.law.n_switches() == 0) continue;
    const auto from = signal_values(*this, load, t0, m0), to = signal_values(*this, load, t1, m1);
    const std::size_t n = load.signals.size();
    if (const auto jump = load.law.jump_between(std::span(from).first(n), std::span(to).first(n)))
      return SlidingMode{static_cast<int>(&load - loads.data()), {*jump}};
  }
  return {};
}

double System::margin(const SlidingMode& jump, double t, const std::vector<S::Motion>& m) const {
  const LoadData& load = loads[jump.load];
  const auto values = signal_values(*this, load, t, m);
  return load.law.margin(jump.ramp.jump, std::span(values).first(load.signals.size()));
}

void System::load_tangents(const LoadData& load, double t, const std::vector<S::Motion>& m, SlidingModes sliding, std::vector<Tangent>& out) const {
  const LoadState s = load_state(load, t, m, sliding);
  const std::array<int, 2> body{load.at.a, load.at.b};
  const std::array<Eigen::RowVector3d, 2> G{s.kinematics.GA().row(s.slot), s.kinematics.GB().row(s.slot)};
  const auto geometric = geometric_stiffness(s.displacement, s.pose, Vec::Unit(s.slot) * s.effort);
  const auto rate_slope = rate_gradient(s.displacement, s.pose, motion_of(load.at.a, m), motion_of(load.at.b, m));
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      if (body[i] == kGround || body[j] == kGround) continue;
      const Eigen::RowVector3d rate_j = rate_slope.block<1, 3>(s.slot, 3 * j);
      out.push_back({body[i], body[j],
                     geometric.block<3, 3>(3 * i, 3 * j) + G[i].transpose() * (s.df_dgap * G[j] + s.df_drate * rate_j),
                     G[i].transpose() * (s.df_drate * G[j])});
    }
  for (std::size_t k = 0; k < load.signals.size(); ++k) {
    const Signal& signal = load.signals[k];
    if (signal.joint < 0) continue;
    const Placement& at = joints[signal.joint].at;
    const RelativePose p = pose(at, m);
    const auto slope = p.rate_gradient(motion_of(at.a, m), motion_of(at.b, m));
    const std::array<int, 2> source{at.a, at.b};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        if (body[i] == kGround || source[j] == kGround) continue;
        const Eigen::RowVector3d dz = j == 0 ? p.GA().row(signal.component) : p.GB().row(signal.component);
        const Eigen::RowVector3d dq = signal.rate ? Eigen::RowVector3d(slope.block<1, 3>(signal.component, 3 * j)) : dz;
        const Mat zero = Mat::Zero();
        out.push_back({body[i], source[j], G[i].transpose() * (s.df_dsignal[k] * dq),
                       signal.rate ? Mat(G[i].transpose() * (s.df_dsignal[k] * dz)) : zero});
      }
  }
}

void System::applied_tangents(const AppliedData& force, double t, const std::vector<S::Motion>& m, std::vector<Tangent>& out) const {
  const S::Motion& body = m[force.body];
  const Wrench w = wrench(force, t, body);
  const S::Point arm = body.turned(force.at.p);
  Mat dq = Mat::Zero();
  if (force.body_axes) {
    dq.block<2, 1>(0, 2) = S::perp(w.force);  // the moment stays: arm and force turn together
  } else {
    dq(2, 2) = -arm.dot(w.force);
  }
  out.push_back({force.body, force.body, dq, Mat::Zero()});
}

}  // namespace pintle

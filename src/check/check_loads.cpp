// Springs, motors and applied forces: tangents against differences, one load at a time; the same for
// expressions.
#include <algorithm>
#include <array>
#include <cmath>

#include "check/check_batteries.h"
#include "check/check_differences.h"

namespace pintle {
namespace {

using S = Planar;

constexpr long kMaxLoadWork = 20'000'000;  // bodies times loads: beyond this only the whole mechanism is compared

// A system with all bodies and a single load, without weight and joints.
System weightless(const System& system) {
  System bodies;
  bodies.bodies = system.bodies;
  for (BodyData& body : bodies.bodies) body.gravity.setZero();
  return bodies;
}
System with_load(System bodies, const LoadData& load) {
  bodies.loads = {load};
  return bodies;
}
System with_load(System bodies, const AppliedData& force) {
  bodies.applied = {force};
  return bodies;
}

std::vector<int> bodies_of(const LoadData& load) {
  std::vector<int> bodies{load.at.a, load.at.b};
  for (const Signal& signal : load.signals)
    if (!signal.is_time) bodies.insert(bodies.end(), {signal.at.a, signal.at.b});
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  if (bodies.front() == kGround) bodies.erase(bodies.begin());
  return bodies;
}

class LoadSlopes {
 public:
  // Derivatives with respect to positions, then velocities, of the bodies involved.
  void look(const System& one, const CheckState& state, const std::vector<int>& bodies, const CheckPlace& place,
            double length) {
    const int n = S::kDof * static_cast<int>(bodies.size());
    const Eigen::VectorXd here = force(one, state, bodies, Eigen::VectorXd::Zero(2 * n));
    Eigen::MatrixXd dq = Eigen::MatrixXd::Zero(n, n), dv = dq;
    const auto at = [&](int body) {
      return S::kDof * static_cast<int>(std::find(bodies.begin(), bodies.end(), body) - bodies.begin());
    };
    one.external_tangents(state.t, state.m, [&](int i, int j, const S::Mat& q, const S::Mat& v) {
      dq.block<3, 3>(at(i), at(j)) += q;
      dv.block<3, 3>(at(i), at(j)) += v;
    });
    Eigen::VectorXd steps_q(n), steps_v(n);
    for (int c = 0; c < n; ++c) {
      const bool turn = c % S::kDof == 2;
      steps_q[c] = 1e-3 * (turn ? std::min(1.0, length / state.length) : length);
      steps_v[c] = 1e-3 * state.speed / (turn ? state.length : 1);
    }
    const double size = here.cwiseAbs().maxCoeff();
    const auto curve = [&](int c, double s) { return force(one, state, bodies, s * Eigen::VectorXd::Unit(2 * n, c)); };
    by_position_.slopes(dq, curve, steps_q, 1e-3 * size / state.length, place);
    by_velocity_.slopes(
        dv, [&](int c, double s) { return curve(n + c, s); }, steps_v, 1e-3 * size / state.speed, place);
  }
  void report(CheckBattery& battery) const {
    battery.items.push_back(by_position_.item());
    battery.items.push_back(by_velocity_.item());
  }

 private:
  static Eigen::VectorXd force(const System& one, const CheckState& state, const std::vector<int>& bodies,
                               const Eigen::VectorXd& d) {
    std::vector<S::Motion> m = state.m;
    const int n = S::kDof * static_cast<int>(bodies.size());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const int i = bodies[b], k = S::kDof * static_cast<int>(b);
      m[i] = S::Motion::of(state.q[i] + d.segment<3>(k), state.v[i] + d.segment<3>(n + k));
    }
    Vecs Q;
    one.external(state.t, m, Q);
    Eigen::VectorXd out(n);
    for (std::size_t b = 0; b < bodies.size(); ++b) out.segment<3>(S::kDof * static_cast<int>(b)) = Q[bodies[b]];
    return out;
  }

  Comparisons by_position_{"load derivatives, position", kSlopeTolerance}, by_velocity_{"load derivatives, velocity", kSlopeTolerance};
};

// The input values of an effort expression.
std::vector<double> signal_values(const System& system, const LoadData& load, const CheckState& state) {
  std::vector<double> values;
  for (const Signal& signal : load.signals) {
    if (signal.is_time) {
      values.push_back(state.t);
      continue;
    }
    const RelativePose pose = system.pose(signal.at, state.m);
    values.push_back(signal.rate ? pose.rate[signal.component] : pose.z[signal.component]);
  }
  return values;
}

void expression_slopes(const Expression& law, const std::vector<double>& at, const CheckPlace& place,
                       Comparisons& tally) {
  std::vector<double> gradient(at.size());
  const double value = law.gradient(at, gradient);
  if (!std::isfinite(value)) return;  // counted by the finiteness check
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto curve = [&](double s) -> Eigen::VectorXd {
      std::vector<double> moved = at;
      moved[i] += s;
      return Eigen::VectorXd::Constant(1, law.value(moved));
    };
    const double size = std::max(std::abs(at[i]), 1e-2);
    tally.slope(Eigen::VectorXd::Constant(1, gradient[i]), curve, 1e-3 * size, 1e-3 * std::abs(value) / size, place);
  }
}

// A function of t that a driven component follows: first and second derivative.
void target_slopes(const Expression& target, double t, double duration, const CheckPlace& place, Comparisons& tally) {
  if (target.variables().empty()) return;
  const auto at = [&target](double time) { return target.second_order(std::array<double, 1>{time}, 0); };
  const auto here = at(t);
  for (const int order : {0, 1})
    tally.slope(
        Eigen::VectorXd::Constant(1, here[order + 1]),
        [&](double s) -> Eigen::VectorXd { return Eigen::VectorXd::Constant(1, at(t + s)[order]); }, 1e-3 * duration,
        1e-3 * std::abs(here[order]) / duration, place);
}

// Is a function of t finite over the whole run?
void finite_over_time(const Expression& e, double duration, const CheckPlace& place, Comparisons& tally) {
  constexpr int kInstants = 101;
  double wrong = 0;
  for (int i = 0; i < kInstants; ++i) {
    const std::array<double, 1> t{duration * i / (kInstants - 1)};
    if (!std::isfinite(e.value(std::span(t).first(e.variables().size())))) wrong = 1;
  }
  tally.vanishes(wrong, 1, place);
}

}  // namespace

void check_load_slopes(const System& system, const std::vector<CheckState>& states, CheckBattery& battery) {
  LoadSlopes slopes;
  const long work =
      static_cast<long>(system.n_bodies()) * static_cast<long>(system.loads.size() + system.applied.size());
  const System bodies = weightless(system);
  std::vector<CheckLink> links = check_links(system);
  links.erase(links.begin(), links.begin() + system.n_joints());
  for (const CheckState& state : states) {
    if (work > kMaxLoadWork) break;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const LoadData& load = system.loads[i];
      const double length = link_steps(links[i], system.pose(load.at, state.m), state.length).length * 1e3;
      if (!(length > 1e-9)) continue;  // two coincident points have no direction
      slopes.look(with_load(bodies, load), state, bodies_of(load), {links[i].kind, load.name, state.number}, length);
    }
    for (const AppliedData& force : system.applied)
      slopes.look(with_load(bodies, force), state, {force.body}, {"force", force.name, state.number}, state.length);
  }
  slopes.report(battery);
}

void check_expressions(const System& system, const std::vector<CheckState>& states, double duration,
                       CheckBattery& battery) {
  Comparisons slopes("derivatives of expressions", kSlopeTolerance), finite("expressions finite over the run", 0);
  for (const CheckState& state : states) {
    for (const LoadData& load : system.loads) {
      if (load.kind != LoadKind::kEffort) continue;
      const auto values = signal_values(system, load, state);
      const CheckPlace place{load.applied ? "force" : "motor", load.name, state.number};
      expression_slopes(load.law, values, place, slopes);
      finite.vanishes(std::isfinite(load.law.value(values)) ? 0 : 1, 1, place);
    }
    for (const JointData& joint : system.joints)
      if (joint.driven >= 0) target_slopes(joint.target, state.t, duration, {joint.servo >= 0 ? "motor" : "joint", joint.name, state.number}, slopes);
  }
  for (const JointData& joint : system.joints)
    if (joint.driven >= 0) finite_over_time(joint.target, duration, {joint.servo >= 0 ? "motor" : "joint", joint.name, 0}, finite);
  for (const AppliedData& force : system.applied)
    for (const Expression* e : {&force.fx, &force.fy, &force.torque})
      finite_over_time(*e, duration, {"force", force.name, 0}, finite);
  battery.items.push_back(slopes.item());
  battery.items.push_back(finite.item());
}

}  // namespace pintle

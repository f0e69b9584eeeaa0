// The whole mechanism: the Jacobian of all forces along a few directions, and the balance of all powers.
#include <algorithm>
#include <cmath>

#include "check/check_batteries.h"
#include "check/check_differences.h"

namespace pintle {
namespace {

using S = Planar;

// All forces at (q + s dq, v + s dv), with t fixed.
class Forces {
 public:
  Forces(const System& system, const CheckState& state, const Vecs& dq, const Vecs& dv)
      : system_(system), state_(state), dq_(dq), dv_(dv), q_(dq.size()), v_(dq.size()) {}

  Eigen::VectorXd at(double s) {
    for (std::size_t i = 0; i < q_.size(); ++i) {
      q_[i] = state_.q[i] + s * dq_[i];
      v_[i] = state_.v[i] + s * dv_[i];
    }
    system_.motions(q_, v_, m_);
    system_.external(state_.t, m_, Q_);
    for (int j = 0; j < system_.n_joints(); ++j) {
      const JointKinematics r = system_.kinematics(j, state_.t, m_);
      add_force(system_.joints[j].at, r, respond(system_.joints[j].law, r.gap, r.rate).force, Q_);
    }
    return flat(Q_);
  }

  // The Jacobian times the direction.
  Eigen::VectorXd slope() const {
    Vecs out(dq_.size(), S::Vec::Zero());
    for (int j = 0; j < system_.n_joints(); ++j) add_joint(j, out);
    system_.external_tangents(
        state_.t, state_.m, [&](int i, int j, const S::Mat& q, const S::Mat& v) { out[i] += q * dq_[j] + v * dv_[j]; });
    return flat(out);
  }

 private:
  static Eigen::VectorXd flat(const Vecs& x) {
    Eigen::VectorXd out(S::kDof * static_cast<int>(x.size()));
    for (std::size_t i = 0; i < x.size(); ++i) out.segment<3>(S::kDof * static_cast<int>(i)) = x[i];
    return out;
  }

  void add_joint(int j, Vecs& out) const {
    const JointData& joint = system_.joints[j];
    const int a = joint.at.a, b = joint.at.b;
    const RelativePose pose = system_.pose(joint.at, state_.m);
    const JointKinematics r = system_.kinematics(j, state_.t, state_.m);
    const Response law = respond(joint.law, r.gap, r.rate);
    Eigen::Matrix<double, 6, 1> q = Eigen::Matrix<double, 6, 1>::Zero(), v = q;
    if (a != kGround) q.head<3>() = dq_[a], v.head<3>() = dv_[a];
    if (b != kGround) q.tail<3>() = dq_[b], v.tail<3>() = dv_[b];
    Eigen::Matrix<double, 3, 6> G;
    G << r.GA(), r.GB();
    const auto slope =
        rate_gradient(joint.displacement, pose, motion_of(a, state_.m), motion_of(b, state_.m));
    const S::Vec df = -(law.stiffness * (G * q) + law.damping * (slope * q + G * v));
    const Eigen::Matrix<double, 6, 1> dQ = geometric_stiffness(joint.displacement, pose, law.force) * q + G.transpose() * df;
    if (a != kGround) out[a] += dQ.head<3>();
    if (b != kGround) out[b] += dQ.tail<3>();
  }

  const System& system_;
  const CheckState& state_;
  const Vecs &dq_, &dv_;
  Vecs q_, v_, Q_;
  std::vector<S::Motion> m_;
};

double shortest_step(const System& system, const CheckState& state) {
  double shortest = 1;
  for (const CheckLink& link : check_links(system)) {
    const LinkSteps steps = link_steps(link, system.pose(link.at, state.m), state.length);
    if (steps.length > 1e-12) shortest = std::min({shortest, steps.length / state.length, steps.angle});
  }
  return shortest;  // for motions of the size of the mechanism
}

// All powers at a state, and the energy that motion at constant velocity would store.
class PowerAccount {
 public:
  PowerAccount(const System& system, const CheckState& state) : system_(system), state_(state) {}

  // The slope that the stored energy should have: the power of the forces and drives minus the losses.
  double expected(double& size) const {
    const ExternalWork work = system_.external_work(state_.t, state_.q, state_.m);
    Vecs Q;
    system_.external(state_.t, state_.m, Q);
    double power = work.supplied - work.lost;
    size = std::abs(work.supplied) + work.lost;
    for (int i = 0; i < system_.n_bodies(); ++i) {
      power -= Q[i].dot(state_.v[i]);
      size += Q[i].cwiseAbs().dot(state_.v[i].cwiseAbs());
    }
    std::vector<S::Motion> at_rest;
    system_.motions(state_.q, Vecs(state_.v.size(), S::Vec::Zero()), at_rest);
    for (int j = 0; j < system_.n_joints(); ++j) {
      const JointKinematics r = system_.kinematics(j, state_.t, state_.m);
      const Placement& at = system_.joints[j].at;
      const Response law = respond(system_.joints[j].law, r.gap, r.rate);
      double on_bodies = 0;
      if (at.a != kGround) on_bodies += (r.GA().transpose() * law.force).dot(state_.v[at.a]);
      if (at.b != kGround) on_bodies += (r.GB().transpose() * law.force).dot(state_.v[at.b]);
      const double drive = -law.force.dot(system_.kinematics(j, state_.t, at_rest).rate);  // a servo's target moves
      power += -on_bodies + drive - law.loss;
      size += std::abs(on_bodies) + std::abs(drive) + law.loss;
    }
    return power;
  }

  // The sum of the terms of `stored` without their signs [J].
  double magnitude() const {
    double sum = std::abs(stored(0));
    for (int i = 0; i < system_.n_bodies(); ++i) sum += std::abs(system_.bodies[i].gravity.dot(state_.q[i]));
    return sum;
  }

  double stored(double dt) const {
    Vecs q = state_.q;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] += dt * state_.v[i];
    std::vector<S::Motion> m;
    system_.motions(q, state_.v, m);
    double sum = system_.external_work(state_.t, q, m).potential;
    for (int j = 0; j < system_.n_joints(); ++j)
      sum += respond(system_.joints[j].law, system_.kinematics(j, state_.t + dt, m).gap, S::Vec::Zero()).energy;
    return sum;
  }

 private:
  const System& system_;
  const CheckState& state_;
};

System without_joint_forces(System system) {
  for (JointData& joint : system.joints) joint.law = LinearLaw{};
  return system;
}

}  // namespace

void check_whole_slopes(const System& system, const std::vector<CheckState>& states, CheckBattery& battery) {
  Comparisons whole("directional derivative of all forces", kSlopeTolerance);
  for (const CheckState& state : states) {
    const double step = shortest_step(system, state);
    for (unsigned direction = 0; direction < 3; ++direction) {
      Noise noise(500 + 10 * static_cast<unsigned>(state.number) + direction);
      Vecs dq(state.q.size()), dv(state.q.size());
      for (std::size_t i = 0; i < dq.size(); ++i) {
        dq[i] = noise.vec().cwiseProduct(S::Vec(state.length, state.length, 1));
        dv[i] = state.speed * noise.vec().cwiseProduct(S::Vec(1, 1, 1 / state.length));
      }
      Forces forces(system, state, dq, dv);
      whole.slope(forces.slope(), [&forces](double s) { return forces.at(s); }, step, 0,
                  {"whole mechanism", "", state.number});
    }
  }
  battery.items.push_back(whole.item());
}

void check_power_account(const System& system, const std::vector<CheckState>& states, CheckBattery& battery) {
  constexpr double kRounding = 1e-8;  // as a fraction of the energies, with a margin: differences cannot resolve less
  Comparisons account("power balance of the mechanism", kSlopeTolerance);
  const System loads_alone = without_joint_forces(system);  // joint forces of disturbed states would swamp the others
  for (const CheckState& state : states) {
    for (const System* part : {&system, &loads_alone}) {
      const PowerAccount powers(*part, state);
      double size = 0;
      const double expected = powers.expected(size);
      const double dt = shortest_step(system, state) * state.length / state.speed;
      size += kRounding * powers.magnitude() / dt;
      account.slope(Eigen::VectorXd::Constant(1, expected),
                    [&](double s) -> Eigen::VectorXd { return Eigen::VectorXd::Constant(1, powers.stored(s)); }, dt,
                    size, {part == &system ? "whole mechanism" : "all loads", "", state.number});
    }
  }
  battery.items.push_back(account.item());
}

}  // namespace pintle

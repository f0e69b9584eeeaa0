#include "integrators/start_states_for_tests.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/general/dopri5.h"

namespace pintle::sample {

State plain_start(const Model& model, const System& system) {
  State state;
  for (const Body& body : model.bodies) {
    const Vec2 p = body.position.value_or(Vec2{0, 0}), v = body.velocity.value_or(Vec2{0, 0});
    state.q.emplace_back(p[0], p[1], body.angle.value_or(0));
    state.v.emplace_back(v[0], v[1], body.spin.value_or(0));
  }
  state.a.assign(system.bodies.size(), Planar::Vec::Zero());
  state.gap = state.gap_rate = state.gap_accel = state.force = Vecs(system.joints.size(), Planar::Vec::Zero());
  Dopri5(system, 1).complete(state);
  return state;
}

DenseEquations::DenseEquations(const System& system, double t, const Vecs& q, const Vecs& v) {
  std::vector<Planar::Motion> m;
  system.motions(q, v, m);
  Vecs external;
  system.external(t, m, external);
  const int n = 3 * system.n_bodies();
  mass.resize(n);
  Q.resize(n);
  for (int i = 0; i < system.n_bodies(); ++i) {
    mass.segment<3>(3 * i) = system.bodies[i].mass;
    Q.segment<3>(3 * i) = external[i];
  }
  for (int j = 0; j < system.n_joints(); ++j) {
    const Planar::Mat K = respond(system.joints[j].law, Planar::Vec::Zero(), Planar::Vec::Zero()).stiffness;
    for (int k = 0; k < 3; ++k)
      if (K(k, k) > 0) rows.emplace_back(j, k);
  }
  G = Eigen::MatrixXd::Zero(static_cast<int>(rows.size()), n);
  bias.resize(static_cast<int>(rows.size()));
  for (int r = 0; r < G.rows(); ++r) {
    const auto [j, k] = rows[r];
    const JointKinematics kinematics = system.kinematics(j, t, m);
    const Placement& at = system.joints[j].at;
    if (at.a != kGround) G.block<1, 3>(r, 3 * at.a) = kinematics.GA().row(k);
    if (at.b != kGround) G.block<1, 3>(r, 3 * at.b) = kinematics.GB().row(k);
    bias[r] = kinematics.bias[k];
  }
}

Eigen::VectorXd DenseEquations::reactions() const {
  const Eigen::MatrixXd GM = G * mass.cwiseInverse().asDiagonal();
  return (GM * G.transpose()).ldlt().solve(-(GM * Q + bias));
}

State loaded_start(const Model& model, const System& system) {
  State state = plain_start(model, system);
  for (int pass = 0; pass < 5; ++pass) {
    const DenseEquations e(system, state.t, state.q, state.v);
    const Eigen::VectorXd f = e.reactions();
    Eigen::VectorXd misfit(f.size());
    std::vector<Planar::Motion> m;
    system.motions(state.q, state.v, m);
    for (int r = 0; r < f.size(); ++r) {
      const auto [j, k] = e.rows[r];
      misfit[r] = -f[r] / system.joints[j].law.as_linear()->k[k] - system.kinematics(j, state.t, m).gap[k];
    }
    const Eigen::MatrixXd MG = e.mass.cwiseInverse().asDiagonal() * e.G.transpose();
    const Eigen::VectorXd move = MG * (e.G * MG).ldlt().solve(misfit);
    for (std::size_t i = 0; i < state.q.size(); ++i) state.q[i] += move.segment<3>(3 * static_cast<int>(i));
  }
  Dopri5(system, 1).complete(state);
  return state;
}

Model oscillator() {
  Model model;
  model.gravity = {0, 0};
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {body("mass", 2, 1, {{"C", {0, 0}, 0}})};
  put_at(model.bodies[0], 1.5, 0, 0);
  model.springs = {spring("S", false, {"ground", "O"}, {"mass", "C"}, 50, 0)};
  model.springs[0].free_length = 1;
  AppliedForce drive;
  drive.name = "F";
  drive.on = {"mass", "C"};
  drive.force = {expression("3*cos(7*t)"), Expression::constant(0)};
  model.forces = {drive};
  return model;
}

std::array<double, 2> oscillator_at(double t) {
  const double w = 5, drive = 7, u = 3.0 / 2 / (w * w - drive * drive);
  return {1 + (0.5 - u) * std::cos(w * t) + u * std::cos(drive * t), -(0.5 - u) * w * std::sin(w * t) - u * drive * std::sin(drive * t)};
}

State settled_start(const Model& model, const System& system, double t) {
  RadauStepper stepper(system, 1e-10);
  stepper.start(loaded_start(model, system), 1e-5);
  while (stepper.state().t < t)
    if (!stepper.step(t)) throw std::runtime_error(stepper.failure());
  return stepper.state();
}

State follow(const System& system, const State& from, double duration, int n, int stages) {
  RadauStepper stepper(system, 1e-11, stages);
  stepper.start(from, duration / n);
  for (int i = 0; i < n; ++i)
    if (!stepper.trial(duration / n)) throw std::runtime_error("the stage equations were not solved");
  return stepper.state();
}

StageTails room_for_tails(const System& system) {
  return {std::vector<RowOf4<Planar>>(system.bodies.size()), std::vector<RowOf4<Planar>>(system.joints.size())};
}

double largest_difference(const Vecs& a, const Vecs& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).cwiseAbs().maxCoeff());
  return largest;
}

double measured_order(const std::vector<double>& errors) {
  double order = 1e9;
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) order = std::min(order, std::log2(errors[i] / errors[i + 1]));
  return order;
}

}  // namespace pintle::sample

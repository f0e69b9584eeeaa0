// The step's stability where geometric stiffness dominates: two bars in line between two pins that pull, or push while a servo keeps
// them straight. Over steps from a sixth of the period due to the force to 160 of them, and with joints from five times to a thousand
// times as fast as that. theory/time section 4.1.
#include <gtest/gtest.h>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

// Bars of 1 m and 1 kg in line along x between two pins, with joints of k [N/m] and c [N s/m] under `force` [N]: a tension where
// positive. The middle pin is off the line by `off`.
Model bars_in_line(double k, double c, double force, double off) {
  const double stretch = force / k;
  Model model;
  model.gravity = {0, 0};
  model.ground = {{"O", {0, 0}, 0}, {"P", {2 + 3 * stretch, 0}, 0}};
  for (const char* name : {"left", "right"}) model.bodies.push_back(sample::body(name, 1, 1.0 / 12, {{"A", {-0.5, 0}, 0}, {"B", {0.5, 0}, 0}}));
  sample::put_at(model.bodies[0], 0.5 + stretch, 0.5 * off, off);
  sample::put_at(model.bodies[1], 1.5 + 2 * stretch, 0.5 * off, -off);
  for (const auto& [name, first, second] : {std::tuple("O", MarkerRef{"ground", "O"}, MarkerRef{"left", "A"}), std::tuple("M", MarkerRef{"left", "B"}, MarkerRef{"right", "A"}),
                                            std::tuple("P", MarkerRef{"ground", "P"}, MarkerRef{"right", "B"})})
    model.joints.push_back(sample::joint(name, "revolute", first, second, k, c));
  if (force > 0) return model;
  model.motors = {sample::motor("straight", "M", MotorKind::kPosition, sample::expression("0"))};
  model.motors[0].stiffness = -2 * force;
  model.motors[0].damping = 0;
  return model;
}

constexpr double kOff = 1e-9;
constexpr int kSteps = 60;

// The largest values over steps of 1 s: how far the bars are out of line, including what their speed would lead to, over the initial value;
// and the error of the joints' forces against what the pins require, over that. Fixed steps are tried until one is not solved.
struct Growth {
  double motion = 0, force = 0;
  int steps = 0;
};

// Frequencies relative to that of the step: the one due to the force, and that of a bar on its joints.
struct Ratios {
  double pull, joints, damping;
};

Growth growth(const Ratios& ratio, double sign, double tolerance, int stages) {
  const double force = sign * ratio.pull * ratio.pull / 3;
  const Model model = bars_in_line(ratio.joints * ratio.joints, 2 * ratio.damping * ratio.joints, force, kOff);
  const System system = build_system(model);
  RadauStepper stepper(system, tolerance, stages);
  stepper.start(sample::plain_start(model, system), 1);
  Growth g;
  for (; g.steps < kSteps && stepper.trial(1); ++g.steps) {
    const State& state = stepper.state();
    const double held = sign > 0 ? force : -3 * force;  // stiffness that keeps a bar straight [N*m/rad]
    double energy = 0;
    for (int b = 0; b < 2; ++b) energy += held * std::pow(state.q[b][2], 2) + state.v[b].cwiseProduct(system.bodies[b].mass).dot(state.v[b]);
    g.motion = std::max(g.motion, std::sqrt(energy / (2 * held)) / kOff);
    for (int j = 0; j < 3; ++j) g.force = std::max(g.force, std::abs(state.force[j].head<2>().norm() / std::abs(force) - 1));
  }
  return g;
}

template <class Check>
void over_taut_ratios(Check check) {
  for (const double pull : {1.0, 3.0, 10.0, 30.0, 100.0, 1000.0})
    for (const double stiffer : {5.0, 10.0, 30.0, 100.0, 1000.0})
      for (const double damping : {0.0, 0.1, 1.0, 10.0}) check(Ratios{pull, stiffer * pull, damping});
}

std::string ratio_words(const Ratios& r, double sign, int stages) {
  return (sign > 0 ? "pulled, " : "pushed, ") + std::to_string(stages) + " stages, " + std::to_string(r.pull) + ", " + std::to_string(r.joints) + ", " + std::to_string(r.damping);
}

// Equations solved to rounding: the step's own growth.
TEST(TautSteps, NothingGrows) {
  for (const int stages : {3, 5})
    for (const double sign : {1.0, -1.0})
      over_taut_ratios([&](const Ratios& ratio) {
        const Growth g = growth(ratio, sign, 1e-12, stages);
        EXPECT_LT(g.motion, 1 + 1e-6) << ratio_words(ratio, sign, stages);
        EXPECT_LT(g.force, 1e-6) << ratio_words(ratio, sign, stages);
      });
}

// Solved to a tolerance with which runs begin, steps leave accelerations across the bars that are small compared with the force but
// move the bars far within a long step. The bars must stay within what one step leaves, and so must the forces. Measured: 2e-5 rad
// and 2e-7 of the force; without (4.7) 3e6 rad and 1e23 times the force.
TEST(TautSteps, WhatTheToleranceLeavesDoesNotGrow) {
  int steps = 0, most = 0;
  for (const int stages : {3, 5})
    for (const double sign : {1.0, -1.0})
      over_taut_ratios([&](const Ratios& ratio) {
        const Growth g = growth(ratio, sign, 1e-4, stages);
        steps += g.steps;
        most += kSteps;
        EXPECT_LT(g.motion * kOff, 1e-4) << ratio_words(ratio, sign, stages);
        EXPECT_LT(g.force, 1e-5) << ratio_words(ratio, sign, stages);
      });
  EXPECT_GT(steps, 0.85 * most);  // nearly all are solved
}

}  // namespace
}  // namespace pintle

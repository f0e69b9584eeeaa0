// The implicit method: its order in positions, velocities AND joint forces, from soft to rigid; known solutions; step
// counts that do not grow with stiffness; the energy account; failures that say where they are.
#include "integrators/absolute/radau_stepper.h"

#include <gtest/gtest.h>

#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

using sample::follow;
using sample::largest_difference;
using sample::measured_order;

// Damping of the fast vibration in proportion to the stiffness: 3000 N s/m at 1e8 N/m.
double matching_damping(double k) { return 3000 * std::sqrt(k / 1e8); }

struct Errors {
  std::vector<double> q, v, force;
};

// Errors after `duration` with the given numbers of equal steps, against 512 of three stages.
Errors errors_of_fixed_steps(const Model& model, double duration, std::initializer_list<int> counts, int stages = 3) {
  const System system = build_system(model);
  const State start = sample::settled_start(model, system, 0.05);
  const State reference = follow(system, start, duration, 512);
  Errors errors;
  for (const int n : counts) {
    const State end = follow(system, start, duration, n, stages);
    errors.q.push_back(largest_difference(end.q, reference.q));
    errors.v.push_back(largest_difference(end.v, reference.v));
    errors.force.push_back(largest_difference(end.force, reference.force));
  }
  return errors;
}

TEST(RadauStepper, IsOfOrderFiveOrNineWithoutJoints) {
  const Model model = sample::oscillator();
  const System system = build_system(model);
  const auto order = [&](int stages, std::initializer_list<int> counts) {
    std::vector<double> errors;
    for (const int n : counts) {
      const State end = follow(system, sample::plain_start(model, system), 2, n, stages);
      const auto [x, v] = sample::oscillator_at(2);
      errors.push_back(std::hypot(end.q[0][0] - x, (end.v[0][0] - v) / 5));
    }
    return measured_order(errors);
  };
  EXPECT_GT(order(3, {20, 40, 80}), 4.7);
  EXPECT_GT(order(5, {4, 8, 16}), 8);
}

// Measured: order 9.5 in positions, at rounding after 16 steps; the forces after 8 steps are within 3e-11 N of 25 N.
TEST(RadauStepper, FiveStagesReachForcesThatThreeDoNot) {
  for (const double k : {1e10, 1e12}) {
    const Errors e = errors_of_fixed_steps(sample::pendulum(k, matching_damping(k)), 0.4, {7, 10}, 5);
    EXPECT_LT(e.q.back(), e.q.front() * std::pow(7.0 / 10, 8)) << k;
    EXPECT_LT(e.force.back(), 1e-9) << k;
  }
  EXPECT_LT(errors_of_fixed_steps(sample::four_bar(1e12, matching_damping(1e12)), 0.1, {8}, 5).force.front(), 2e-8);
}

// Measured: 4.9 in motion; in force 4.9 from 1e10 N/m on, 4.0 at 1e8 N/m, where the step nears the vibration's period.
TEST(RadauStepper, PendulumForcesConvergeLikeItsMotion) {
  for (const double k : {1e8, 1e10, 1e12}) {
    const Errors e = errors_of_fixed_steps(sample::pendulum(k, matching_damping(k)), 0.4, {16, 32});
    EXPECT_GT(measured_order(e.q), 4.5) << k;
    EXPECT_GT(measured_order(e.v), 4.5) << k;
    EXPECT_GT(measured_order(e.force), k < 1e9 ? 3.5 : 4.5) << k;
    EXPECT_LT(e.force.front(), 1e-6) << k;  // of about 25 N, with steps of 25 ms
  }
}

// Rigid four-bar: order 5 in the forces as well. Soft (1e6 N/m): every vibration is resolved, the same order.
TEST(RadauStepper, FourBarForcesConvergeWithOrderFiveSoftAndRigid) {
  const Errors rigid = errors_of_fixed_steps(sample::four_bar(1e12, matching_damping(1e12)), 0.1, {8, 16});
  EXPECT_GT(measured_order(rigid.force), 4);
  EXPECT_LT(rigid.force.front(), 2e-6);  // of about 500 N; 32 steps are at rounding, 2e-9 N
  const Errors soft = errors_of_fixed_steps(sample::four_bar(1e6, matching_damping(1e6)), 0.1, {16, 32, 64});
  EXPECT_GT(measured_order(soft.q), 4.3);
  EXPECT_GT(measured_order(soft.force), 4.3);
}

// In between (1e8, 1e10 N/m) the error has no clean order; it is small at any step.
TEST(RadauStepper, FourBarForcesAreAccurateInBetween) {
  for (const double k : {1e8, 1e10}) {
    const Errors e = errors_of_fixed_steps(sample::four_bar(k, matching_damping(k)), 0.1, {16, 32});
    for (const double error : e.force) EXPECT_LT(error, 1e-4) << k;
    for (const double error : e.q) EXPECT_LT(error, 1e-9) << k;
  }
}

// Two explicit runs of the same equations agree on these to 2e-7 N; g = 9.81, zero stretch at the start (paper, section 7).
TEST(RadauStepper, PendulumOnACompliantPinIsTheKnownOne) {
  struct Known {
    double k, c, x, y, fx, fy;
  };
  for (const Known& known : {Known{1e6, 500, -0.04508905804234097, -0.49798735698856916, 1.982308636858221, 24.345643436112493},
                             Known{2e8, 3500, -0.04511447664623682, -0.49796064716271976, 1.983454827723552, 24.345302683940666}}) {
    const Model model = sample::pendulum(known.k, known.c);
    const System system = build_system(model);
    for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
      RadauStepper stepper(system, tolerance);
      stepper.start(sample::plain_start(model, system), 1e-5);
      while (stepper.state().t < 0.5) ASSERT_TRUE(stepper.step(0.5)) << stepper.failure();
      const State& end = stepper.state();
      EXPECT_EQ(end.t, 0.5);
      EXPECT_NEAR(end.q[0][0], known.x, 0.5 * tolerance + 1e-10);
      EXPECT_NEAR(end.q[0][1], known.y, 0.5 * tolerance + 1e-10);
      // The peak is 24 N. One pass alone comes to within four times its tolerance, or 2e-6 N at 1e6 N/m.
      EXPECT_NEAR(end.force[0][0], known.fx, 4 * 24 * tolerance + 2e-6) << known.k << " " << tolerance;
      EXPECT_NEAR(end.force[0][1], known.fy, 4 * 24 * tolerance + 2e-6) << known.k << " " << tolerance;
    }
  }
}

struct Count {
  std::uint64_t steps, newton;
};
Count count_to(double end, const System& system, const State& start, double tolerance) {
  RadauStepper stepper(system, tolerance);
  stepper.start(start, 1e-3);
  while (stepper.state().t < end) EXPECT_TRUE(stepper.step(end)) << stepper.failure();
  return {stepper.counters().steps, stepper.counters().newton_iterations};
}

// Half a second of the four-bar, about 0.8 turns of the crank. Measured: 38 steps, 162 to 171 iterations.
TEST(RadauStepper, StepsDoNotGrowWithStiffness) {
  for (const double k : {1e8, 1e9, 1e10, 1e11, 1e12}) {
    const Model model = sample::four_bar(k, matching_damping(k));
    const System system = build_system(model);
    const Count count = count_to(0.6, system, sample::settled_start(model, system, 0.1), 1e-5);
    EXPECT_LE(count.steps, 45u) << k;
    EXPECT_LE(count.newton, 210u) << k;
  }
}

// Soft joints still ring after 0.1 s, at 1000 to 4000 rad/s, and this is resolved. Measured: 275 and 100 steps.
TEST(RadauStepper, VibrationOfSoftJointsIsFollowed) {
  for (const double k : {1e6, 1e7}) {
    const Model model = sample::four_bar(k, matching_damping(k));
    const System system = build_system(model);
    EXPECT_LE(count_to(0.6, system, sample::settled_start(model, system, 0.1), 1e-5).steps, 330u) << k;
  }
}

// From a start whose gap rates are not yet those of the motion, with c = 3000 N s/m at every stiffness: the vibration that
// this excites has an amplitude of sqrt(m / k) times the rate of the forces, and is below the tolerance at 1e11 N/m. At
// larger amplitudes its decay is resolved. Measured: 112 to 546 steps, then 41 to 43.
TEST(RadauStepper, VibrationBelowTheToleranceCostsNothing) {
  for (const double k : {1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12}) {
    const Model model = sample::four_bar(k, 3000);
    const System system = build_system(model);
    EXPECT_LE(count_to(0.6, system, sample::loaded_start(model, system), 1e-5).steps, k < 5e10 ? 650u : 50u) << k;
  }
}

TEST(RadauStepper, TrialStepsBackwardsReturn) {
  const Model model = sample::four_bar(1e10, matching_damping(1e10));
  const System system = build_system(model);
  const State start = sample::settled_start(model, system, 0.1);
  RadauStepper stepper(system, 1e-11);
  stepper.start(start, 1e-3);
  ASSERT_TRUE(stepper.trial(1e-3));
  ASSERT_TRUE(stepper.trial(-1e-3));
  EXPECT_NEAR(stepper.state().t, start.t, 1e-15);
  EXPECT_LT(largest_difference(stepper.state().q, start.q), 1e-12);
  EXPECT_LT(largest_difference(stepper.state().v, start.v), 1e-9);
}

double total_energy(const System& system, const State& s) {
  std::vector<Planar::Motion> m;
  system.motions(s.q, s.v, m);
  double sum = system.kinetic(s.v) + system.external_work(s.t, s.q, m).potential + s.dissipated - s.supplied;
  for (int j = 0; j < system.n_joints(); ++j)
    if (system.joints[j].servo < 0) sum += respond(system.joints[j].law, s.gap[j], s.gap_rate[j]).energy;
  return sum;
}

TEST(RadauStepper, ClosesItsEnergyAccount) {
  Model driven = sample::pendulum(1e8, 3000);
  driven.motors = {sample::motor("M", "pin", MotorKind::kEffort, sample::expression("4*cos(6*t) - 0.3*rate", {"t", "rate"}))};
  driven.springs = {sample::spring("T", true, {"ground", "O"}, {"rod", "O"}, 8, 0.7)};
  driven.springs[0].free_length = 0.3;
  for (const Model& model : {sample::pendulum(1e8, 3000), driven}) {
    const System system = build_system(model);
    RadauStepper stepper(system, 1e-8);
    stepper.start(sample::settled_start(model, system, 0.05), 1e-3);
    const double before = total_energy(system, stepper.state());
    while (stepper.state().t < 1) {
      ASSERT_TRUE(stepper.step(1));
      EXPECT_NEAR(total_energy(system, stepper.state()), before, 1e-6);  // of some joules
    }
    if (!model.motors.empty()) {
      EXPECT_GT(stepper.state().dissipated, 0.1);
      EXPECT_GT(std::abs(stepper.state().supplied), 0.1);
    }
  }
}

// The carried gaps are those of the positions, whatever the step; their rates differ from those of the velocities by an amount
// that moves no position within a step; and the forces are those of the law to the tolerance.
TEST(RadauStepper, CarriedGapsAreThoseOfThePositions) {
  const Model model = sample::four_bar(1e8, 3000);
  const System system = build_system(model);
  RadauStepper stepper(system, 1e-5);
  stepper.start(sample::loaded_start(model, system), 1e-4);
  std::vector<Planar::Motion> m;
  double peak = 0;
  while (stepper.state().t < 0.6) {
    const double before = stepper.state().t;
    ASSERT_TRUE(stepper.step(0.6));
    const State& s = stepper.state();
    system.motions(s.q, s.v, m);
    for (const auto& f : s.force) peak = std::max(peak, f.head<2>().norm());
    for (int j = 0; j < system.n_joints(); ++j) {
      const JointKinematics r = system.kinematics(j, s.t, m);
      EXPECT_LT((r.gap - s.gap[j]).head<2>().norm(), 1e-13);
      EXPECT_LT((s.t - before) * (r.rate - s.gap_rate[j]).head<2>().norm(), 1e-13);
      EXPECT_LT((s.force[j] - system.joints[j].law.force({s.t, s.gap[j], s.gap_rate[j]})).head<2>().norm(), 1e-5 * peak);
    }
  }
}

// The accelerations of a start may not be those that its forces give. No step resolves that: it is detected, without small steps.
TEST(RadauStepper, AStartThatDoesNotFitCostsAFewTrials) {
  const Model model = sample::four_bar(1e8, 3000);
  const System system = build_system(model);
  State start = sample::settled_start(model, system, 0.05);
  for (auto& a : start.a) a *= 1 + 1e-5;
  RadauStepper stepper(system, 1e-8, 5);
  stepper.start(start, 1e-4);
  ASSERT_TRUE(stepper.step(0.1));
  EXPECT_GT(stepper.counters().rejected, 0u);
  EXPECT_LE(stepper.counters().rejected, 3u);
  EXPECT_GT(stepper.state().t - 0.05, 1e-5);
}

// Large mechanisms are processed in another memory order; mechanisms that do not touch do not affect each other.
TEST(RadauStepper, ManyMechanismsMoveLikeOne) {
  constexpr std::size_t kCopies = 400;  // 1200 bodies
  const Model one = sample::four_bar(1e8, 3000);
  Model many = one;
  for (std::size_t i = 1; i < kCopies; ++i) {
    const auto name = [i](std::string& of) {
      if (of != "ground") of += std::to_string(i);
    };
    for (Body body : one.bodies) {
      name(body.name);
      many.bodies.push_back(body);
    }
    for (Joint joint : one.joints) {
      for (std::string* of : {&joint.name, &joint.first.body, &joint.second.body}) name(*of);
      many.joints.push_back(joint);
    }
  }
  const System alone = build_system(one), together = build_system(many);
  const State start = sample::settled_start(one, alone, 0.05);
  State starts = start;
  for (Vecs State::*rows : {&State::q, &State::v, &State::a, &State::gap, &State::gap_rate, &State::gap_accel, &State::force})
    for (std::size_t i = 1; i < kCopies; ++i) (starts.*rows).insert((starts.*rows).end(), (start.*rows).begin(), (start.*rows).end());
  for (const int stages : {3, 5}) {
    const State end = follow(alone, start, 0.05, 8, stages), ends = follow(together, starts, 0.05, 8, stages);
    ASSERT_EQ(ends.q.size(), kCopies * end.q.size());
    double q = 0, force = 0;
    for (std::size_t i = 0; i < ends.q.size(); ++i) q = std::max(q, (ends.q[i] - end.q[i % end.q.size()]).norm());
    for (std::size_t i = 0; i < ends.force.size(); ++i) force = std::max(force, (ends.force[i] - end.force[i % end.force.size()]).norm());
    EXPECT_LT(q, 1e-13) << stages;
    EXPECT_LT(force, 1e-9 * largest_force(end.force)) << stages;
  }
}

TEST(RadauStepper, SameBitsEveryTime) {
  const Model model = sample::four_bar(1e8, 3000);
  const System system = build_system(model);
  const State start = sample::loaded_start(model, system);
  std::vector<State> ends;
  for (int i = 0; i < 2; ++i) {
    RadauStepper stepper(system, 1e-6);
    stepper.start(start, 1e-4);
    while (stepper.state().t < 0.2) ASSERT_TRUE(stepper.step(0.2));
    ends.push_back(stepper.state());
  }
  EXPECT_EQ(ends[0].q, ends[1].q);
  EXPECT_EQ(ends[0].force, ends[1].force);
}

TEST(RadauStepper, FailureSaysWhenAndWhere) {
  Model model = sample::pendulum(1e8, 3000);
  AppliedForce force;
  force.name = "F";
  force.on = {"rod", "O"};
  force.force = {sample::expression("sqrt(0.1 - t)"), Expression::constant(0)};  // not a number after 0.1 s
  model.forces = {force};
  const System system = build_system(model);
  RadauStepper stepper(system, 1e-5);
  stepper.start(sample::loaded_start(model, system), 1e-3);
  bool going = true;
  for (int i = 0; i < 10000 && going && stepper.state().t < 1; ++i) going = stepper.step(1);
  EXPECT_FALSE(going);
  EXPECT_LE(stepper.state().t, 0.1 + 1e-12);
  EXPECT_NE(stepper.failure().find("t = "), std::string::npos) << stepper.failure();
  EXPECT_NE(stepper.failure().find("force F is not finite"), std::string::npos) << stepper.failure();
}

}  // namespace
}  // namespace pintle

// States inside a step: they agree with those at its ends, and are as accurate as these in between.
#include "integrators/dense/dense_output.h"

#include <gtest/gtest.h>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

using sample::follow;
using sample::largest_difference;

// The data that the curves interpolate.
enum class Through { kEnds, kThreeNodes, kFiveNodes };
constexpr Through kNodes[] = {Through::kThreeNodes, Through::kFiveNodes};

// One step of h from a settled start.
struct OneStep {
  Through through;
  const System system;
  State start;
  RadauStepper stepper;
  DenseOutput dense;
  double h;

  OneStep(const Model& model, double step, Through curves)
      : through(curves), system(build_system(model)), start(sample::settled_start(model, system, 0.05)),
        stepper(system, 1e-10, curves == Through::kFiveNodes ? 5 : 3), dense(system), h(step) {
    stepper.start(start, h);
    EXPECT_TRUE(stepper.trial(h));
  }
  const State& at(double share) {
    const double t = start.t + share * h;
    if (through == Through::kEnds) return dense.at(t, stepper.previous(), stepper.state());
    return dense.at(t, stepper.previous(), stepper.state(), stepper.nodes());
  }
};

struct Interval {
  Model model;
  double step;
};
std::vector<Interval> cases() { return {{sample::pendulum(1e8, 3500), 0.05}, {sample::four_bar(1e8, 3000), 0.0125}, {sample::four_bar(1e11, 9e4), 0.0125}}; }

std::vector<std::pair<Interval, Through>> all_cases() {
  std::vector<std::pair<Interval, Through>> all;
  for (const Interval& c : cases())
    for (const Through through : kNodes) all.emplace_back(c, through);
  return all;
}

TEST(DenseOutput, MeetsTheEndsOfTheStep) {
  for (const auto& [c, through] : all_cases()) {
    OneStep step(c.model, c.step, through);
    EXPECT_EQ(step.at(0).q, step.start.q);
    EXPECT_EQ(step.dense.at(step.stepper.state().t, step.stepper.previous(), step.stepper.state()).force, step.stepper.state().force);
    const double size = largest_difference(step.start.force, Vecs(step.start.force.size(), Planar::Vec::Zero()));
    for (const double share : {1e-7, 1 - 1e-7}) {
      const State inside = step.at(share);
      const State& end = share < 0.5 ? step.start : step.stepper.state();
      EXPECT_LT(largest_difference(inside.q, end.q), 1e-7);
      EXPECT_LT(largest_difference(inside.v, end.v), 1e-6);
      EXPECT_LT(largest_difference(inside.force, end.force), 1e-6 * size);
      EXPECT_NEAR(inside.dissipated, end.dissipated, 1e-9);
      EXPECT_NEAR(inside.supplied, end.supplied, 1e-9);
    }
  }
}

// Measured orders of positions, velocities and forces inside steps.
struct Orders {
  double q, v, force;
};
Orders orders_inside(const Model& model, Through through, std::initializer_list<double> steps) {
  std::vector<double> q, v, force;
  for (const double h : steps) {
    OneStep step(model, h, through);
    double worst_q = 0, worst_v = 0, worst_force = 0;
    for (const double share : {0.25, 0.5, 0.75}) {
      const State reference = follow(step.system, step.start, share * h, 32);
      const State& inside = step.at(share);
      worst_q = std::max(worst_q, largest_difference(inside.q, reference.q));
      worst_v = std::max(worst_v, largest_difference(inside.v, reference.v));
      worst_force = std::max(worst_force, largest_difference(inside.force, reference.force));
    }
    q.push_back(worst_q);
    v.push_back(worst_v);
    force.push_back(worst_force);
  }
  return {sample::measured_order(q), sample::measured_order(v), sample::measured_order(force)};
}

TEST(DenseOutput, ConvergesInsideTheStep) {
  const Model pendulum = sample::pendulum(1e8, 3500);
  const Orders three = orders_inside(pendulum, Through::kThreeNodes, {0.05, 0.025, 0.0125});
  EXPECT_GT(three.q, 4.7);
  EXPECT_GT(three.v, 4);
  EXPECT_GT(three.force, 3.3);
  const Orders five = orders_inside(pendulum, Through::kFiveNodes, {0.1, 0.05});
  EXPECT_GT(five.q, 6);
  EXPECT_GT(five.v, 6);
  EXPECT_GT(five.force, 5);
}

// Steps that resolve the joint's vibration, as the explicit method takes them: the law's own force.
TEST(DenseOutput, ConvergesBetweenResolvedEnds) {
  const Orders ends = orders_inside(sample::pendulum(2e3, 5), Through::kEnds, {0.02, 0.01, 0.005});
  EXPECT_GT(ends.q, 5);
  EXPECT_GT(ends.v, 4.3);
  EXPECT_GT(ends.force, 4);
}

TEST(DenseOutput, ForcesInsideAreAsGoodAsAtTheEnds) {
  for (const auto& [c, through] : all_cases()) {
    OneStep step(c.model, c.step, through);
    const double size = largest_difference(step.start.force, Vecs(step.start.force.size(), Planar::Vec::Zero()));
    for (const double share : {0.1, 0.3, 0.6, 0.9}) {
      const State reference = follow(step.system, step.start, share * c.step, 32);
      EXPECT_LT(largest_difference(step.at(share).force, reference.force), 1e-5 * size) << share;
    }
  }
}

TEST(DenseOutput, InterpolatedVelocitiesLeaveTheGapsInPlace) {
  for (const auto& [c, through] : all_cases()) {
    OneStep step(c.model, c.step, through);
    const State& inside = step.at(0.4);
    std::vector<Planar::Motion> m;
    step.system.motions(inside.q, inside.v, m);
    for (int j = 0; j < step.system.n_joints(); ++j) {
      const JointKinematics r = step.system.kinematics(j, inside.t, m);
      EXPECT_LT((r.rate - inside.gap_rate[j]).head<2>().norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace pintle

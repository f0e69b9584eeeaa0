// Penalties against their law written out, against multipliers, and the augmented Lagrangian against both.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "integrators/general/alpha_stepper.h"
#include "integrators/ideal/augmented_lagrangian.h"
#include "integrators/ideal/ideal_stepper.h"
#include "integrators/ideal/penalty_forces.h"
#include "integrators/ideal/tree_augmented.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

constexpr double kEnd = 0.2;

System ideal_system(const Model& model) {
  System system = build_system(model);
  for (JointData& joint : system.joints) joint.ideal = true;
  return system;
}

// With a light crank, so that the motion depends on the forces.
Model light_four_bar() {
  Model model = sample::four_bar(1e8, 3e3);
  model.bodies[0].inertia = 1;
  model.gravity = {0, -9.81};
  return model;
}

// Off the constraints, where every term of the penalty counts: M a = Q + G' f, f = -alpha (G a + bias + 2 mu w e' + w^2 e).
TEST(PenaltyEquations, ForcesAreThePenaltiesOfTheConstraints) {
  const Model model = light_four_bar();
  const System system = ideal_system(model);
  const PenaltySettings penalty{1e3, 20, 0.6};
  IdealEquations equations(system, Equations::kPenalty, penalty);
  State state = sample::plain_start(model, system);
  for (int i = 0; i < system.n_bodies(); ++i) {
    state.q[i] += Planar::Vec(0.01, -0.02, 0.03) * (i + 1);
    state.v[i] += Planar::Vec(-0.3, 0.1, 0.2) * (i + 1);
  }
  ASSERT_TRUE(equations.complete(state));
  const sample::DenseEquations dense(system, state.t, state.q, state.v);
  std::vector<Planar::Motion> m;
  system.motions(state.q, state.v, m);
  Eigen::VectorXd a(dense.mass.size()), f(dense.bias.size()), expected(f.size());
  for (int i = 0; i < system.n_bodies(); ++i) a.segment<3>(3 * i) = state.a[i];
  const Eigen::VectorXd e2 = dense.G * a + dense.bias;
  for (Eigen::Index row = 0; row < f.size(); ++row) {
    const auto [joint, k] = dense.rows[row];
    const JointKinematics r = system.kinematics(joint, state.t, m);
    f[row] = state.force[joint][k];
    expected[row] = -equations.penalty(row) * (e2[row] + 2 * 0.6 * 20 * r.rate[k] + 400 * r.gap[k]);
  }
  EXPECT_LT((f - expected).norm(), 1e-9 * f.norm());
  EXPECT_LT((dense.mass.cwiseProduct(a) - dense.Q - dense.G.transpose() * f).norm(), 1e-9 * f.norm());
}

// alpha of a row is the factor times the mass that resists it. For a pin between the ground and the end of a rod, this is the rod's mass along the rod.
TEST(PenaltyEquations, PenaltiesGoWithTheMassesThatResist) {
  const Model model = sample::pendulum(1e6, 500);
  const System system = ideal_system(model);
  IdealEquations equations(system, Equations::kPenalty, {1e4, 10, 1});
  State state = sample::plain_start(model, system);
  ASSERT_TRUE(equations.complete(state));
  EXPECT_NEAR(equations.penalty(0), 1e4, 1e-8);    // 1 kg
  EXPECT_NEAR(equations.penalty(1), 1e4 / 4, 1e-8);  // 1/m + (L/2)^2/I = 4/m
}

double distance(const State& a, const State& b) {
  double sum = 0;
  for (std::size_t j = 0; j < a.force.size(); ++j) sum += (a.force[j] - b.force[j]).squaredNorm();
  return std::sqrt(sum);
}

TEST(PenaltyEquations, DifferFromMultipliersByOneOverThePenalty) {
  const Model model = light_four_bar();
  const System system = ideal_system(model);
  State ideal = sample::plain_start(model, system), soft = ideal, stiff = ideal;
  ASSERT_TRUE(IdealEquations(system).complete(ideal));
  ASSERT_TRUE(IdealEquations(system, Equations::kPenalty, {1e4, 10, 1}).complete(soft));
  ASSERT_TRUE(IdealEquations(system, Equations::kPenalty, {1e5, 10, 1}).complete(stiff));
  EXPECT_GT(distance(soft, ideal), 0);
  EXPECT_NEAR(distance(soft, ideal) / distance(stiff, ideal), 10, 0.1);
}

// A second pin next to the follower's: both carry the same, and together as much as one carries alone.
TEST(PenaltyEquations, DependentConstraintsShareByTheirPenalties) {
  Model one = light_four_bar(), two = one;
  Joint twin = two.joints[3];
  twin.name = "twin";
  two.joints.push_back(twin);
  const System alone = ideal_system(one), both = ideal_system(two);
  State a = sample::plain_start(one, alone), b = sample::plain_start(two, both);
  ASSERT_TRUE(IdealEquations(alone, Equations::kPenalty).complete(a));
  ASSERT_TRUE(IdealEquations(both, Equations::kPenalty).complete(b));
  EXPECT_LT((b.force[3] - b.force[4]).norm(), 1e-6 * a.force[3].norm());
  EXPECT_LT((b.force[3] + b.force[4] - a.force[3]).norm(), 1e-5 * a.force[3].norm());
}

// The same penalties by an implicit method, as their authors use them.
TEST(PenaltyEquations, TrapezoidalRuleAndHhtHaveTheirOrder) {
  const Model model = light_four_bar();
  const System system = ideal_system(model);
  const PenaltySettings penalty{1e5, 20, 1};
  const State start = sample::plain_start(model, system);
  IdealStepper truth(system, 1e-8, Equations::kPenalty, penalty);
  truth.start(start, 1e-4);
  while (truth.state().t < kEnd) ASSERT_TRUE(truth.step(kEnd)) << truth.failure();
  for (const AlphaWeights& weights : {AlphaWeights::trapezoidal(), AlphaWeights::hht(-0.05)}) {
    std::vector<double> errors;
    for (const double h : {4e-3, 2e-3, 1e-3, 5e-4}) {
      AlphaStepper stepper(system, weights, 1e-1, std::make_unique<PenaltyForces>(system, penalty));
      stepper.set_max_step(h);
      stepper.start(start, h);
      while (stepper.state().t < kEnd) ASSERT_TRUE(stepper.step(kEnd)) << stepper.failure();
      EXPECT_EQ(stepper.counters().steps, static_cast<std::uint64_t>(std::lround(kEnd / h)));
      errors.push_back(distance(stepper.state(), truth.state()));
    }
    EXPECT_GT(sample::measured_order(errors), 1.8) << weights.forces;
  }
}

State end_by_multipliers(const Model& model) {
  const System system = ideal_system(model);
  IdealStepper stepper(system, 1e-8);
  stepper.start(sample::plain_start(model, system), 1e-4);
  while (stepper.state().t < kEnd)
    if (!stepper.step(kEnd)) throw std::runtime_error(stepper.failure());
  return stepper.state();
}

// Steps of h without error control.
void go_to_end(Stepper& stepper, const State& start, double h) {
  stepper.set_max_step(h);
  stepper.start(start, h);
  while (stepper.state().t < kEnd)
    if (!stepper.step(kEnd)) throw std::runtime_error(stepper.failure());
}

struct Error {
  double projected = 0, of_iteration = 0;
};

Error augmented_error(const Model& model, const State& truth, const AlphaWeights& weights, double h, double factor = 1e3) {
  const System system = ideal_system(model);
  auto kept = std::make_unique<AugmentedLagrangian>(system, factor);
  const AugmentedLagrangian& inside = *kept;
  AlphaStepper stepper(system, weights, 1e6, std::move(kept));
  go_to_end(stepper, sample::plain_start(model, system), h);
  State iteration = stepper.state();
  iteration.force = inside.force();
  return {distance(stepper.state(), truth), distance(iteration, truth)};
}

// The same in relative coordinates; for the forces only.
double relative_error(const Model& model, const State& truth, const AlphaWeights& weights, double h) {
  const System system = ideal_system(model);
  TreeAugmented stepper(system, weights, 1e6);
  go_to_end(stepper, sample::plain_start(model, system), h);
  return distance(stepper.state(), truth);
}

// For the joints of the tree and for those that close the loop.
TEST(AugmentedLagrangian, RelativeCoordinatesHaveTheOrderOfTheMethod) {
  Model model = light_four_bar();
  model.springs.push_back(sample::spring("spring", false, {"ground", "O2"}, {"coupler", "B"}, 200, 3));
  const State truth = end_by_multipliers(model);
  for (const AlphaWeights& weights : {AlphaWeights::trapezoidal(), AlphaWeights::hht(-0.3)}) {
    std::vector<double> errors;
    for (const double h : {4e-3, 2e-3, 1e-3}) errors.push_back(relative_error(model, truth, weights, h));
    EXPECT_GT(sample::measured_order(errors), 1.8) << weights.forces;
    EXPECT_LT(errors.back(), 1);  // of peaks of 2 kN
  }
}

// The multipliers of the iteration belong to accelerations that are projected afterwards: they lose an order.
TEST(AugmentedLagrangian, ForcesOfProjectedAccelerationsAreOfTheMethodsOrder) {
  const State truth = end_by_multipliers(light_four_bar());
  for (const AlphaWeights& weights : {AlphaWeights::trapezoidal(), AlphaWeights::hht(-0.3)}) {
    std::vector<double> projected, of_iteration;
    for (const double h : {4e-3, 2e-3, 1e-3}) {
      const Error e = augmented_error(light_four_bar(), truth, weights, h);
      projected.push_back(e.projected);
      of_iteration.push_back(e.of_iteration);
    }
    EXPECT_GT(sample::measured_order(projected), 1.8) << weights.forces;
    EXPECT_NEAR(std::log2(of_iteration[1] / of_iteration[2]), 1, 0.15) << weights.forces;
    EXPECT_GT(of_iteration[2], 10 * projected[2]);
  }
}

TEST(AugmentedLagrangian, ThePenaltyOnlyServesTheIteration) {
  const Model model = light_four_bar();
  const State truth = end_by_multipliers(model);
  const Error little = augmented_error(model, truth, AlphaWeights::trapezoidal(), 1e-3, 1e2), much = augmented_error(model, truth, AlphaWeights::trapezoidal(), 1e-3, 1e8);
  EXPECT_NEAR(little.projected / much.projected, 1, 1e-3);
}

// Positions to within what the iteration leaves; velocities and accelerations, which are projected, to roundoff.
TEST(AugmentedLagrangian, StepsEndOnTheConstraints) {
  const Model model = light_four_bar();
  const System system = ideal_system(model);
  AlphaStepper stepper(system, AlphaWeights::hht(-0.05), 1e-3, std::make_unique<AugmentedLagrangian>(system));
  stepper.start(sample::plain_start(model, system), 1e-4);
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(stepper.step(1)) << stepper.failure();
    const State& s = stepper.state();
    const sample::DenseEquations dense(system, s.t, s.q, s.v);
    Eigen::VectorXd v(dense.mass.size()), a(dense.mass.size());
    for (int b = 0; b < system.n_bodies(); ++b) {
      v.segment<3>(3 * b) = s.v[b];
      a.segment<3>(3 * b) = s.a[b];
    }
    std::vector<Planar::Motion> m;
    system.motions(s.q, s.v, m);
    for (int j = 0; j < system.n_joints(); ++j) EXPECT_LT(system.kinematics(j, s.t, m).gap.head<2>().norm(), 1e-7);
    EXPECT_LT((dense.G * v).norm(), 1e-10 * v.norm());
    EXPECT_LT((dense.G * a + dense.bias).norm(), 1e-10 * a.norm());
  }
}

}  // namespace
}  // namespace pintle

// The methods over a joint tree against each other and against those for free bodies, and the balance of every body at any time.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "integrators/methods.h"
#include "integrators/relative/tree_dopri5.h"
#include "integrators/relative/tree_radau.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using S = Planar;

using sample::with_ideal;

// Six bodies with joints and loads of every kind, some joints ideal.
System everything(const std::vector<std::string>& ideal) { return with_ideal(build_system(sample::everything()), ideal); }

// Random angles within a turn, slow rates; gaps as the bodies leave them.
State start_of(const System& system) {
  const JointTree tree(system);
  sample::Random random(11);
  VectorXd y(tree.n()), u(tree.n());
  for (int i = 0; i < tree.n(); ++i) {
    y[i] = random.uniform(-1, 1);
    u[i] = random.uniform(-0.3, 0.3);
  }
  TreePose pose;
  tree.place(y, u, pose);
  State state;
  state.q = pose.q;
  state.v = pose.v;
  state.a.resize(system.bodies.size());
  state.gap = state.gap_rate = state.gap_accel = state.force = Vecs(system.joints.size(), S::Vec::Zero());
  TreeDopri5 method(system, 1e-6);
  method.start(state, 1e-4);
  return method.state();
}

State run_to(Stepper& method, const State& start, double t) {
  method.start(start, 1e-4);
  while (method.state().t < t * (1 - 1e-12))
    if (!method.step(t)) {
      ADD_FAILURE() << method.failure();
      break;
    }
  return method.state();
}

double largest_difference(const Vecs& a, const Vecs& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).cwiseAbs().maxCoeff());
  return largest;
}
double largest(const Vecs& a) { return largest_difference(a, Vecs(a.size(), S::Vec::Zero())); }

void expect_balance(const System& system, const State& state) {
  std::vector<S::Motion> m;
  Vecs Q;
  system.motions(state.q, state.v, m);
  system.external(state.t, m, Q);
  for (int j = 0; j < system.n_joints(); ++j) add_force(system.joints[j].at, system.kinematics(j, state.t, m), state.force[j], Q);
  for (int i = 0; i < system.n_bodies(); ++i)
    EXPECT_LT((system.bodies[i].mass.cwiseProduct(state.a[i]) - Q[i]).norm(), 1e-10 * (1 + largest(state.force))) << system.bodies[i].name << " " << state.t;
}

// The energy of the account, which stays constant. theory/time Eq. (8.1).
double account(const System& system, const State& state) {
  std::vector<S::Motion> m;
  system.motions(state.q, state.v, m);
  double energy = system.kinetic(state.v) + system.external_work(state.t, state.q, m).potential + state.dissipated - state.supplied;
  for (int j = 0; j < system.n_joints(); ++j)
    if (system.joints[j].servo < 0) energy += respond(system.joints[j].law, state.gap[j], state.gap_rate[j]).energy;
  return energy;
}

const std::vector<std::vector<std::string>> kTrees{{}, {"g", "r", "p", "f"}, {"h", "p", "f", "s"}, {"g", "h", "r", "p", "f", "s"}};

TEST(TreeMethods, ImplicitAndExplicitMethodAgree) {
  for (const auto& ideal : kTrees) {
    const System system = everything(ideal);
    const State start = start_of(system);
    TreeDopri5 explicit_method(system, 1e-10);
    const State known = run_to(explicit_method, start, 0.05);
    for (const int stages : {3, 5}) {
      TreeRadau method(system, 1e-9, stages);
      const State state = run_to(method, start, 0.05);
      EXPECT_LT(largest_difference(state.q, known.q), 1e-8) << ideal.size() << " " << stages;
      EXPECT_LT(largest_difference(state.v, known.v), 1e-7) << ideal.size() << " " << stages;
      EXPECT_LT(largest_difference(state.force, known.force), 1e-7 * largest(known.force)) << ideal.size() << " " << stages;
      EXPECT_NEAR(account(system, state), account(system, start), 1e-7 * account(system, start)) << ideal.size() << " " << stages;
    }
  }
}

TEST(TreeMethods, WithoutIdealJointsStatesAreThoseOfFreeBodies) {
  const System system = everything({});
  const State start = start_of(system);
  const auto free = make_stepper(system, {Equations::kNewtonian, "radau", 5}, 1e-10);
  const auto tree = make_stepper(system, {Equations::kRelative, "radau", 5}, 1e-10);
  const State known = run_to(*free, start, 0.05), state = run_to(*tree, start, 0.05);
  EXPECT_LT(largest_difference(state.q, known.q), 1e-10);
  EXPECT_LT(largest_difference(state.force, known.force), 1e-9 * largest(known.force));
}

TEST(TreeMethods, EveryBodyIsInBalanceAtAnyTime) {
  for (const auto& ideal : kTrees) {
    const System system = everything(ideal);
    for (const char* method : {"radau", "dopri5"}) {
      const auto stepper = make_stepper(system, {Equations::kRelative, method, 3}, 1e-6);
      stepper->start(start_of(system), 1e-3);
      for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(stepper->step(1)) << stepper->failure();
        expect_balance(system, stepper->state());
        for (const double x : {0.2, 0.7})
          expect_balance(system, stepper->interpolate((1 - x) * stepper->previous().t + x * stepper->state().t));
      }
    }
  }
}

// The dense output inside a step and its ends form one curve.
TEST(TreeMethods, TheInsideOfAStepJoinsItsEnds) {
  const System system = everything(kTrees[1]);
  for (const char* name : {"radau", "dopri5"}) {
    const auto method = make_stepper(system, {Equations::kRelative, name, 3}, 1e-8);
    method->start(start_of(system), 1e-3);
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(method->step(1)) << method->failure();
      const double h = method->state().t - method->previous().t, near = 1e-7 * h;
      const State inside = method->interpolate(method->state().t - near), &end = method->state();
      EXPECT_LT(largest_difference(inside.q, end.q), 10 * near + 1e-12);
      EXPECT_LT(largest_difference(inside.force, end.force), 1e-5 * largest(end.force));
      EXPECT_NEAR(inside.dissipated, end.dissipated, 1e-6 * (1 + end.dissipated));
    }
  }
}

// Displacements that close the gaps, and forces whose accelerations are those of the gaps, for a mu at which every mode is stiff.
TEST(TreeProjector, ClosesGapsAndBalancesForces) {
  const System system = with_ideal(build_system(sample::four_bar(1e8, 3000)), {"O2", "A", "O4"});
  const JointTree tree(system);
  TreeInstant at(system, tree);
  const State start = start_of(system);
  TreeState state;
  tree.read_positions(start.q, state.y);
  at.place(0, state.y, VectorXd::Constant(tree.n(), 0.2));
  TreeProjector projector;
  const VectorXd still = VectorXd::Zero(at.n_gaps());
  state.gap = state.rate = still;
  ASSERT_TRUE(projector.prepare(at, 1e-2, state));
  const VectorXd wanted = Eigen::Vector3d(0.3, -0.2, 0);
  const VectorXd reached = at.A() * projector.close(wanted);
  EXPECT_LT((reached - wanted).head<2>().norm(), 1e-9);
  VectorXd force = still, w, accel;
  projector.balance(at, wanted, false, force, w);
  at.accelerate(w);
  at.gap_accelerations(accel);
  EXPECT_LT((accel - wanted).head<2>().norm(), 1e-9);
  VectorXd missing;
  at.imbalance(force, missing);
  EXPECT_LT(missing.norm(), 1e-9 * force.norm());
  EXPECT_EQ(force[2], 0);  // a pin carries no moment
}

}  // namespace
}  // namespace pintle

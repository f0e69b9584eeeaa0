// Joint forces at all instants of a step at once, against the projection of one instant after the other.
#include "integrators/dense/dense_forces.h"

#include <gtest/gtest.h>

#include <limits>

#include "integrators/absolute/gap_projector.h"
#include "integrators/absolute/radau_stepper.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

using S = Planar;

// A curve through the accelerations at the nodes: weights of the nodes for the value at sample i and for both integrals.
struct AlongStep {
  const ForceSamples& samples;
  int n, i;
  double h, x = samples.x[i];

  S::Vec sum(const ForceSamples::AtNodes& weight, const std::vector<Vecs>& of, std::size_t k) const {
    S::Vec out = S::Vec::Zero();
    for (int node = 0; node <= n; ++node) out += weight[node] * of[node][k];
    return out;
  }
  S::Vec value(const std::vector<Vecs>& of, std::size_t k) const { return sum(samples.value[i], of, k); }
  S::Vec rate(const std::vector<Vecs>& of, const Vecs& v0, const Vecs& v1, std::size_t k) const {
    return v0[k] + h * sum(samples.once[i], of, k) + x * (v1[k] - v0[k] - h * sum(samples.once.back(), of, k));
  }
  S::Vec place(const std::vector<Vecs>& of, const Vecs& x0, const Vecs& v0, const Vecs& x1, std::size_t k) const {
    const S::Vec bend = x1[k] - x0[k] - h * v0[k] - h * h * sum(samples.twice.back(), of, k);
    return x0[k] + x * h * v0[k] + h * h * sum(samples.twice[i], of, k) + x * x * (3 - 2 * x) * bend;
  }
};

// theory/time section 5, item 2, with the projector.
Vecs forces_at(const System& system, const AlongStep& along, const State& begin, const State& end, const StepNodes& nodes) {
  State at = begin;
  for (std::size_t b = 0; b < at.q.size(); ++b) {
    at.q[b] = along.place(nodes.a, begin.q, begin.v, end.q, b);
    at.v[b] = along.rate(nodes.a, begin.v, end.v, b);
  }
  for (std::size_t j = 0; j < at.gap.size(); ++j) {
    at.gap[j] = along.place(nodes.gap_accel, begin.gap, begin.gap_rate, end.gap, j);
    at.gap_rate[j] = along.rate(nodes.gap_accel, begin.gap_rate, end.gap_rate, j);
    at.gap_accel[j] = along.value(nodes.gap_accel, j);
    at.force[j] = along.value(nodes.force, j);
  }
  at.t = begin.t + along.x * along.h;
  GapProjector projector(system);
  std::vector<S::Motion> m;
  system.motions(at.q, at.v, m);
  EXPECT_TRUE(projector.prepare(at.t, m, nodes.table->real_eigenvalue / along.h, at.gap, at.gap_rate));
  Vecs wanted(at.gap.size()), Q;
  for (std::size_t j = 0; j < wanted.size(); ++j) wanted[j] = at.gap_rate[j] - projector.joint_kinematics()[j].rate;
  projector.close(wanted, at.v);
  system.motions(at.q, at.v, m);
  projector.read(at.t, m);
  system.external(at.t, m, Q);
  projector.balance(Q, at.gap_accel, at.force);
  return at.force;
}

void compare_with_steps(const char* what, const Model& model, State (*start)(const Model&, const System&), int stages, double h) {
  const System system = build_system(model);
  RadauStepper stepper(system, 1e-8, stages);
  stepper.start(start(model, system), h);
  ASSERT_TRUE(stepper.trial(h)) << what;
  ASSERT_TRUE(stepper.trial(h)) << what;
  const State &begin = stepper.previous(), &end = stepper.state();
  DenseForces::Sampled sampled;
  make_dense_forces(system)->find(begin, end, stepper.nodes(), sampled);
  EXPECT_EQ(sampled.front(), begin.force);
  EXPECT_EQ(sampled.back(), end.force);
  const ForceSamples& samples = ForceSamples::of(stepper.table());
  for (int i = 1; i <= ForceSamples::kN; ++i) {
    const Vecs expected = forces_at(system, {samples, stages, i, h}, begin, end, stepper.nodes());
    double size = 0;
    for (const S::Vec& f : expected) size = std::max(size, f.cwiseAbs().maxCoeff());
    ASSERT_GT(size, 0) << what;
    for (std::size_t j = 0; j < expected.size(); ++j)
      EXPECT_LT((sampled[i][j] - expected[j]).cwiseAbs().maxCoeff(), 1e-9 * size) << what << ", " << system.joints[j].name << ", sample " << i;
  }
}

State settled_after(const Model& model, const System& system) { return sample::settled_start(model, system, 0.05); }

TEST(DenseForces, AreThoseOfOneInstantAfterTheOther) {
  for (const int stages : {3, 5}) {
    compare_with_steps("pendulum", sample::pendulum(1e8, 3500), settled_after, stages, 0.02);
    compare_with_steps("four-bar", sample::four_bar(1e8, 3000), settled_after, stages, 0.005);
    compare_with_steps("everything", sample::everything(), sample::plain_start, stages, 2e-5);  // gears, ropes, springs, motors that follow a function
  }
}

// Where the forces of the laws are not numbers, those at the nodes are kept.
TEST(DenseForces, AnInstantWithoutAnAnswerKeepsWhatTheNodesSay) {
  const Model model = sample::four_bar(1e8, 3000);
  const System system = build_system(model);
  const double h = 0.005;
  RadauStepper stepper(system, 1e-8);
  stepper.start(settled_after(model, system), h);
  ASSERT_TRUE(stepper.trial(h));
  StepNodes nodes = stepper.nodes();
  nodes.gap_accel[1][0][0] = std::numeric_limits<double>::quiet_NaN();
  DenseForces::Sampled sampled;
  make_dense_forces(system)->find(stepper.previous(), stepper.state(), nodes, sampled);
  for (int i = 1; i <= ForceSamples::kN; ++i) {
    const AlongStep along{ForceSamples::of(stepper.table()), 3, i, h};
    for (std::size_t j = 0; j < sampled[i].size(); ++j) EXPECT_LT((sampled[i][j] - along.value(nodes.force, j)).norm(), 1e-6) << i;
  }
}

}  // namespace
}  // namespace pintle

#include "integrators/absolute/gap_projector.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

using sample::Random;

// The four-bar, with every body displaced by up to `size`.
struct Knocked {
  Model model;
  const System system;
  State state;

  Knocked(double k, double size) : model(sample::four_bar(k, 3000)), system(build_system(model)), state(sample::plain_start(model, system)) {
    Random random(3);
    for (auto& q : state.q) q += random.vector<Planar::Vec>(-size, size);
  }
  std::vector<Planar::Motion> motions() const {
    std::vector<Planar::Motion> m;
    system.motions(state.q, state.v, m);
    return m;
  }
};

Eigen::VectorXd stacked_rows(const Vecs& x) {
  Eigen::VectorXd y(3 * static_cast<int>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) y.segment<3>(3 * static_cast<int>(i)) = x[i];
  return y;
}

TEST(GapProjector, ClosesGapsToRounding) {
  for (const double k : {1e6, 1e8, 1e12}) {
    Knocked at(k, 1e-3);
    GapProjector projector(at.system);
    Vecs wanted(at.system.joints.size());
    for (int pass = 0; pass < 6; ++pass) {
      ASSERT_TRUE(projector.prepare(0, at.motions(), 1, at.state.gap, at.state.gap_rate));
      for (std::size_t j = 0; j < wanted.size(); ++j) wanted[j] = -projector.joint_kinematics()[j].gap;
      projector.close(wanted, at.state.q);
    }
    const auto m = at.motions();
    for (int j = 0; j < at.system.n_joints(); ++j) EXPECT_LT(at.system.kinematics(j, 0, m).gap.head<2>().norm(), 1e-13) << k;
  }
}

// One pass is the solution of (mu^2 M + G' W G) x = G' W wanted, W = K + mu C, here by a dense factorisation.
TEST(GapProjector, OnePassIsTheDenseSolution) {
  for (const double mu : {10.0, 1e3, 1e5}) {
    const Knocked at(1e8, 1e-3);
    GapProjector projector(at.system);
    ASSERT_TRUE(projector.prepare(0, at.motions(), mu, at.state.gap, at.state.gap_rate));
    const sample::DenseEquations e(at.system, 0, at.state.q, at.state.v);
    Random random(4);
    Vecs wanted(at.system.joints.size()), x(at.system.bodies.size(), Planar::Vec::Zero());
    for (auto& w : wanted) w << random.uniform(-1, 1), random.uniform(-1, 1), 0;
    projector.close(wanted, x);
    const double W = 1e8 + mu * 3000;
    Eigen::VectorXd w(e.G.rows());
    for (int r = 0; r < w.size(); ++r) w[r] = wanted[e.rows[r].first][e.rows[r].second];
    const Eigen::MatrixXd left = Eigen::MatrixXd((mu * mu * e.mass).asDiagonal()) + W * e.G.transpose() * e.G;
    const Eigen::VectorXd expected = left.ldlt().solve(W * e.G.transpose() * w);
    EXPECT_LT((stacked_rows(x) - expected).norm(), 1e-8 * expected.norm()) << mu;
  }
}

// The move is the shortest in the mass norm: it has no component along a motion that the joints leave free.
TEST(GapProjector, MovesNothingAlongFreeMotions) {
  const Knocked at(1e10, 1e-3);
  GapProjector projector(at.system);
  ASSERT_TRUE(projector.prepare(0, at.motions(), 1, at.state.gap, at.state.gap_rate));
  Vecs wanted(at.system.joints.size()), x(at.system.bodies.size(), Planar::Vec::Zero());
  for (std::size_t j = 0; j < wanted.size(); ++j) wanted[j] = -projector.joint_kinematics()[j].gap;
  projector.close(wanted, x);
  const sample::DenseEquations e(at.system, 0, at.state.q, at.state.v);
  const Eigen::VectorXd free = e.G.fullPivLu().kernel().col(0);
  EXPECT_LT(std::abs(free.dot(e.mass.cwiseProduct(stacked_rows(x)))), 1e-9 * free.cwiseProduct(e.mass).norm() * stacked_rows(x).norm());
}

// Repeated passes lead to the forces of M a = Q + G' f for the accelerations of ideal joints.
TEST(GapProjector, ForcesBecomeTheIdealReactions) {
  const Knocked at(1e8, 0);
  const sample::DenseEquations e(at.system, 0, at.state.q, at.state.v);
  const Eigen::VectorXd f = e.reactions();
  const Eigen::VectorXd a = e.mass.cwiseInverse().asDiagonal() * (e.Q + e.G.transpose() * f);
  GapProjector projector(at.system);
  ASSERT_TRUE(projector.prepare(0, at.motions(), 10, at.state.gap, at.state.gap_rate));
  Vecs Q(at.system.bodies.size()), accel(Q.size()), force(at.system.joints.size(), Planar::Vec::Zero());
  for (std::size_t i = 0; i < Q.size(); ++i) {
    Q[i] = e.Q.segment<3>(3 * static_cast<int>(i));
    accel[i] = a.segment<3>(3 * static_cast<int>(i));
  }
  for (int pass = 0; pass < 4; ++pass) projector.improve_forces(Q, accel, force);
  for (int r = 0; r < f.size(); ++r) EXPECT_NEAR(force[e.rows[r].first][e.rows[r].second], f[r], 1e-7 * f.norm());
}

// Joints that hold twice what one would hold: the projection still has a solution, and closes what can be closed.
TEST(GapProjector, RedundantJointsAreNoObstacle) {
  Model model = sample::pendulum(1e8, 3000);
  model.joints.push_back(sample::joint("twin", "revolute", {"ground", "O"}, {"rod", "O"}, 1e8, 3000));
  const System system = build_system(model);
  State state = sample::plain_start(model, system);
  state.q[0] += Planar::Vec(1e-3, 2e-3, 0.01);
  GapProjector projector(system);
  Vecs wanted(2);
  for (int pass = 0; pass < 5; ++pass) {
    std::vector<Planar::Motion> m;
    system.motions(state.q, state.v, m);
    ASSERT_TRUE(projector.prepare(0, m, 1, state.gap, state.gap_rate));
    for (int j = 0; j < 2; ++j) wanted[j] = -projector.joint_kinematics()[j].gap;
    projector.close(wanted, state.q);
  }
  std::vector<Planar::Motion> m;
  system.motions(state.q, state.v, m);
  for (int j = 0; j < 2; ++j) EXPECT_LT(system.kinematics(j, 0, m).gap.head<2>().norm(), 1e-14);
}

}  // namespace
}  // namespace pintle

// The stiffness of joints against motions across them: never less than their geometric stiffness, for motions that leave held
// components unchanged.
#include "integrators/radau/joint_pull.h"

#include <gtest/gtest.h>

#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using sample::Random;
using S = Planar;

// A motion of both bodies, with the second moved so that the held components of the point do not change.
Eigen::Matrix<double, 6, 1> motion_that_keeps(const JointData& joint, const JointKinematics& r, Random& random) {
  Eigen::Matrix<double, 6, 1> x;
  x << random.vector<S::Vec>(-1, 1), random.vector<S::Vec>(-1, 1);
  if (joint.at.a == kGround) x.head<3>().setZero();
  if (joint.at.b == kGround) x.tail<3>().setZero();
  if (!std::holds_alternative<Selection>(joint.displacement)) return x;
  S::Vec e;
  r.map.gather(x.data(), x.data() + 3, e.data());
  for (int k = 0; k < 2; ++k)
    if (joint.free_mask[k] != 0) e[k] = 0;
  const Eigen::Vector2d off(r.map.c * e[0] - r.map.s * e[1], r.map.s * e[0] + r.map.c * e[1]);
  if (joint.at.b != kGround) x.segment<2>(3) -= off;
  else x.head<2>() += off;
  return x;
}

TEST(JointPull, IsNotLessThanTheGeometricStiffness) {
  Random random(3);
  const System system = build_system(sample::everything());
  for (int trial = 0; trial < 200; ++trial) {
    Vecs q, v;
    std::vector<S::Motion> m;
    sample::random_state(random, system.bodies.size(), q, v);
    system.motions(q, v, m);
    for (int j = 0; j < system.n_joints(); ++j) {
      const JointData& joint = system.joints[j];
      S::Vec force = random.vector<S::Vec>(-1, 1);
      const bool pose = std::holds_alternative<Selection>(joint.displacement);
      for (int k = 0; k < 2 && pose; ++k)
        if (joint.free_mask[k] != 0 || joint.servo >= 0) force[k] = 0;  // no law there
      std::vector<BodyPull<Planar>> pulled(system.bodies.size());
      add_pull_of(j, system, m, force, pulled);
      if (joint.servo >= 0) continue;
      const auto x = motion_that_keeps(joint, system.kinematics(j, 0, m), random);
      const double geometric = x.dot(geometric_stiffness(joint.displacement, system.pose(joint.at, m), force) * x);
      double held = 0;
      for (const auto& [body, first] : {std::pair(joint.at.a, 0), std::pair(joint.at.b, 3)}) {
        if (body == kGround) continue;
        const S::Vec all = unresolved(pulled[body], 0, system.bodies[body].mass);
        held += all.dot(S::Vec(x.segment<3>(first)).cwiseAbs2());
      }
      EXPECT_LE(std::abs(geometric), held * (1 + 1e-9) + 1e-9) << joint.name;
    }
  }
}

// A bar of length L that F pulls at both ends: F L against rotation, whatever its sign. What a step resolves is taken off.
TEST(JointPull, OfABarIsForceTimesLength) {
  const System system = build_system(sample::pendulum(1e8, 0));
  std::vector<S::Motion> m;
  system.motions({S::Vec(0.5, 0, 0)}, {S::Vec::Zero()}, m);
  for (const double force : {-10.0, 10.0}) {
    std::vector<BodyPull<Planar>> pulled(1);
    add_pull_of(0, system, m, S::Vec(force, 0, 0), pulled);
    EXPECT_NEAR(pulled[0][2], -0.5 * force, 1e-12);  // at the pin on its left only
    EXPECT_NEAR(unresolved(pulled[0], 0, system.bodies[0].mass)[2], 5, 1e-12);
    EXPECT_NEAR(unresolved(pulled[0], 2, system.bodies[0].mass)[2], 5 - 4.0 / 12, 1e-12);
    EXPECT_EQ(unresolved(pulled[0], 10, system.bodies[0].mass).norm(), 0);
  }
}

}  // namespace
}  // namespace pintle

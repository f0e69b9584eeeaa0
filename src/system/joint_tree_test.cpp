// The recursions over a joint tree against their definitions: differences along a path, J'MJ, the balance of every body.
#include "system/joint_tree.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using S = Planar;
using sample::Random;

System with_ideal(const std::vector<std::string>& names, bool free = false) {
  System system = sample::with_ideal(build_system(sample::everything(free)), names);
  for (JointData& joint : system.joints)
    if (joint.type == "fixed") std::get<Selection>(joint.displacement).offset[2] = 2 * std::numbers::pi;
  return system;
}

System all_ideal(System system) {
  for (JointData& joint : system.joints) joint.ideal = true;
  return system;
}

// Trees that grow through joints from their first body and from their second, grounded and floating, with every type.
const std::vector<System>& trees() {
  static const std::vector<System> all{with_ideal({}),         with_ideal({"g", "r", "p", "f"}), with_ideal({"h", "p", "f", "s"}),
                                       with_ideal({"r", "p", "f", "s"}), with_ideal({"r", "p", "f"}, true), with_ideal({"g", "s", "f"})};
  return all;
}

VectorXd random_vector(Random& random, int n) { return sample::random_vector(random, n, 1.5); }

VectorXd stacked(const Vecs& x) {
  VectorXd out(3 * static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) out.segment<3>(3 * static_cast<Eigen::Index>(i)) = x[i];
  return out;
}

VectorXd positions(const JointTree& tree, const VectorXd& y) {
  TreePose pose;
  tree.place(y, VectorXd::Zero(tree.n()), pose);
  return stacked(pose.q);
}
VectorXd velocities(const JointTree& tree, const VectorXd& y, const VectorXd& u) {
  TreePose pose;
  tree.place(y, u, pose);
  return stacked(pose.v);
}

class JointTrees : public ::testing::TestWithParam<int> {
 protected:
  JointTrees()
      : system(trees()[GetParam()]), tree(system), random(static_cast<std::uint64_t>(7 + GetParam())), y(random_vector(random, tree.n())),
        u(random_vector(random, tree.n())) {
    tree.place(y, u, pose);
  }
  const System& system;
  JointTree tree;
  Random random;
  VectorXd y, u;
  TreePose pose;
};

TEST_P(JointTrees, CoordinatesComeBackFromTheBodies) {
  VectorXd again;
  tree.read_positions(pose.q, again);
  EXPECT_LT((again - y).cwiseAbs().maxCoeff(), 1e-13);
  tree.read_rates(pose, pose.v, again);
  EXPECT_LT((again - u).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(JointTrees, JointsOfTheTreeKeepTheirGapsClosed) {
  for (int j = 0; j < system.n_joints(); ++j) {
    if (!tree.in_tree(j)) continue;
    const JointKinematics r = system.kinematics(j, 0, pose.m);
    const S::Vec held = S::Vec::Ones() - system.joints[j].free_mask;
    EXPECT_LT(r.gap.cwiseProduct(held).norm(), 1e-13) << system.joints[j].name;
    EXPECT_LT(r.rate.cwiseProduct(held).norm(), 1e-13) << system.joints[j].name;
  }
}

TEST_P(JointTrees, VelocitiesAreDifferencesOfPositions) {
  const double h = 1e-5;
  const VectorXd difference = (positions(tree, y + h * u) - positions(tree, y - h * u)) / (2 * h);
  EXPECT_LT((difference - stacked(pose.v)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST_P(JointTrees, AccelerationsAreDifferencesOfVelocities) {
  const double h = 1e-5;
  const VectorXd w = random_vector(random, tree.n());
  const auto at = [&](double t) { return velocities(tree, y + t * u + 0.5 * t * t * w, u + t * w); };
  Vecs a;
  tree.accelerate(pose, w, a);
  EXPECT_LT(((at(h) - at(-h)) / (2 * h) - stacked(a)).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_P(JointTrees, TheJacobianIsTheSlopeOfVelocities) {
  MatrixXd J;
  tree.jacobian(pose, J);
  for (int k = 0; k < tree.n(); ++k)
    EXPECT_LT((velocities(tree, y, VectorXd::Unit(tree.n(), k)) - J.col(k)).cwiseAbs().maxCoeff(), 1e-13) << k;
}

TEST_P(JointTrees, TheCompositeMassMatrixIsThatOfDifferences) {
  const double h = 1e-5;
  MatrixXd J(3 * system.n_bodies(), tree.n()), H;
  for (int k = 0; k < tree.n(); ++k) {
    const VectorXd step = h * VectorXd::Unit(tree.n(), k);
    J.col(k) = (positions(tree, y + step) - positions(tree, y - step)) / (2 * h);
  }
  VectorXd mass(3 * system.n_bodies());
  for (int i = 0; i < system.n_bodies(); ++i) mass.segment<3>(3 * i) = system.bodies[i].mass;
  tree.mass(pose, H);
  const MatrixXd known = J.transpose() * mass.asDiagonal() * J;
  EXPECT_LT((H - known).cwiseAbs().maxCoeff(), 1e-8 * known.cwiseAbs().maxCoeff());
  EXPECT_NEAR(0.5 * u.dot(H * u), system.kinetic(pose.v), 1e-13 * system.kinetic(pose.v));
}

TEST_P(JointTrees, GatheredForcesDoTheBodiesWork) {
  Vecs force(system.bodies.size());
  double power = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    force[i] = random.vector<S::Vec>(-5, 5);
    power += force[i].dot(pose.v[i]);
  }
  VectorXd on_coordinates;
  tree.gather(pose, force, on_coordinates);
  EXPECT_NEAR(on_coordinates.dot(u), power, 1e-12 * (1 + std::abs(power)));
}

TEST_P(JointTrees, SlopesOfTheMotionAreItsDifferences) {
  const double h = 1e-5;
  const VectorXd w = random_vector(random, tree.n());
  const auto motion_at = [&](const VectorXd& y_there, const VectorXd& u_there) {
    TreePose there;
    Vecs a;
    tree.place(y_there, u_there, there);
    tree.accelerate(there, w, a);
    return std::pair(stacked(there.v), stacked(a));
  };
  Vecs a;
  TreeMotionSlopes slopes;
  tree.accelerate(pose, w, a);
  tree.motion_slopes(pose, a, slopes);
  for (int k = 0; k < tree.n(); ++k) {
    const VectorXd step = h * VectorXd::Unit(tree.n(), k);
    const auto [v1, a1] = motion_at(y + step, u);
    const auto [v0, a0] = motion_at(y - step, u);
    EXPECT_LT(((v1 - v0) / (2 * h) - slopes.velocity.col(k)).cwiseAbs().maxCoeff(), 1e-7) << k;
    EXPECT_LT(((a1 - a0) / (2 * h) - slopes.acceleration.col(k)).cwiseAbs().maxCoeff(), 1e-6) << k;
    EXPECT_LT(((motion_at(y, u + step).second - motion_at(y, u - step).second) / (2 * h) - slopes.acceleration_by_rate.col(k)).cwiseAbs().maxCoeff(), 1e-7) << k;
  }
}

TEST_P(JointTrees, ForcesChangeOnCoordinatesByTheGeometricStiffness) {
  const double h = 1e-5;
  Vecs force(system.bodies.size());
  for (auto& f : force) f = random.vector<S::Vec>(-5, 5);
  const auto gathered_at = [&](const VectorXd& there) {
    TreePose at;
    Vecs on_bodies = force;
    VectorXd on_coordinates;
    tree.place(there, u, at);
    tree.gather(at, on_bodies, on_coordinates);
    return on_coordinates;
  };
  MatrixXd stiffness;
  tree.geometric_stiffness(pose, force, stiffness);
  EXPECT_EQ((stiffness - stiffness.transpose()).norm(), 0);
  for (int k = 0; k < tree.n(); ++k) {
    const VectorXd step = h * VectorXd::Unit(tree.n(), k);
    EXPECT_LT(((gathered_at(y + step) - gathered_at(y - step)) / (2 * h) - stiffness.col(k)).cwiseAbs().maxCoeff(), 1e-7) << k;
  }
}

// M a = Q + G' f for every body separately, with f of the tree's joints from the inward pass, when the coordinates' equations hold.
TEST_P(JointTrees, ReactionsBalanceEveryBody) {
  Vecs Q, a, needed(system.bodies.size()), force(system.joints.size(), S::Vec::Zero());
  system.external(0, pose.m, Q);
  tree.accelerate(pose, VectorXd::Zero(tree.n()), a);
  for (std::size_t i = 0; i < needed.size(); ++i) needed[i] = Q[i] - system.bodies[i].mass.cwiseProduct(a[i]);
  VectorXd on_coordinates;
  MatrixXd H;
  tree.gather(pose, needed, on_coordinates);
  tree.mass(pose, H);
  tree.accelerate(pose, H.llt().solve(on_coordinates), a);
  tree.reactions(pose, a, Q, force);
  double largest = 0;
  for (int j = 0; j < system.n_joints(); ++j) {
    add_force(system.joints[j].at, system.kinematics(j, 0, pose.m), force[j], Q);
    largest = std::max(largest, force[j].norm());
    EXPECT_EQ(force[j].cwiseProduct(system.joints[j].free_mask).norm(), 0);
  }
  for (int i = 0; i < system.n_bodies(); ++i)
    EXPECT_LT((system.bodies[i].mass.cwiseProduct(a[i]) - Q[i]).norm(), 1e-12 * (10 + largest)) << system.bodies[i].name;
}

// An impact within ideal joints: the lost momentum has no component along any coordinate.
TEST_P(JointTrees, RatesKeepTheMomentumAlongEveryCoordinate) {
  Vecs v(system.bodies.size()), lost(system.bodies.size());
  for (auto& x : v) x = random.vector<S::Vec>(-2, 2);
  VectorXd rates, along;
  tree.read_rates(pose, v, rates);
  const VectorXd kept = velocities(tree, y, rates);
  for (int i = 0; i < system.n_bodies(); ++i) lost[i] = system.bodies[i].mass.cwiseProduct(v[i] - kept.segment<3>(3 * i));
  tree.gather(pose, lost, along);
  EXPECT_LT(along.cwiseAbs().maxCoeff(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Every, JointTrees, ::testing::Range(0, 6));

TEST(JointTree, CountsCoordinates) {
  EXPECT_EQ(JointTree(trees()[0]).n(), 18);              // six free bodies
  EXPECT_EQ(JointTree(trees()[1]).n(), 1 + 1 + 1 + 0 + 6);  // revolute, revolute, prismatic, fixed, two free bodies
  EXPECT_EQ(JointTree(trees()[2]).n(), 1 + 1 + 0 + 2 + 6);  // prismatic, prismatic, fixed, slot
  EXPECT_EQ(JointTree(trees()[4]).n(), 3 + 1 + 1 + 0 + 6);  // floating: its first body has three
}

TEST(JointTree, ServosAndPlainJointsStayLaws) {
  const JointTree tree(trees()[1]);
  for (const int j : tree.laws()) EXPECT_FALSE(trees()[1].joints[j].ideal && tree.in_tree(j));
  EXPECT_EQ(tree.laws().size() + 4, trees()[1].joints.size());
}

TEST(JointTree, ALoopOfIdealJointsIsOpenedOnceAndSaid) {
  const System system = all_ideal(build_system(sample::four_bar(1e8, 3000)));
  const JointTree tree(system);
  EXPECT_EQ(tree.n(), 3);
  ASSERT_EQ(tree.laws().size(), 1u);
  EXPECT_EQ(system.joints[tree.laws()[0]].name, "B");
  const auto notes = tree.notes();
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], "joint B is opened: it closes a loop with the ideal joints A, O2, O4; its force law acts");
  EXPECT_EQ(notes[1], "joints eliminated by relative coordinates: O2, O4, A; 3 coordinates");
}

TEST(JointTree, AJointBesideAnotherIsALoopOfTwo) {
  const System pendulum = build_system(sample::pendulum(1e8, 3000));
  JointData twin = pendulum.joints[0];
  twin.name = "twin";
  const System system = all_ideal(with_joints(pendulum, {twin}));
  const JointTree tree(system);
  EXPECT_EQ(tree.n(), 1);
  EXPECT_EQ(tree.notes()[0], "joint twin is opened: it closes a loop with the ideal joint pin; its force law acts");
}

TEST(JointTree, TypesWithoutSingleCoordinatesAreOpenedAndSaid) {
  const System system = with_ideal({"d", "t", "m", "k"});
  const JointTree tree(system);
  EXPECT_EQ(tree.n(), 18);
  ASSERT_EQ(tree.notes().size(), 5u);
  EXPECT_EQ(tree.notes()[0], "joint d is opened: a rod has no free coordinates of its own; its force law acts");
}

}  // namespace
}  // namespace pintle

// Ranks and redundant constraints of mechanisms that can be counted by hand.
#include "mobility/mobility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "mobility/constraint_rows.h"
#include "mobility/rank.h"
#include "mobility/redundancy.h"
#include "system/build.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using sample::body;
using sample::joint;
using sample::put_at;

Vecs stated(const Model& model) {
  Vecs q;
  for (const Body& b : model.bodies) q.emplace_back((*b.position)[0], (*b.position)[1], *b.angle);
  return q;
}

// A coupler on `n` equal cranks of 1 m, 2 m apart, all at `angle`: more than two of them are redundant; at 0 it is a change point.
Model parallel_cranks(int n, double angle) {
  Model model;
  model.bodies = {body("coupler", 1, 1, {})};
  put_at(model.bodies[0], n - 1 + std::cos(angle), std::sin(angle), 0);
  for (int i = 0; i < n; ++i) {
    const std::string k = std::to_string(i);
    model.ground.push_back({"O" + k, {2.0 * i, 0}, 0});
    model.bodies[0].markers.push_back({"P" + k, {2.0 * i - (n - 1), 0}, 0});
    model.bodies.push_back(body("crank" + k, 1, 1, {{"O", {-0.5, 0}, 0}, {"P", {0.5, 0}, 0}}));
    put_at(model.bodies.back(), 2.0 * i + 0.5 * std::cos(angle), 0.5 * std::sin(angle), angle);
    model.joints.push_back(joint("O" + k, "revolute", {"ground", "O" + k}, {"crank" + k, "O"}, 1e8, 0));
    model.joints.push_back(joint("P" + k, "revolute", {"crank" + k, "P"}, {"coupler", "P" + k}, 1e8, 0));
  }
  return model;
}

struct Counted {
  System system;
  Vecs q;
  std::vector<ConstraintRow> rows;
  double length = 1;
};

Counted counted(const Model& model) {
  Counted out{build_system(model), stated(model), {}};
  const auto kinematics = kinematics_at_rest(out.system, out.q);
  out.length = arm_length(out.system, kinematics);
  out.rows = constraint_rows(out.system, kinematics, 1e-9);
  return out;
}

TEST(Mobility, OfAFourBar) {
  const Model model = sample::four_bar(1e8, 0);
  const MobilityCheck check = check_mobility(build_system(model), stated(model));
  EXPECT_EQ(check.counts.freedoms, 9);
  EXPECT_EQ(check.counts.constraints, 8);
  EXPECT_EQ(check.counts.gruebler, 1);
  EXPECT_EQ(check.counts.rank, 8);
  EXPECT_EQ(check.counts.rank_nearby, 8);
  EXPECT_EQ(check.counts.mobility, 1);
  EXPECT_EQ(check.counts.redundant, 0);
  EXPECT_EQ(check.counts.mobility_driven, 1);
  EXPECT_FALSE(check.counts.singular_position());
  EXPECT_TRUE(check.redundancies.empty());
  EXPECT_GT(check.counts.smallest_kept, 1e-3);
  EXPECT_EQ(check.counts.largest_dropped, 0);  // none
  EXPECT_EQ(check.counts.method, "pivoted QR");
}

// With its crank held by a motor it is a structure; the motor does not count as a joint.
TEST(Mobility, AMotorHoldsOneFreedom) {
  Model model = sample::four_bar(1e8, 0);
  model.motors = {sample::motor("drive", "O2", MotorKind::kSpeed, sample::expression("10"))};
  const MobilityCheck check = check_mobility(build_system(model), stated(model));
  EXPECT_EQ(check.counts.servos, 1);
  EXPECT_EQ(check.counts.constraints, 8);
  EXPECT_EQ(check.counts.mobility, 1);
  EXPECT_EQ(check.counts.mobility_driven, 0);
}

TEST(Mobility, EveryCrankBeyondTheSecondIsRedundant) {
  for (int n = 2; n < 6; ++n) {
    const Model model = parallel_cranks(n, 1);
    const MobilityCheck check = check_mobility(build_system(model), stated(model));
    EXPECT_EQ(check.counts.gruebler, 3 + 3 * n - 4 * n) << n;
    EXPECT_EQ(check.counts.mobility, 1) << n;
    EXPECT_EQ(check.counts.redundant, n - 2) << n;
    int degree = 0;
    double shares = 0;
    for (const CheckRedundancy& group : check.redundancies) {
      degree += group.degree;
      for (const auto& member : group.members) shares += member.share;
      EXPECT_TRUE(std::is_sorted(group.members.begin(), group.members.end(), [](const auto& a, const auto& b) { return a.share > b.share + 1e-9; }));
    }
    EXPECT_EQ(degree, n - 2) << n;
    EXPECT_NEAR(shares, n - 2, 1e-9) << n;
  }
}

// The deflection of a pin under a rotor's weight does not count as an arm.
TEST(Mobility, DeflectionsAreNoLengthOfTheMechanism) {
  Model model;
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {body("rotor", 2, 0.01, {{"C", {0, 0}, 0}})};
  put_at(model.bodies[0], 0, -2e-7, 0);
  model.joints = {joint("O", "revolute", {"ground", "O"}, {"rotor", "C"}, 1e8, 0)};
  EXPECT_EQ(counted(model).length, 1);
  model.bodies[0].markers[0].position = {0.03, 0};
  put_at(model.bodies[0], -0.03, -2e-7, 0);
  EXPECT_NEAR(counted(model).length, 0.03, 1e-6);
}

// All bars on one line: the rank is one lower than anywhere nearby.
TEST(Mobility, AFlatParallelogramIsSingular) {
  const Model model = parallel_cranks(2, 0);
  const MobilityCheck check = check_mobility(build_system(model), stated(model));
  EXPECT_TRUE(check.counts.singular_position());
  EXPECT_EQ(check.counts.rank, 7);
  EXPECT_EQ(check.counts.rank_nearby, 8);
  EXPECT_EQ(check.counts.mobility, 1);
  EXPECT_EQ(check.counts.redundant, 0);
  EXPECT_TRUE(check.redundancies.empty());  // of the regular position
  EXPECT_FALSE(check_mobility(build_system(model), check.regular).counts.singular_position());
}

// Positions in error by 1e-6 m determine the rank no more finely than that.
TEST(Mobility, AMisfitCoarsensTheRank) {
  Model model = parallel_cranks(3, 1);
  (*model.bodies[0].position)[1] += 1e-6;
  const MobilityCheck check = check_mobility(build_system(model), stated(model));
  EXPECT_NEAR(check.counts.rank_tolerance, 1e-5 * std::sin(1.0) / check.counts.length, 1e-9);  // ten times the larger component in the cranks' axes
  EXPECT_EQ(check.counts.redundant, 1);
  (*model.bodies[0].position)[1] += 1;
  EXPECT_EQ(check_mobility(build_system(model), stated(model)).counts.rank_tolerance, 1e-3);
  EXPECT_EQ(check_mobility(build_system(parallel_cranks(3, 1)), stated(parallel_cranks(3, 1))).counts.rank_tolerance, 1e-8);
}

// Both methods for the rank use the same rows; the dependencies of the sparse one name the same components.
TEST(Rank, SparseAndDenseAgree) {
  for (int n = 2; n < 6; ++n) {
    const Counted c = counted(parallel_cranks(n, 1));
    const DenseRank dense(c.rows, c.system, c.length, 1e-8);
    const SparseRank sparse = sparse_rank(c.rows, c.system, c.length, 1e-8);
    EXPECT_EQ(dense.rank(), 3 * n + 2);
    EXPECT_EQ(sparse.rank, dense.rank());
    EXPECT_EQ(sparse.dependencies.size(), static_cast<std::size_t>(n - 2));
    const auto names = [](const std::vector<CheckRedundancy>& groups) {
      std::set<std::string> out;
      for (const CheckRedundancy& group : groups)
        for (const auto& member : group.members) out.insert(member.joint + "." + member.component);
      return out;
    };
    const auto from_sparse = redundancies(c.system, c.rows, sparse), from_dense = redundancies(c.system, c.rows, dense);
    EXPECT_EQ(names(from_sparse), names(from_dense)) << n;
    int degree = 0;
    for (const CheckRedundancy& group : from_sparse) degree += group.degree;
    EXPECT_EQ(degree, n - 2);
  }
}

// Seventy bars, each welded to the ground twice: 3 dependencies each, of which the first hundred are listed.
TEST(Rank, TheFirstHundredDependenciesAreListed) {
  Model model;
  for (int i = 0; i < 70; ++i) {
    const std::string k = std::to_string(i);
    model.ground.push_back({"L" + k, {0, 1.0 * i}, 0});
    model.ground.push_back({"R" + k, {1, 1.0 * i}, 0});
    model.bodies.push_back(body("bar" + k, 1, 1, {{"L", {-0.5, 0}, 0}, {"R", {0.5, 0}, 0}}));
    put_at(model.bodies.back(), 0.5, i, 0);
    model.joints.push_back(joint("L" + k, "fixed", {"ground", "L" + k}, {"bar" + k, "L"}, 1e8, 0));
    model.joints.push_back(joint("R" + k, "fixed", {"ground", "R" + k}, {"bar" + k, "R"}, 1e8, 0));
  }
  const Counted c = counted(model);
  const SparseRank sparse = sparse_rank(c.rows, c.system, c.length, 1e-8);
  EXPECT_EQ(sparse.rank, 210);
  EXPECT_EQ(sparse.dependencies.size(), 100u);
  const MobilityCheck check = check_mobility(c.system, c.q);
  EXPECT_EQ(check.counts.redundant, 210);
  EXPECT_EQ(check.counts.mobility, 0);
}

// A chain of 300 rods is too large for orthogonal factors, one of 5000 for any.
TEST(Mobility, LargeOnesAreCountedAnotherWay) {
  const auto chain = [](int n) {
    Model model;
    model.ground = {{"O", {0, 0}, 0}};
    for (int i = 0; i < n; ++i) {
      model.bodies.push_back(body("rod" + std::to_string(i), 1, 1, {{"L", {-0.5, 0}, 0}, {"R", {0.5, 0}, 0}}));
      put_at(model.bodies.back(), i + 0.5, 0, 0);
      model.joints.push_back(joint("J" + std::to_string(i), "revolute", {i > 0 ? "rod" + std::to_string(i - 1) : "ground", i > 0 ? "R" : "O"}, {"rod" + std::to_string(i), "L"}, 1e8, 0));
    }
    return model;
  };
  const Model some = chain(300);
  const CheckMobility counts = check_mobility(build_system(some), stated(some)).counts;
  EXPECT_EQ(counts.method, "sparse factors");
  EXPECT_EQ(counts.rank, 600);
  EXPECT_EQ(counts.mobility, 300);
  EXPECT_EQ(counts.mobility_driven, 300);
  EXPECT_EQ(counts.rank_nearby, -1);
}

// The second body is 0.2 m to the right of its pin and 0.1 m above it: the shortest way back.
TEST(Rank, ClosingMotionIsTheShortest) {
  Model model;
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {body("ball", 1, 1, {{"O", {0, 0}, 0}})};
  put_at(model.bodies[0], 0.2, 0.1, 0);
  model.joints = {joint("pin", "revolute", {"ground", "O"}, {"ball", "O"}, 1e8, 0)};
  const Counted c = counted(model);
  EXPECT_EQ(c.length, 1);  // there is no arm
  const DenseRank rank(c.rows, c.system, c.length, 1e-8);
  EXPECT_EQ(rank.rank(), 2);
  const Eigen::VectorXd back = rank.closing_motion();
  EXPECT_NEAR(back[0], -0.2, 1e-14);
  EXPECT_NEAR(back[1], -0.1, 1e-14);
  EXPECT_NEAR(back[2], 0, 1e-14);
  const Eigen::VectorXd free = rank.free_part(Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(free[0], 0, 1e-14);
  EXPECT_NEAR(free[1], 0, 1e-14);
  EXPECT_NEAR(free[2], 3, 1e-14);
  std::vector<int> rows = rank.independent_rows();
  std::sort(rows.begin(), rows.end());
  EXPECT_EQ(rows, (std::vector<int>{0, 1}));
}

// The root mean square of the arms of two pins, 3 m along x and 4 m along y from the centre of mass. Each pin has one arm.
TEST(ConstraintRows, ArmsAreAveragedBySquares) {
  Model model;
  model.ground = {{"A", {3, 0}, 0}, {"B", {0, 4}, 0}};
  model.bodies = {body("plate", 1, 1, {{"A", {3, 0}, 0}, {"B", {0, 4}, 0}})};
  put_at(model.bodies[0], 0, 0, 0);
  model.joints = {joint("A", "revolute", {"ground", "A"}, {"plate", "A"}, 1e8, 0), joint("B", "revolute", {"ground", "B"}, {"plate", "B"}, 1e8, 0)};
  EXPECT_NEAR(counted(model).length, std::sqrt((9 + 16) / 2.0), 1e-14);
}

TEST(ConstraintRows, SpeakOfTheirComponents) {
  Model model = sample::everything();
  const System system = build_system(model);
  std::set<std::string> names;
  for (const JointData& j : system.joints)
    for (int k = 0; k < Planar::kDof; ++k)
      if (j.held[k] || j.servo >= 0) names.insert((j.servo >= 0 ? "servo" : j.type) + "." + component_name(j, k));
  for (const char* name : {"revolute.x", "revolute.y", "fixed.x", "fixed.y", "fixed.angle", "prismatic.across", "prismatic.angle", "servo.angle"}) EXPECT_TRUE(names.contains(name)) << name;
  JointData strange;
  strange.type = "of another program";
  EXPECT_EQ(component_name(strange, 1), "1");
}

// A slack rope constrains nothing.
TEST(ConstraintRows, ARopeCountsWhenItIsTaut) {
  for (const double length : {1.0, 1.5}) {
    Model model;
    model.ground = {{"O", {0, 0}, 0}};
    model.bodies = {body("ball", 1, 1, {{"C", {0, 0}, 0}})};
    put_at(model.bodies[0], 0, -1, 0);
    model.joints = {joint("rope", "rope", {"ground", "O"}, {"ball", "C"}, 1e8, 0)};
    model.joints[0].geometry["length"] = length;
    EXPECT_EQ(counted(model).rows.size(), length > 1 ? 0u : 1u);
  }
}

}  // namespace
}  // namespace pintle

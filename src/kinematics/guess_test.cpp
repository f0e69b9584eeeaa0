// First guesses along the joint graph, names of loops, and the search that closes them.
#include "kinematics/guess.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "kinematics/position_search.h"
#include "system/build.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using sample::body;
using sample::joint;
using sample::put_at;

Body rod(const std::string& name) { return body(name, 1, 1, {{"L", {-0.5, 0}, 0}, {"R", {0.5, 0}, 0}}); }

// A rod on a ground pin and another on its end, with joints named from either side.
TEST(Guess, PutsBodiesOnTheirNeighboursJoints) {
  for (const bool reversed : {false, true}) {
    Model model;
    model.ground = {{"O", {2, 3}, 0}};
    model.bodies = {rod("a"), rod("b"), rod("c")};
    model.bodies[0].angle = 0.5 * std::numbers::pi;
    const MarkerRef ground{"ground", "O"};
    const auto pin = [&](const char* name, const MarkerRef& first, const MarkerRef& second) {
      return reversed ? joint(name, "revolute", second, first, 1e8, 0) : joint(name, "revolute", first, second, 1e8, 0);
    };
    model.joints = {pin("ab", {"a", "R"}, {"b", "L"}), pin("O", ground, {"a", "L"}), pin("bc", {"b", "R"}, {"c", "L"})};
    const Vecs q = guess_positions(model, build_system(model));
    EXPECT_LT((q[0] - Planar::Vec(2, 3.5, 0.5 * std::numbers::pi)).norm(), 1e-14);
    EXPECT_LT((q[1] - Planar::Vec(2.5, 4, 0)).norm(), 1e-14);
    EXPECT_LT((q[2] - Planar::Vec(3.5, 4, 0)).norm(), 1e-14);
  }
}

// A joint that holds the angle passes it on, through the angles of both markers.
TEST(Guess, AWeldGivesTheAngleOn) {
  Model model;
  model.ground = {{"O", {1, 0}, 0.7}};
  model.bodies = {body("plate", 1, 1, {{"O", {0, 0}, 0.2}}), body("slide", 1, 1, {{"S", {0, 1}, 0.1}})};
  model.bodies[0].markers.push_back({"S", {0, 0}, 0.4});
  model.joints = {joint("weld", "fixed", {"ground", "O"}, {"plate", "O"}, 1e8, 0), joint("way", "prismatic", {"plate", "S"}, {"slide", "S"}, 1e8, 0)};
  const Vecs q = guess_positions(model, build_system(model));
  EXPECT_NEAR(q[0][2], 0.5, 1e-14);
  EXPECT_NEAR(q[1][2], 0.5 + 0.4 - 0.1, 1e-14);
  // Its marker S coincides with the plate's.
  EXPECT_NEAR(q[1][0] - std::sin(q[1][2]), 1, 1e-14);
  EXPECT_NEAR(q[1][1] + std::cos(q[1][2]), 0, 1e-14);
}

// Stated positions stay; a body that no joint leads to is put at the origin, and its neighbours are attached to
// it.
TEST(Guess, StatedPlacesStay) {
  Model model;
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {rod("a"), rod("b"), rod("floating"), rod("beside")};
  put_at(model.bodies[0], 7, 8, 1);
  model.bodies[1].position = Vec2{5, 5};
  model.joints = {joint("O", "revolute", {"ground", "O"}, {"a", "L"}, 1e8, 0), joint("ab", "revolute", {"a", "R"}, {"b", "L"}, 1e8, 0),
                  joint("fb", "revolute", {"floating", "R"}, {"beside", "L"}, 1e8, 0)};
  const Vecs q = guess_positions(model, build_system(model));
  EXPECT_EQ(q[0], Planar::Vec(7, 8, 1));
  EXPECT_EQ(q[1], Planar::Vec(5, 5, 0));
  EXPECT_EQ(q[2], Planar::Vec(0, 0, 0));
  EXPECT_LT((q[3] - Planar::Vec(1, 0, 0)).norm(), 1e-14);
  EXPECT_FALSE(all_positions_stated(model));
  for (Body& b : model.bodies) put_at(b, 0, 0, 0);
  EXPECT_TRUE(all_positions_stated(model));
}

TEST(Guess, VelocitiesAreStatedOrZero) {
  Model model;
  model.bodies = {rod("a"), rod("b")};
  model.bodies[0].velocity = Vec2{1, 2};
  model.bodies[1].spin = 3;
  const Vecs v = stated_velocities(model);
  EXPECT_EQ(v[0], Planar::Vec(1, 2, 0));
  EXPECT_EQ(v[1], Planar::Vec(0, 0, 3));
}

// A moving carriage, an arm on it with nothing stated, and a hand with a stated spin.
TEST(Guess, WhatIsNotStatedMovesWithWhatItHangsOn) {
  Model model;
  model.bodies = {rod("carriage"), rod("arm"), rod("hand")};
  model.bodies[0].velocity = Vec2{40, 0};
  model.bodies[0].spin = 2;
  model.bodies[2].spin = 0;
  put_at(model.bodies[0], 0, 0, 0);
  put_at(model.bodies[1], 1, 0, 0);
  put_at(model.bodies[2], 2, 0, 0);
  model.joints = {joint("shoulder", "revolute", {"carriage", "R"}, {"arm", "L"}, 1e8, 0), joint("wrist", "revolute", {"arm", "R"}, {"hand", "L"}, 1e8, 0)};
  const System system = build_system(model);
  const Vecs v = guess_velocities(model, system, guess_positions(model, system));
  EXPECT_TRUE(v[1].isApprox(Planar::Vec(40, 2, 2), 1e-12)) << v[1].transpose();
  EXPECT_TRUE(v[2].isApprox(Planar::Vec(40, 3, 0), 1e-12)) << v[2].transpose();
}

TEST(LoopThrough, NamesTheJointsAlongIt) {
  Model model = sample::four_bar(1e8, 0);
  // A dyad outside the loop and a motor on one of the loop's pins: neither belongs to the loop.
  model.bodies.push_back(rod("tail"));
  model.bodies[1].markers.push_back({"T", {0, 1}, 0});
  model.joints.push_back(joint("T", "revolute", {"coupler", "T"}, {"tail", "L"}, 1e8, 0));
  model.motors = {sample::motor("drive", "O2", MotorKind::kSpeed, sample::expression("10"))};
  const System system = build_system(model);
  EXPECT_EQ(loop_through(system, "joint A cannot close"), "A, B, O4, O2");
  EXPECT_EQ(loop_through(system, "worst is joint O4 by 1 mm"), "O4, B, A, O2");
  EXPECT_EQ(loop_through(system, "joint T is open"), "T (no other path between its bodies)");
  EXPECT_EQ(loop_through(system, "joint X is open"), "-");
}

// With the crank held the loop closes in two positions, one up and one down; the nearer one is found.
TEST(PositionSearch, ClosesTheNearerWay) {
  Model model = sample::four_bar(1e8, 0);
  System system = build_system(model);
  std::vector<bool> none(static_cast<std::size_t>(system.n_joints()), false);
  Vecs q, exact;
  for (const Body& b : model.bodies) exact.emplace_back((*b.position)[0], (*b.position)[1], *b.angle);
  q = exact;
  q[1] += Planar::Vec(0.05, -0.03, 0.02);
  q[2] += Planar::Vec(-0.01, 0.02, -0.03);
  for (Body& b : model.bodies) b.hold = {false, false, false};
  model.bodies[0].hold = {true, true, true};
  PositionSearch(model, system, none).run(q);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_LT((q[i] - exact[i]).norm(), 1e-12) << i;
  EXPECT_EQ(q[0], exact[0]);
  // Without the pin B the follower stays where it was placed.
  q = exact;
  q[1] += Planar::Vec(0, 0, 0.2);
  std::vector<bool> open = none;
  open[2] = true;
  PositionSearch(model, system, open).run(q);
  EXPECT_LT((q[2] - exact[2]).norm(), 1e-12);
  EXPECT_GT(std::abs(q[1][2] - exact[1][2]), 0.01);
}

// A rod whose length is 1 m at the start and grows: it is assembled with its length at the start.
TEST(PositionSearch, LengthsAreThoseOfTheStart) {
  Model model;
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {body("ball", 1, 1, {{"C", {0, 0}, 0}})};
  put_at(model.bodies[0], 0.9, 0, 0);
  model.joints = {joint("rod", "rod", {"ground", "O"}, {"ball", "C"}, 1e8, 0)};
  model.joints[0].functions.emplace("length", sample::expression("1 + 2*t"));
  const System system = build_system(model);
  Vecs q{Planar::Vec(0.9, 0, 0)};
  PositionSearch(model, system, {false}).run(q);
  EXPECT_NEAR(q[0][0], 1, 1e-12);
  // Between two rods, nearly in line: the first steps go too far and are rejected.
  model.ground.push_back({"P", {1.5, 0}, 0});
  model.joints.push_back(joint("other", "rod", {"ground", "P"}, {"ball", "C"}, 1e8, 0));
  model.joints.back().functions.emplace("length", sample::expression("1 + 3*t"));
  const System two = build_system(model);
  q = {Planar::Vec(0.75, 1e-3, 0)};
  PositionSearch(model, two, {false, false}).run(q);
  EXPECT_NEAR(q[0][0], 0.75, 1e-10);
  EXPECT_NEAR(q[0][1], std::sqrt(1 - 0.75 * 0.75), 1e-10);
}

// Stated coordinates yield a thousand times less.
TEST(PositionSearch, WhatIsStatedGivesWayLess) {
  Model model;
  model.bodies = {body("stated", 1, 1, {{"C", {0, 0}, 0}}), body("left_open", 1, 1, {{"C", {0, 0}, 0}})};
  put_at(model.bodies[0], 0, 0, 0);
  model.joints = {joint("pin", "revolute", {"stated", "C"}, {"left_open", "C"}, 1e8, 0)};
  const System system = build_system(model);
  Vecs q{Planar::Vec(0, 0, 0), Planar::Vec(1, 0, 0)};
  PositionSearch(model, system, {false}).run(q);
  EXPECT_NEAR(q[0][0], q[1][0], 1e-12);
  EXPECT_NEAR(q[0][0], 1e-3, 1e-5);
}

TEST(MechanismSize, IsTheLargestCoordinate) {
  const Model model = sample::four_bar(1e8, 0);
  const System system = build_system(model);
  EXPECT_EQ(mechanism_size(system, Vecs(3, Planar::Vec::Zero())), 6);  // the pin O4
  EXPECT_EQ(mechanism_size(system, {Planar::Vec(0, -9, 0), Planar::Vec::Zero(), Planar::Vec(0, 0, 100)}), 9);
}

}  // namespace
}  // namespace pintle

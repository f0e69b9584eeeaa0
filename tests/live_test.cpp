// Motion in real time, and linkages moved by hand.
#include "pintle/live.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "pintle/read_model.h"
#include "pintle/simulate.h"
#include "tests/large_models.h"

namespace pintle {
namespace {

const std::string kMechanisms = PINTLE_SOURCE_DIR "/mechanisms/";

Model live_mechanism(const std::string& name) { return read_model(kMechanisms + name + ".toml"); }

int body_index(const Model& model, const std::string& name) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (model.bodies[i].name == name) return static_cast<int>(i);
  return -1;
}

std::vector<std::string> all_mechanisms() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kMechanisms))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

double departure(const LiveMotion::Energies& e, double start) { return std::abs(e.kinetic + e.potential + e.dissipated - e.supplied - start); }

double total(const LiveMotion::Energies& e) { return e.kinetic + e.potential + e.dissipated - e.supplied; }

Vec2 world_point(const PlanarPose& pose, const Vec2& point) {
  const double c = std::cos(pose[2]), s = std::sin(pose[2]);
  return {pose[0] + c * point[0] - s * point[1], pose[1] + s * point[0] + c * point[1]};
}

TEST(Live, FollowsTheRunOfTheSameModel) {
  const Model model = live_mechanism("four_bar");
  const Trajectory run = simulate(model);
  LiveMotion live(model);
  const double dt = 1.0 / 60;
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(live.advance(dt)) << live.failure();
  const double t = live.time();
  EXPECT_NEAR(t, 0.5, 1e-9);
  std::size_t row = 0;
  while (row + 1 < run.n_rows() && run.at(row, 0) < t) ++row;
  const double share = (t - run.at(row - 1, 0)) / (run.at(row, 0) - run.at(row - 1, 0));
  const auto between = [&](const std::string& column) {
    const int c = run.column(column);
    return run.at(row - 1, c) + share * (run.at(row, c) - run.at(row - 1, c));
  };
  const std::vector<PlanarPose> poses = live.poses();
  EXPECT_NEAR(poses[1][0], between("body.coupler.x"), 1e-3);
  EXPECT_NEAR(poses[2][2], between("body.follower.angle"), 1e-3);
  const std::vector<JointForce> forces = live.joint_forces();
  const double peak = run.joints[3].peak;
  EXPECT_NEAR(forces[3][0], between("joint.O4.on_follower.fx[world]"), 0.01 * peak);
  EXPECT_NEAR(forces[3][1], between("joint.O4.on_follower.fy[world]"), 0.01 * peak);
}

TEST(Live, KeepsItsEnergyAccountWhilePulled) {
  const Model model = live_mechanism("pendulum");
  LiveMotion live(model);
  const double start = total(live.energies());
  const PlanarPose pose = live.poses()[0];
  double largest = 1e-9;
  for (int i = 0; i < 120; ++i) {
    const double swing = 0.2 * std::sin(0.05 * i);
    live.pull(Pull{0, {0, 0}, {pose[0] + swing, pose[1] + 0.5 * swing}, 0});
    ASSERT_TRUE(live.advance(1.0 / 60)) << live.failure();
    largest = std::max(largest, live.energies().kinetic);
  }
  EXPECT_GT(largest, 1e-4);
  EXPECT_LT(departure(live.energies(), start), 2e-3 * largest);
  live.pull({});
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(live.advance(1.0 / 60)) << live.failure();
  EXPECT_LT(departure(live.energies(), start), 2e-3 * largest);
}

TEST(Live, AHeldLinkComesToThePull) {
  const Model model = live_mechanism("rope_pendulum");
  LiveMotion live(model);
  const PlanarPose pose = live.poses()[0];
  const Vec2 target{pose[0] + 0.05, pose[1] + 0.05};
  for (int i = 0; i < 240; ++i) {
    live.pull(Pull{0, {0, 0}, target, 1e5});
    ASSERT_TRUE(live.advance(1.0 / 60)) << live.failure();
  }
  const PlanarPose end = live.poses()[0];
  EXPECT_NEAR(end[0], target[0], 1e-2);
  EXPECT_NEAR(end[1], target[1], 1e-2);
}

// However hard any body is pulled: no exception, no value that is not finite, and the motion continues when the body is released.
TEST(Live, SurvivesEveryMechanismBeingPulledAbout) {
  for (const std::string& name : all_mechanisms()) {
    if (name == "n_four_bar_40") continue;
    SCOPED_TRACE(name);
    const Model model = live_mechanism(name);
    LiveMotion live(model);
    const int n = static_cast<int>(model.bodies.size());
    for (int i = 0; i < 24; ++i) {
      const int body = i / 6 % n;
      const PlanarPose pose = live.poses()[body];
      const double far = i % 6 == 5 ? 10 : 0.1;
      live.pull(Pull{body, {0.01 * i, 0}, {pose[0] + far * std::cos(i), pose[1] + far * std::sin(i)}, i % 6 == 4 ? 1e6 : 0});
      live.advance(1.0 / 60, 0.2);
      for (const PlanarPose& p : live.poses())
        for (const double x : p) ASSERT_TRUE(std::isfinite(x));
      for (const JointForce& f : live.joint_forces())
        for (const double x : f) ASSERT_TRUE(std::isfinite(x));
    }
    live.pull({});
    const double before = live.time();
    EXPECT_TRUE(live.advance(1.0 / 600, 2)) << live.failure();
    EXPECT_GT(live.time(), before);
  }
}

// After half a second the force is not a number: no step can be taken, not from rest either.
TEST(Live, StaysAsItWasWhereNoStepCanBeMade) {
  LiveMotion live(read_model(PINTLE_SOURCE_DIR "/tests/models/block_with_a_force_that_ends.toml"));
  while (live.advance(0.01)) ASSERT_LT(live.time(), 0.6);
  const double t = live.time(), speed = live.velocities()[0][0];
  const LiveMotion::Energies before = live.energies();
  EXPECT_GT(speed, 0.1);
  EXPECT_FALSE(live.failure().empty());
  EXPECT_FALSE(live.advance(0.01));
  EXPECT_EQ(live.time(), t);
  EXPECT_EQ(live.velocities()[0][0], speed);
  EXPECT_EQ(live.energies().dissipated, before.dissipated);
}

TEST(Live, TakesFewStepsForAFrame) {
  LiveMotion live(live_mechanism("six_bar"));
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(live.advance(1.0 / 60));
  EXPECT_LT(live.steps(), 60u * 5u);
  const PlanarPose pose = live.poses()[0];
  const std::uint64_t before = live.steps();
  for (int i = 0; i < 60; ++i) {
    live.pull(Pull{0, {0, 0}, {pose[0] + 0.001 * i, pose[1]}, 0});
    ASSERT_TRUE(live.advance(1.0 / 60));
  }
  EXPECT_LT(live.steps() - before, 60u * 10u);
}

TEST(Live, RefusesABodyThatIsNotThere) {
  LiveMotion live(live_mechanism("pendulum"));
  EXPECT_THROW(live.pull(Pull{7, {0, 0}, {0, 0}, 0}), std::invalid_argument);
}

TEST(KinematicDrag, ClosesEveryMechanism) {
  for (const std::string& name : all_mechanisms()) {
    SCOPED_TRACE(name);
    KinematicDrag drag(live_mechanism(name));
    EXPECT_TRUE(drag.assemble());
    for (const double gap : drag.gaps()) EXPECT_LT(gap, 1e-4);
  }
}

TEST(KinematicDrag, TurnsACrankByHand) {
  const Model model = live_mechanism("four_bar");
  KinematicDrag drag(model);
  ASSERT_TRUE(drag.assemble());
  const int crank = body_index(model, "crank");
  const Vec2 tip{0.5, 0};
  for (int degree = 60; degree <= 60 + 720; degree += 7) {
    const double angle = degree * std::acos(-1.0) / 180;
    const Vec2 target{std::cos(angle), std::sin(angle)};
    ASSERT_TRUE(drag.assemble(KinematicDrag::Hold{crank, tip, target})) << degree;
    const Vec2 now = world_point(drag.poses()[crank], tip);
    EXPECT_NEAR(now[0], target[0], 1e-3);
    EXPECT_NEAR(now[1], target[1], 1e-3);
  }
}

TEST(KinematicDrag, ReachesAsFarAsTheJointsAllow) {
  const Model model = live_mechanism("four_bar");
  KinematicDrag drag(model);
  ASSERT_TRUE(drag.assemble());
  const int crank = body_index(model, "crank");
  ASSERT_TRUE(drag.assemble(KinematicDrag::Hold{crank, {0.5, 0}, {30, 40}}));
  const Vec2 tip = world_point(drag.poses()[crank], {0.5, 0});
  EXPECT_NEAR(tip[0], 0.6, 0.02);
  EXPECT_NEAR(tip[1], 0.8, 0.02);
}

TEST(KinematicDrag, SaysWhichJointsStayOpen) {
  Model model = live_mechanism("four_bar");
  model.ground[1].position = {60, 0};
  KinematicDrag drag(model);
  EXPECT_FALSE(drag.assemble());
  EXPECT_FALSE(drag.open_joints().empty());
}

}  // namespace
}  // namespace pintle

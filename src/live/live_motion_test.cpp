// Pulled bodies against closed forms, and linkages moved by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "live/mouse_spring.h"
#include "pintle/live.h"
#include "system/build.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using sample::body;
using sample::joint;
using sample::put_at;

// A free block of 2 kg; it starts with 0.5 m/s upwards.
Model free_block() {
  Model model;
  model.gravity = {0, 0};
  model.bodies = {body("block", 2, 0.3, {})};
  put_at(model.bodies[0], 0, 0, 0);
  model.bodies[0].velocity = Vec2{0, 0.5};
  return model;
}

// The spring's end moves from its initial position to the target within the first frame and stays there: x'' = -w^2 (x - u) - 2 z w x',
// integrated in small steps.
double followed(double x, double rate, double from, double to, double w, double z, double frame, double t_end) {
  const int n = 20000;
  const double h = t_end / n;
  const auto accel = [&](double t, double s, double v) { return -w * w * (s - (from + (to - from) * std::min(t / frame, 1.0))) - 2 * z * w * v; };
  for (int i = 0; i < n; ++i) {
    const double t = i * h, k1 = accel(t, x, rate), middle = rate + 0.5 * h * k1, k2 = accel(t + 0.5 * h, x + 0.5 * h * rate, middle);
    x += h * middle;
    rate += h * k2;
  }
  return x;
}

TEST(LivePull, FollowsTheHandLikeADampedOscillator) {
  for (const double stiffness : {0.0, 40.0}) {
    LiveMotion live(free_block());
    const double w = stiffness > 0 ? std::sqrt(stiffness / 2) : 9, frame = 0.02;
    live.pull(Pull{0, {0, 0}, {0.3, -0.2}, stiffness});
    for (int i = 1; i <= 25; ++i) {
      ASSERT_TRUE(live.advance(frame)) << live.failure();
      EXPECT_NEAR(live.time(), i * frame, 1e-9);
      EXPECT_NEAR(live.poses()[0][0], followed(0, 0, 0, 0.3, w, 0.7, frame, i * frame), 1e-4) << i;
      EXPECT_NEAR(live.poses()[0][1], followed(0, 0.5, 0, -0.2, w, 0.7, frame, i * frame), 1e-4) << i;
    }
    // After release it continues to fly.
    live.pull({});
    const PlanarPose before = live.poses()[0], speed = live.velocities()[0];
    ASSERT_TRUE(live.advance(0.1));
    EXPECT_NEAR(live.poses()[0][0], before[0] + 0.1 * speed[0], 1e-9);
    EXPECT_NEAR(live.velocities()[0][1], speed[1], 1e-12);
  }
}

// Held at a corner it turns: that point, not the centre of mass, moves to the hand.
TEST(LivePull, HoldsAPointOfTheBody) {
  LiveMotion live(free_block());
  live.pull(Pull{0, {0.1, 0}, {0.4, 0.3}, 200});
  for (int i = 0; i < 600; ++i) ASSERT_TRUE(live.advance(0.02));
  const PlanarPose at = live.poses()[0];
  EXPECT_NEAR(at[0] + 0.1 * std::cos(at[2]), 0.4, 1e-3);
  EXPECT_NEAR(at[1] + 0.1 * std::sin(at[2]), 0.3, 1e-3);
  const LiveMotion::Energies e = live.energies();
  EXPECT_NEAR(e.kinetic + e.potential + e.dissipated - e.supplied, 0.5 * 2 * 0.25, 1e-3);
}

// The effective mass of a rod on its pin, at its tip, is a third of its mass: it follows with the same 9 rad/s.
TEST(LivePull, FeelsTheMassThatTheJointsLeave) {
  LiveMotion live(sample::pendulum(1e8, 1e4, 0));
  live.pull(Pull{0, {0.5, 0}, {1, 0.01}, 0});
  for (int i = 1; i <= 25; ++i) {
    ASSERT_TRUE(live.advance(0.02)) << live.failure();
    const PlanarPose at = live.poses()[0];
    EXPECT_NEAR(at[1] + 0.5 * std::sin(at[2]), followed(0, 0, 0, 0.01, 9, 0.7, 0.02, 0.02 * i), 1e-5) << i;
  }
}

// Soft mechanisms are pulled softly: with a thousandth of the stiffest joint's stiffness at most.
TEST(LivePull, IsNoStifferThanTheJointsAllow) {
  Model model = free_block();
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies[0].markers = {{"C", {0, 0}, 0}};
  model.bodies[0].velocity = Vec2{0, 0};
  model.joints = {joint("pin", "revolute", {"ground", "O"}, {"block", "C"}, 1000, 50)};
  LiveMotion live(model);
  live.pull(Pull{0, {0, 0}, {1, 0}, 0});
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(live.advance(0.05));
  EXPECT_NEAR(live.poses()[0][0], 1.0 / 1001, 1e-5);  // 1 N/m against 1000
  EXPECT_NEAR(live.joint_forces()[0][0], -1000.0 / 1001, 1e-2);
}

TEST(LiveMotionBudget, OneStepIsMadeWhateverTheBudget) {
  LiveMotion live(free_block());
  ASSERT_TRUE(live.advance(1, 1e-12));
  EXPECT_EQ(live.steps(), 1u);
  EXPECT_LT(live.time(), 1);
  EXPECT_GT(live.time(), 0);
  ASSERT_TRUE(live.advance(1, 1e9));
  EXPECT_GT(live.time(), 1);
  const double now = live.time();
  EXPECT_TRUE(live.advance(0));
  EXPECT_TRUE(live.advance(-1));
  EXPECT_EQ(live.time(), now);
}

// The deflection of a motor's servo is not energy of the joints: the motor has supplied it.
TEST(LiveMotionEnergies, LeaveTheServoOut) {
  Model model = free_block();
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies[0].markers = {{"C", {0, 0}, 0}};
  model.bodies[0].velocity = Vec2{0, 0};
  model.joints = {joint("rail", "prismatic", {"ground", "O"}, {"block", "C"}, 1e6, 1e3)};
  model.motors = {sample::motor("push", "rail", MotorKind::kPosition, sample::expression("0.1*t^2"))};
  LiveMotion live(model);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(live.advance(0.02)) << live.failure();
  const LiveMotion::Energies e = live.energies();
  EXPECT_GT(e.kinetic, 1e-3);
  EXPECT_LT(std::abs(e.potential), 1e-9);
}

TEST(LiveMotionModel, NeedsABody) { EXPECT_THROW(LiveMotion(Model{}), std::invalid_argument); }

TEST(MouseSpring, HoldsAPointAndNoAngle) {
  const JointData pin = mouse_spring("hand", 3, {0.1, 0.2}, 50);
  EXPECT_EQ(pin.at.b, 3);
  EXPECT_EQ(pin.at.M.p, Planar::Point(0.1, 0.2));
  EXPECT_EQ(pin.law.engaged_stiffness(), Planar::Vec(50, 50, 0));
  const Planar::Point at = in_world({1, 2, 0.5 * std::numbers::pi}, {0.1, 0.2});
  EXPECT_NEAR(at.x(), 0.8, 1e-15);
  EXPECT_NEAR(at.y(), 2.1, 1e-15);
  EXPECT_EQ(largest_stiffness(build_system(sample::pendulum(1e6, 5))), 1e6);
  EXPECT_EQ(largest_stiffness(build_system(free_block())), 0);
}

// A rod on a pin: one of its points moves to the hand as far as the pin allows.
TEST(DragByHand, GoesAsFarAsTheJointsAllow) {
  KinematicDrag drag(sample::pendulum(1e6, 5));
  ASSERT_TRUE(drag.assemble());
  for (const Vec2& target : {Vec2{0.6, 0.8}, Vec2{6, 8}, Vec2{0.3, 0.4}}) {
    for (int call = 0; call < 5; ++call) ASSERT_TRUE(drag.assemble(KinematicDrag::Hold{0, {0.5, 0}, target}));  // each call covers part of the way
    const PlanarPose at = drag.poses()[0];
    EXPECT_NEAR(at[0], 0.3, 1e-5);
    EXPECT_NEAR(at[1], 0.4, 1e-5);
    EXPECT_NEAR(at[2], std::atan2(4, 3), 1e-5);
    EXPECT_LT(drag.gaps()[0], 1e-9);
  }
  // A body that does not exist is not held.
  ASSERT_TRUE(drag.assemble(KinematicDrag::Hold{5, {0, 0}, {-1, 0}}));
  EXPECT_NEAR(drag.poses()[0][0], 0.3, 1e-5);
}

TEST(DragByHand, ABodyWithoutJointsGoesWithTheHand) {
  KinematicDrag drag(free_block());
  ASSERT_TRUE(drag.assemble(KinematicDrag::Hold{0, {0.5, 0}, {1.25, -2}}));
  EXPECT_EQ(drag.poses()[0], (PlanarPose{0.75, -2, 0}));
  EXPECT_TRUE(drag.open_joints().empty());
}

}  // namespace
}  // namespace pintle

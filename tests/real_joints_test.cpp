// Mechanisms of the collection with real joints: clearance, contact, friction, films, stops, detents, cylinders, blades. Each runs to its end at two
// tolerances, and the forces of the coarser run are checked against those of the finer one.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "base/constants.h"
#include "bench/joint_errors.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

constexpr double kSmallForce = 1e-4;  // lower limit, as a fraction of the mechanism's largest force, on the force by which a joint is measured

class RealJointsSlow : public testing::TestWithParam<const char*> {};

TEST_P(RealJointsSlow, RunToTheirEndWithinTheTolerance) {
  Model model = reference::mechanism(GetParam());
  model.simulate.tolerance = 1e-3;
  const Trajectory coarse = reference::completed(model);
  model.simulate.tolerance = 1e-5;
  const Trajectory fine = reference::completed(model);
  const std::vector<bench::JointError> errors = bench::joint_errors(model, coarse, fine, kSmallForce);
  ASSERT_FALSE(errors.empty());
  const bench::JointError& worst = bench::worst_of(errors);
  EXPECT_LT(worst.error, 1e-3) << worst.joint;
  for (const LoadSummary& joint : fine.joints) EXPECT_LE(joint.relative_error_estimate, 1e-5) << joint.name;
}

INSTANTIATE_TEST_SUITE_P(Collection, RealJointsSlow,
                         testing::Values("worn_linkage", "scotch_yoke_play", "loose_piston", "cam_follower", "wheel_over_bump", "jaw_coupling", "stick_slip", "conveyor_belt", "bar_clamp", "bollard", "lubricated_crank", "loose_ball_bearing", "door_stops",
                                         "air_cylinder", "excavator_boom", "selector_switch", "parallel_spring_stage", "cross_spring_pendulum"),
                         [](const testing::TestParamInfo<const char*>& one) { return std::string(one.param); });

// A scissor jack whose nut rubs so much that its load does not drive it, with friction in its pins as well: all of it is at rest from the start.
TEST(SelfLockingJack, RestsFromTheStart) {
  const Model jack = parse_model(R"toml(
format = 1
[simulate]
duration = "0.5 s"
[defaults.joint]
friction = "coulomb"
friction_coefficient = 0.15
pin_radius = "8 mm"
[ground.markers]
o = [0, 0]
[body.low]
mass = 1
inertia = 0.01
angle = "40 deg"
position = [0.15, 0.126]
markers.a = [-0.2, 0]
markers.b = [0.2, 0]
markers.c = [0, 0]
[body.high]
mass = 1
inertia = 0.01
angle = "-40 deg"
position = [0.15, 0.126]
markers.b = [0.2, 0]
markers.c = [0, 0]
[body.nut]
mass = 0.5
inertia = 0.001
angle = 0
markers.p = [0, 0]
[joint.foot]
type = "revolute"
between = ["ground.o", "low.a"]
[joint.cross]
type = "revolute"
between = ["low.c", "high.c"]
[joint.pin]
type = "revolute"
between = ["nut.p", "high.b"]
[joint.way]
type = "prismatic"
between = ["ground.o", "nut.p"]
friction_coefficient = 1.4
[force.load]
on = "low.b"
force = [0, -100]
)toml", "jack.toml");
  const Trajectory run = reference::completed(jack);
  EXPECT_EQ(run.counters.events, 0u);
  EXPECT_LT(run.counters.steps, 100u);
  const double weight = 2.5 * kStandardGravity + 100, pushes = reference::value(run, 0, "joint.way.on_nut.fx[world]");
  EXPECT_LT(pushes, -0.5 * weight);
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    EXPECT_NEAR(reference::value(run, i, "joint.way.on_nut.fy[world]") + reference::value(run, i, "joint.foot.on_low.fy[world]"), weight, 1e-6 * weight) << i;
    EXPECT_NEAR(reference::value(run, i, "joint.way.on_nut.fx[world]"), pushes, 1e-6 * weight) << i;
  }
}

}  // namespace
}  // namespace pintle

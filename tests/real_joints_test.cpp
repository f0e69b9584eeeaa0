// Mechanisms of the collection with joints as they are: clearance, contact, friction, films, stops, detents, cylinders, blades. Each runs to its end at two
// tolerances, and the forces of the coarser run are right by those of the finer one.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "bench/joint_errors.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

constexpr double kSmallForce = 1e-4;  // of the mechanism's largest force: what a joint is measured by at least

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

}  // namespace
}  // namespace pintle

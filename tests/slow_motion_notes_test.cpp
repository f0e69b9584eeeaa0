// Joints so slow that a speed which makes their law smooth at rest decides their force.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "pintle/simulate.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::test_model;

bool has_note(const Trajectory& run, const std::string& beginning) {
  return std::any_of(run.notes.begin(), run.notes.end(), [&](const std::string& note) { return note.starts_with(beginning); });
}

// A telescope's axis slips at 1.5 um/s: on the ramp of a law that is smooth at rest up to 1 mm/s it has a hundredth of its friction.
TEST(SlowMotionNotes, SlipsBelowTheTransitionSpeedAreNoted) {
  constexpr const char* kNote = "joint axis slips at 1.46e-06 m/s at most, far below the transition_speed";
  EXPECT_TRUE(has_note(completed(test_model("polar_axis")), kNote));
  EXPECT_FALSE(has_note(completed(test_model("polar_axis", {"joint.axis.friction=\"coulomb\""})), "joint axis slips"));
  EXPECT_FALSE(has_note(completed(test_model("polar_axis", {"joint.axis.transition_speed=5e-6"})), "joint axis slips"));
}

// At 20 um/s against a floor of 1 mm/s the damping is a fiftieth of what the restitution needs. The events tell the true speed.
TEST(SlowMotionNotes, TouchesSlowerThanTheLeastSpeedAreNoted) {
  const Trajectory slow = completed(test_model("slide_drifts_onto_its_stop")), lower = completed(test_model("slide_drifts_onto_its_stop", {"joint.guide.stop_least_speed=1e-6"}));
  EXPECT_TRUE(has_note(slow, "joint guide touches at 2e-05 m/s at most, below its stop_least_speed (0.001 m/s)"));
  EXPECT_NEAR(at_end(slow, "body.slide.vx"), -1.92e-5, 1e-7);
  EXPECT_FALSE(has_note(lower, "joint guide touches"));
  EXPECT_NEAR(at_end(lower, "body.slide.vx"), -0.3 * 2e-5, 1e-9);
}

}  // namespace
}  // namespace pintle

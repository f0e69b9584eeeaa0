// Peaks and RMS values do not depend on the output rows, whatever the joints are. theory/time section 5.1.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

constexpr double kAlike = 1e-5, kNegligible = 1e-4;  // as fractions of a joint's peak; of the largest peak of the mechanism

Trajectory with_rows(const std::string& name, double duration, int rows) {
  Model model = reference::mechanism(name);
  if (duration > 0) model.simulate.duration = duration;
  model.simulate.output_step = model.simulate.duration / rows;
  return simulate(model);
}

TEST(PeaksSlow, DoNotDependOnTheRows) {
  struct Case {
    const char* name;
    double duration;  // [s]; 0: its own
  };
  for (const auto& [name, duration] : {Case{"pendulum", 0}, Case{"four_bar", 0}, Case{"gear_train", 0}, Case{"toggle_press", 0}, Case{"six_bar", 0}, Case{"robot_arm", 0}, Case{"weld_beam", 0},
                                       Case{"andrews", 0}, Case{"four_bar_clearance", 0.1}, Case{"cam_follower", 0}, Case{"door_stops", 0}, Case{"crane_bushing", 0}}) {
    const Trajectory few = with_rows(name, duration, 50), many = with_rows(name, duration, 5000);
    double largest = 0;
    for (const LoadSummary& joint : many.joints) largest = std::max(largest, joint.peak);
    for (std::size_t j = 0; j < many.joints.size(); ++j) {
      const LoadSummary &a = few.joints[j], &b = many.joints[j];
      EXPECT_NEAR(a.peak, b.peak, kAlike * std::max(b.peak, kNegligible * largest)) << name << ", " << b.name;
      EXPECT_NEAR(a.rms, b.rms, kAlike * std::max(b.rms, kNegligible * largest)) << name << ", " << b.name;
    }
  }
}

// The works of the single motors add up to that of the account.
TEST(Peaks, MotorsDoTheWorkOfTheAccount) {
  for (const char* name : {"quick_return", "toggle_press"}) {
    const Trajectory run = with_rows(name, name[0] == 'q' ? 0.2 : 0, 20);
    double work = 0;
    for (const MotorSummary& motor : run.motors) work += motor.work;
    EXPECT_NEAR(work, run.energy.supplied, 1e-4 * std::max(std::abs(run.energy.supplied), run.energy.kinetic_peak)) << name;
  }
}

}  // namespace
}  // namespace pintle

// What is apart meets where and when it does, however long the step in which it flies. theory/time Eq. (3.23) and section 7.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/constants.h"
#include "pintle/read_model.h"
#include "pintle/simulate.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

constexpr double kFlightSpeed = 2, kBallRadius = 4e-4, kFlightHeight = 4e-3;

double teeth(double x) {
  const double phase = kTurn * x / 8e-3;
  return 1e-3 * std::sin(phase) + 3e-4 * std::sin(2 * phase);
}

// A ball that is thrown along a row of teeth, over many of which it flies.
Model ball_over_teeth() {
  return parse_model(R"toml(
format = 1
[simulate]
duration = "30 ms"
[ground.markers]
o = [0, 0]
[body.ball]
mass = "20 g"
inertia = "1e-7 kg*m^2"
position = [0, "4 mm"]
velocity = ["2 m/s", 0]
angle = 0
spin = 0
markers.c = [0, 0]
[joint.road]
type = "edge"
between = ["ground.o", "ball.c"]
height = "1 mm*sin(2*pi*x/(8 mm)) + 0.3 mm*sin(4*pi*x/(8 mm))"
roller_radius = "0.4 mm"
from = "-10 mm"
to = "100 mm"
law = "contact"
contact_stiffness = 2e7
contact_exponent = 1
restitution = 0.8
)toml",
                     "ball.toml");
}

// How far the ball is from the teeth on its parabola, by many points of them.
double distance_from_teeth(double t) {
  constexpr int kPoints = 2000;
  constexpr double kReach = 2e-3;  // [m], more than what it is above them near its touch
  const double x = kFlightSpeed * t, y = kFlightHeight - 0.5 * kStandardGravity * t * t;
  if (y < teeth(x)) return -kBallRadius;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = -kPoints; i <= kPoints; ++i) {
    const double d = kReach * i / kPoints;
    nearest = std::min(nearest, std::hypot(d, y - teeth(x + d)));
  }
  return nearest - kBallRadius;
}

double first_touch() {
  double late = 0;
  while (distance_from_teeth(late) > 0) late += 2e-5;
  double early = late - 2e-5;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (early + late);
    (distance_from_teeth(middle) > 0 ? early : late) = middle;
  }
  return late;
}

TEST(ContactFlights, ABallTouchesTheToothThatItsParabolaMeets) {
  constexpr double kOfPoints = 1e-9;  // [s], by their distance
  const double exact = first_touch();
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    Model model = ball_over_teeth();
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    ASSERT_EQ(run.events.size(), 1u);
    EXPECT_EQ(run.events[0].events.at(0).what, "touch");
    EXPECT_NEAR(run.events[0].events[0].t, exact, kOfPoints) << tolerance;
  }
}

// Two dozen touches: the same whatever the tolerance, as far as it says.
TEST(ContactFlights, APawlStrikesTheTeethOverWhichItFlies) {
  const auto run_at = [](const char* tolerance) { return reference::completed(reference::test_model("pawl_over_a_rack", {std::string("simulate.tolerance=") + tolerance})); };
  const Trajectory coarse = run_at("1e-4"), fine = run_at("1e-6");
  for (std::size_t j = 0; j < fine.joints.size(); ++j) EXPECT_NEAR(coarse.joints[j].peak, fine.joints[j].peak, 1e-4 * fine.joints[j].peak) << fine.joints[j].name;
  EXPECT_LT(fine.joints.back().peak, 2000);
}

// A motor jumps, and before a microsecond is over the lever has left its stop: on the way the stop's force falls from all that it was to nothing.
TEST(ContactFlights, ALeverLeavesItsStopAtTheSameInstantWhateverTheTolerance) {
  std::vector<double> left, struck;
  for (const char* tolerance : {"1e-5", "1e-6", "1e-7"}) {
    const Trajectory run = simulate(reference::test_model("lever_off_its_stop", {std::string("simulate.tolerance=") + tolerance}));
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    ASSERT_FALSE(run.events.empty());
    for (const JointEvent& event : run.events[0].events) {
      if (event.what == "force vanishes at the upper stop") left.push_back(event.t);
      if (event.what == "touch of the lower stop" && struck.size() < left.size()) struck.push_back(event.t);
    }
  }
  ASSERT_EQ(left.size(), 3u);
  ASSERT_EQ(struck.size(), 3u);
  EXPECT_NEAR(left[0], left[2], 1e-12);
  EXPECT_NEAR(left[1], left[2], 1e-12);
  EXPECT_NEAR(struck[0], struck[2], 1e-9);
  EXPECT_NEAR(struck[1], struck[2], 1e-10);
}

}  // namespace
}  // namespace pintle

// Coulomb's friction where it sticks: it goes on with the force that it slipped with.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;

// A mass of 2 kg that a spring of k pulls along the floor, whose far end moves at a speed; of 10 m/s^2.
Model pulled_slider(double k, double speed, double kinetic, double stuck, double duration) {
  Model model = parse_model(reference::pulled_mass(10, fmt::format("friction = \"coulomb\"\nfriction_coefficient = {}\nstatic_friction = {}\n", kinetic, stuck), 2, k, speed), "pulled_slider.toml");
  model.simulate.duration = duration;
  model.simulate.output_step = 0.01;
  return model;
}

// Round numbers, where the speed comes to nothing just as a row or a step ends.
TEST(StickSlip, SticksWithTheFrictionThatItSlippedWith) {
  struct Case {
    double k, speed, kinetic, stuck;
  };
  for (const Case& at : {Case{100, 0.05, 0.3, 0.5}, Case{200, 0.03, 0.2, 0.4}, Case{50, 0.08, 0.1, 0.2}})
    for (const double tolerance : {1e-3, 1e-5}) {
      for (const double row : {0.01, 0.0005}) {
        Model model = pulled_slider(at.k, at.speed, at.kinetic, at.stuck, 6);
        model.simulate.tolerance = tolerance;
        model.simulate.output_step = row;
        const Trajectory run = completed(model);
        ASSERT_EQ(run.events.size(), 1U);
        int sticks = 0;
        double before = -1;
        for (const JointEvent& event : run.events.front().events) {
          if (event.what != "sticks") continue;
          ++sticks;
          EXPECT_NEAR(event.values[0], -20 * at.kinetic, 20 * 1e-4) << event.t << ", k = " << at.k << ", tolerance " << tolerance << ", row " << row;
          EXPECT_GT(event.t, before);
          before = event.t;
        }
        EXPECT_GT(sticks, 0);
      }
    }
}

// A slider that is pulled ever harder breaks loose where the spring of its stiction carries the static friction: V t = F/k + (F - c_t V)/k_t.
TEST(StickSlip, BreaksLooseOnTime) {
  Model model = pulled_slider(100, 0.05, 0.3, 0.4, 2);
  model.simulate.tolerance = 1e-7;
  const Trajectory run = completed(model);
  const double F = 0.4 * 20, k = 100, speed = 0.05, k_t = 1e8;
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events[0].events[0].what, "slips");
  EXPECT_NEAR(run.events[0].events[0].t * speed, F / k + F / k_t, 1e-11);
}

}  // namespace
}  // namespace pintle

// Polar load diagrams of a body that rotates steadily about a pin off its centre of mass: the pin pulls it with m r w^2 along the arm.
#include "results/plots/run_polar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pintle/simulate.h"
#include "results/sample_run_for_tests.h"

namespace pintle {
namespace {

constexpr double kSpunMass = 2, kArm = 0.5, kSpin = 3, kForce = kSpunMass * kArm * kSpin * kSpin, kAxis = 0.3;

RunRecord turning() {
  Model model;
  model.name = "Turning";
  model.gravity = {0, 0};
  model.simulate.duration = 2 * std::numbers::pi / kSpin;
  model.ground = {{"O", {0, 0}, 0}};
  Body body;
  body.name = "bob";
  body.mass = kSpunMass;
  body.inertia = 0.1;
  body.position = Vec2{kArm, 0};
  body.angle = 0;
  body.velocity = Vec2{0, kArm * kSpin};
  body.spin = kSpin;
  body.markers = {{"O", {-kArm, 0}, kAxis}};
  model.bodies.push_back(body);
  Joint pin;
  pin.name = "pin";
  pin.type = "revolute";
  pin.first = {"ground", "O"};
  pin.second = {"bob", "O"};
  model.joints.push_back(pin);
  RunRecord run;
  run.stamp.model_name = model.name;
  run.trajectory = simulate(model);
  return run;
}

TEST(RunPolar, ForceStandsStillInTheAxesOfWhatTurnsWithIt) {
  const RunRecord run = turning();
  const PolarPlot plot = make_polar_plot({{"", &run}}, "pin");
  ASSERT_EQ(plot.panels.size(), 3U);
  const PolarCurve &world = plot.panels[0].curves.at(0), &first = plot.panels[1].curves.at(0), &second = plot.panels[2].curves.at(0);
  ASSERT_EQ(second.x.size(), run.trajectory.n_rows());
  for (std::size_t i = 0; i < second.x.size(); ++i) {
    const double angle = kSpin * run.trajectory.at(i, 0);
    EXPECT_NEAR(world.x[i], -kForce * std::cos(angle), 1e-3 * kForce);
    EXPECT_NEAR(world.y[i], -kForce * std::sin(angle), 1e-3 * kForce);
    EXPECT_NEAR(first.x[i], -world.x[i], 1e-9 * kForce);  // the ground's marker has the world's axes
    EXPECT_NEAR(first.y[i], -world.y[i], 1e-9 * kForce);
    EXPECT_NEAR(second.x[i], -kForce * std::cos(kAxis), 1e-3 * kForce);  // along the arm, relative to which the marker's axes are rotated
    EXPECT_NEAR(second.y[i], kForce * std::sin(kAxis), 1e-3 * kForce);
  }
  const std::string svg = to_svg(plot);
  EXPECT_NE(svg.find("Force on bob"), std::string::npos);
  EXPECT_NE(svg.find("axes of its marker on ground"), std::string::npos);
  EXPECT_NE(svg.find("peak 9.00"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(RunPolar, RunsAreOverlaid) {
  const RunRecord run = turning();
  const PolarPlot plot = make_polar_plot({{"one", &run}, {"other", &run}}, "pin");
  ASSERT_EQ(plot.panels[0].curves.size(), 2U);
  EXPECT_EQ(plot.panels[0].curves[1].label, "other");
}

TEST(RunPolar, WantsAPin) {
  const RunRecord run{sample::stamp(), sample::trajectory()};
  EXPECT_THROW(make_polar_plot({{"", &run}}, "slide"), PlotRequestError);
  try {
    make_polar_plot({{"", &run}}, "slid");
    FAIL();
  } catch (const PlotRequestError& error) {
    EXPECT_NE(std::string(error.what()).find("slide"), std::string::npos);
  }
}

}  // namespace
}  // namespace pintle

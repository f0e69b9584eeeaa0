// Wear of a pin with clearance and of its bush, around both of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "results/bearing_text.h"
#include "results/plots/run_polar.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;
using reference::mechanism;

// A disc of 2 kg whose pin hangs in its bush and turns in it ten times.
Model spinning_disc() {
  return parse_model(R"toml(
format = 1
[simulate]
duration = "2 s"
output_step = "0.2 s"
[ground.markers]
o = [0, 0, "2 deg"]
[body.disc]
mass = 2
inertia = 0.01
position = [0, 0]
angle = 0
spin = "10*pi"
markers.o = [0, 0]
[joint.pin]
type = "revolute"
between = ["ground.o", "disc.o"]
law = "clearance"
clearance = "0.1 mm"
pin_radius = "10 mm"
restitution = 0.1
[joint.pin.bearing]
pin_diameter = "20 mm"
pin_length = "25 mm"
wear_coefficient = "1e-15 m^2/N"
)toml",
                     "disc.toml");
}

double sum(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); }

// The bush is worn below the pin, in the directions from 265 to 275 degrees, and the pin all around. By the balance of momentum, the contact has carried the
// weight: W = R w m g T.
TEST(Wear, APinThatTurnsInItsBushWearsTheBottomOfTheBushAndAllOfItself) {
  const Trajectory run = completed(spinning_disc());
  ASSERT_EQ(run.wear.size(), 1U);
  const JointWear& wear = run.wear.front();
  ASSERT_EQ(wear.bush.size(), 72U);
  const double work = 0.01 * 10 * std::numbers::pi * 2 * 9.80665 * 2;
  EXPECT_NEAR(sum(wear.bush), work, 1e-4 * work);
  EXPECT_NEAR(sum(wear.pin), work, 1e-4 * work);
  EXPECT_NEAR(wear.bush[53], work, 1e-4 * work);  // the axis of the bush's marker is turned by 2 degrees: 268 degrees in it
  const auto [least, most] = std::minmax_element(wear.pin.begin(), wear.pin.end());
  EXPECT_GT(*least, 0.8 * work / 72);
  EXPECT_LT(*most, 1.2 * work / 72);
  const BearingSummary& bearing = run.bearings.front();
  const double depth = 1e-15 * wear.bush[53] / (0.01 * (5 * std::numbers::pi / 180) * 0.025);
  EXPECT_NEAR(bearing.bush_depth, depth, 1e-12 * depth);
  EXPECT_NEAR(bearing.bush_depth_angle, 267.5 * std::numbers::pi / 180, 1e-12);
}

TEST(Wear, IsTheIntegralOfItsPower) {
  const Trajectory run = completed(mechanism("slider_crank_clearance", {"simulate.duration=\"4 ms\"", "simulate.output_step=\"1 us\""}));
  ASSERT_EQ(run.wear.size(), 1U);
  const int power = run.column("joint.B.wear_power");
  double work = 0;
  for (std::size_t i = 0; i + 1 < run.n_rows(); ++i)
    work += 0.5 * (run.at(i + 1, 0) - run.at(i, 0)) * (run.at(i, static_cast<std::size_t>(power)) + run.at(i + 1, static_cast<std::size_t>(power)));
  EXPECT_NEAR(sum(run.wear.front().bush), work, 3e-3 * work);
  EXPECT_NEAR(sum(run.wear.front().pin), sum(run.wear.front().bush), 1e-12 * work);
}

TEST(Wear, IsToldAndDrawn) {
  Trajectory run = completed(spinning_disc());
  const BearingTable table = wear_table(run.wear);
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows.front().joint, "pin");
  EXPECT_EQ(table.rows.front().values[1], 267.5);
  RunRecord record;
  record.trajectory = std::move(run);
  const PolarPlot plot = make_wear_plot({{"", &record}}, "pin");
  ASSERT_EQ(plot.panels.size(), 2U);
  EXPECT_NE(to_svg(plot).find("Bush on ground"), std::string::npos);
  record.trajectory.wear.clear();
  EXPECT_THROW(make_wear_plot({{"", &record}}, "pin"), PlotRequestError);
}

TEST(Wear, OfAPinWithoutClearanceIsNotTold) {
  const Trajectory run = completed(mechanism("four_bar", {"joint.A.bearing={ pin_diameter = \"20 mm\", pin_length = \"20 mm\", wear_coefficient = \"1e-15 m^2/N\" }", "simulate.duration=\"10 ms\""}));
  EXPECT_TRUE(run.wear.empty());
  ASSERT_EQ(run.bearings.size(), 1U);
  ASSERT_FALSE(run.bearings.front().remarks.empty());
  EXPECT_NE(run.bearings.front().remarks.back().find("law = \"clearance\""), std::string::npos);
}

// A loaded pin that a servo swings by 0.8 rad and back without friction: each sector passed twice carries 2 F R times its width, the last one in proportion to its part.
TEST(Wear, SectorsOfASwingCarryTheirPartOfTheWay) {
  Model model = reference::shaft_in_bush(0, 0, "position = \"0.4*(1-cos(2*pi*t/1 s))\"", 1);
  const double width = 2 * std::numbers::pi / 72, whole = 2 * 400 * 0.012 * width, last = 2 * 400 * 0.012 * (0.8 - 9 * width);
  for (const double tolerance : {1e-3, 1e-5}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    const std::vector<double>& pin = run.wear.front().pin;
    std::vector<double> worn;
    for (const double work : pin)
      if (work > 1e-4) worn.push_back(work);
    ASSERT_EQ(worn.size(), 10U);
    std::sort(worn.begin(), worn.end());
    EXPECT_NEAR(worn.front(), last, 2e-3 * last) << tolerance;
    for (std::size_t i = 1; i < worn.size(); ++i) EXPECT_NEAR(worn[i], whole, 1e-3 * whole) << tolerance;
  }
}

}  // namespace
}  // namespace pintle

#include "results/plots/svg_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "results/plots/plot_ticks.h"
#include "results/plots/run_plot.h"
#include "results/plots/thin_line.h"
#include "results/sample_run_for_tests.h"

namespace pintle {
namespace {

bool svg_holds(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

PlotRequest request_for(std::vector<std::string> joints, std::vector<std::string> columns, const std::string& on = "") {
  PlotRequest request;
  request.joints = std::move(joints);
  request.columns = std::move(columns);
  request.on = on;
  return request;
}

// A line at zero is drawn if there are values on both sides of it.
TEST(SvgPlot, ZeroIsDrawnBetweenSigns) {
  const auto drawn = [](double low, double high, bool log) {
    Plot plot;
    plot.panels.push_back({"force", "N", {}});
    plot.panels[0].log_y = log;
    plot.panels[0].curves.push_back({"a", "", {}});
    plot.panels[0].curves[0].x = {0, 1};
    plot.panels[0].curves[0].y = {low, high};
    return svg_holds(to_svg(plot), "stroke=\"#999\"");
  };
  EXPECT_TRUE(drawn(-1, 2, false));
  EXPECT_FALSE(drawn(1, 2, false));
  EXPECT_FALSE(drawn(1, 2, true));
  EXPECT_FALSE(drawn(-2, -1, false));
}

TEST(PlotTicks, StepsAreRoundAndCoverTheData) {
  for (const double size : {1e-9, 0.37, 1.0, 63.0, 4.4e7})
    for (const double offset : {-3.0, -0.5, 0.0, 0.01, 100.0}) {
      const double low = size * offset, high = low + size;
      const Axis axis = make_axis(low, high, 6, false);
      EXPECT_LE(axis.low, low);
      EXPECT_GE(axis.high, high);
      EXPECT_GE(axis.ticks().size(), 4U) << low << " " << high;
      EXPECT_LE(axis.ticks().size(), 11U) << low << " " << high;
      const double digit = axis.step / std::pow(10, std::floor(std::log10(axis.step) + 1e-9));
      EXPECT_TRUE(std::abs(digit - 1) < 1e-9 || std::abs(digit - 2) < 1e-9 || std::abs(digit - 5) < 1e-9) << digit;
    }
}

TEST(PlotTicks, ConstantDataGetRoom) {
  for (const double value : {0.0, 5.0, -1e-12, 1e300}) {
    const Axis axis = make_axis(value, value, 6, true);
    EXPECT_LT(axis.low, value);
    EXPECT_GT(axis.high, value);
    EXPECT_LT(axis.ticks().size(), 12U);
  }
}

TEST(PlotTicks, DecadesCoverTheData) {
  const Axis axis = make_log_axis(3e-7, 2e4, 8);
  EXPECT_EQ(axis.low, -7);
  EXPECT_EQ(axis.high, 5);
  EXPECT_LE(axis.ticks().size(), 9U);
  EXPECT_EQ(axis.label(-3), "10⁻³");
  EXPECT_DOUBLE_EQ(axis.share(1e-7), 0);
  EXPECT_DOUBLE_EQ(axis.share(1e-1), 0.5);
  EXPECT_DOUBLE_EQ(axis.share(1e5), 1);
  for (const double value : {0.0, -1.0}) EXPECT_TRUE(std::isnan(axis.share(value)));
  for (const double whole : {1e-3, 1.0, 1e8}) {
    const Axis one = make_log_axis(whole, whole, 8);
    EXPECT_EQ(one.low, std::log10(whole));
    EXPECT_EQ(one.ticks().size(), 2U);
  }
}

TEST(PlotTicks, LabelsShowWhatTheStepNeeds) {
  EXPECT_EQ(tick_text(0.3, 0.1), "0.3");
  EXPECT_EQ(tick_text(-0.25, 0.05), "−0.25");
  EXPECT_EQ(tick_text(1e-17, 0.1), "0.0");
  EXPECT_EQ(tick_text(200, 100), "200");
}

TEST(PlotTicks, BigAndSmallNumbersGetAPrefix) {
  EXPECT_EQ(scale_for(300, "N").unit, "N");
  EXPECT_EQ(scale_for(3e4, "N").unit, "kN");
  EXPECT_EQ(scale_for(3e4, "N").factor, 1e3);
  EXPECT_EQ(scale_for(2e-3, "m").unit, "mm");
  EXPECT_EQ(scale_for(0.02, "s").unit, "ms");
  EXPECT_EQ(scale_for(2e4, "s").unit, "10³ s");
  EXPECT_EQ(scale_for(2e5, "rad/s").unit, "10³ rad/s");
  EXPECT_EQ(scale_for(0, "N").factor, 1);
  EXPECT_EQ(printed_unit("kg*m^2*s^-1"), "kg·m²·s⁻¹");
}

TEST(ThinLine, KeepsEveryPeakOfALongSeries) {
  std::vector<Point> points;
  for (int i = 0; i < 100000; ++i) points.push_back({i * 0.007, std::sin(0.3 * i)});
  points[54321].y = 50;
  points[77777].y = -50;
  const std::vector<Point> kept = thin_line(points, 0.5);
  EXPECT_LT(kept.size(), 4 * 1402U);
  const auto [low, high] = std::minmax_element(kept.begin(), kept.end(), [](auto& a, auto& b) { return a.y < b.y; });
  EXPECT_EQ(high->x, points[54321].x);
  EXPECT_EQ(low->x, points[77777].x);
  EXPECT_EQ(kept.front().x, points.front().x);
  EXPECT_EQ(kept.back().x, points.back().x);
}

TEST(ThinLine, StaysCloseToAWanderingLine) {
  std::vector<Point> points;
  for (int i = 0; i < 10000; ++i) points.push_back({100 * std::cos(1e-3 * i), 100 * std::sin(1e-3 * i)});
  const std::vector<Point> kept = thin_line(points, 0.5);
  EXPECT_LT(kept.size(), 2001U);
  EXPECT_GT(kept.size(), 1000U);
}

TEST(ThinLine, GapsStayGaps) {
  const double nan = std::nan("");
  for (const double turn : {1.0, -1.0}) {  // monotonically rising x, and not
    const std::vector<Point> points{{0, 0}, {1, 1}, {2, nan}, {3, nan}, {4, 1}, {4 + turn, 2}};
    const std::vector<Point> kept = thin_line(points, 0.1);
    ASSERT_EQ(kept.size(), 5U);
    EXPECT_TRUE(std::isnan(kept[2].y));
  }
  EXPECT_TRUE(thin_line({}, 0.5).empty());
}

TEST(SvgPlot, EscapesNamesAndSurvivesEmptyAndBadData) {
  Plot plot;
  plot.title = "A & <B>";
  plot.subtitle = "\"q\"\x01";
  EXPECT_TRUE(svg_holds(to_svg(plot), "A &amp; &lt;B&gt;"));
  EXPECT_FALSE(svg_holds(to_svg(plot), "\x01"));
  const double inf = std::numeric_limits<double>::infinity();
  plot.x = {0, 1, 2, 3};
  plot.panels = {{"F", "N", {{"F", "x", {1, std::nan(""), inf, 2}}}}, {"empty", "", {{"e", "", {}}}}};
  const std::string svg = to_svg(plot);
  EXPECT_FALSE(svg_holds(svg, "nan"));
  EXPECT_FALSE(svg_holds(svg, "inf"));
  EXPECT_TRUE(svg_holds(svg, "F [N]"));
}

TEST(SvgPlot, PowersOfTenLieOnAStraightLineOfLogAxes) {
  Plot plot;
  plot.log_x = true;
  plot.x = {1, 10, 100, 1000};
  plot.panels = {{"F", "N", {{"F", "x", {1e-2, 1, 1e2, -1}, true}}, true}};  // the last point cannot be drawn
  std::vector<double> x, y;
  const std::string svg = to_svg(plot);
  for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) {
    x.push_back(std::stod(svg.substr(svg.find("cx=\"", at) + 4)));
    y.push_back(std::stod(svg.substr(svg.find("cy=\"", at) + 4)));
  }
  ASSERT_EQ(x.size(), 3U);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.011);
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.011);
  EXPECT_LT(y[2], y[0]);
  EXPECT_TRUE(svg_holds(svg, "10²"));
}

TEST(SvgPlot, ACurveMayChooseItsLine) {
  Plot plot;
  plot.x = {1, 2};
  plot.panels = {{"F", "N", {{"A", "", {1, 2}}, {"B", "", {2, 3}}}}};
  const auto colours = [](const std::string& svg) { return std::pair{svg_holds(svg, "#0072b2"), svg_holds(svg, "#d55e00")}; };
  EXPECT_EQ(colours(to_svg(plot)), std::pair(true, true));
  EXPECT_FALSE(svg_holds(to_svg(plot), "dasharray"));
  plot.panels[0].curves[1].style = 7;  // the first colour again, dashed
  EXPECT_EQ(colours(to_svg(plot)), std::pair(true, false));
  EXPECT_TRUE(svg_holds(to_svg(plot), "dasharray"));
}

TEST(RunPlot, ForcesOfOneJointNameBodyAndAxes) {
  const RunRecord run{sample::stamp(), sample::trajectory()};
  const Plot plot = make_plot(run, request_for({"O4"}, {}, "ground"));
  EXPECT_EQ(plot.title, "Joint O4: force on ground");
  ASSERT_EQ(plot.panels.size(), 1U);
  EXPECT_EQ(plot.panels[0].quantity, "Force on ground, world axes");
  ASSERT_EQ(plot.panels[0].curves.size(), 3U);
  EXPECT_EQ(plot.panels[0].curves[0].y[7], -run.trajectory.at(7, 1));
  EXPECT_EQ(plot.panels[0].curves[2].y[7], std::hypot(run.trajectory.at(7, 3), run.trajectory.at(7, 4)));
}

TEST(RunPlot, WithoutARequestTheRecordedJointsAreDrawn) {
  const RunRecord run{sample::stamp(), sample::trajectory()};
  ASSERT_EQ(run.trajectory.joints.size(), 2U);  // no column records the slide
  const Plot plot = make_plot(run, {});
  EXPECT_EQ(plot.title, "Joint O4: force on rocker");
  EXPECT_EQ(plot.panels.at(0).curves.size(), 3U);
}

TEST(RunPlot, OfManyJointsTheMostLoadedAreDrawn) {
  RunRecord run{sample::stamp(), sample::trajectory(2)};
  Trajectory& trajectory = run.trajectory;
  trajectory.columns = {{"t", "s", "time"}};
  trajectory.values = {0};
  LoadSummary joint = trajectory.joints.front();
  trajectory.joints.clear();
  for (const char* name : {"A", "B", "C", "D", "E", "F", "G", "H", "not_recorded"}) {
    joint.name = name;
    joint.peak = joint.name == "C" ? 1 : 2;  // the least loaded of nine joints
    trajectory.joints.push_back(joint);
    if (joint.name == "not_recorded") break;
    for (const char* component : {"fx[world]", "fy[world]"}) {
      trajectory.columns.push_back({"joint." + joint.name + ".on_" + joint.second_body + "." + component, "N", "force"});
      trajectory.values.push_back(1);
    }
  }
  std::string drawn;
  const Plot plot = make_plot(run, {});
  for (const Curve& curve : plot.panels.at(0).curves) drawn += curve.label.front();
  EXPECT_EQ(drawn, "ABDEFGH");
}

TEST(RunPlot, LinesGoToPeaksBetweenRows) {
  RunRecord run{sample::stamp(), sample::trajectory()};
  LoadSummary& joint = run.trajectory.joints.front();
  const double first = run.trajectory.at(3, 0), second = run.trajectory.at(4, 0);
  joint.peak = 1e6;
  joint.peak_time = first + (second - first) / 3;
  PlotRequest request = request_for({joint.name}, {});
  request.components = {"magnitude"};
  const Curve curve = make_plot(run, request).panels.at(0).curves.at(0);
  ASSERT_EQ(curve.x.size(), run.trajectory.n_rows() + 1);
  EXPECT_EQ(curve.x[4], joint.peak_time);
  EXPECT_EQ(curve.y[4], 1e6);
  EXPECT_EQ(curve.x[5], second);
}

TEST(RunPlot, CouplesHaveTheErrorOfCouples) {
  RunRecord run{sample::stamp(), sample::trajectory(2)};
  Trajectory& trajectory = run.trajectory;
  trajectory.joints[1].moment_error_estimate = 3e-5;
  trajectory.columns = {{"t", "s", "time"}, {"joint.slide.on_block.m[world]", "N*m", "couple"}};
  trajectory.values = {0, 1, 1, 2};
  PlotRequest request = request_for({"slide"}, {});
  request.components = {"moment"};
  EXPECT_EQ(make_plot(run, request).panels.at(0).curves.at(0).band, 3e-5);
}

TEST(RunPlot, RunsInOnePlotShareWhatHasTheirUnit) {
  const RunRecord run{sample::stamp(), sample::trajectory()};
  const Plot forces = make_plot(run, request_for({"O4"}, {})), angle_first = make_plot(run, request_for({}, {"joint.O4.angle", "joint.O4.on_ground.fx[world]"}));
  const Plot both = overlay({{"a", forces}, {"b", angle_first}});
  ASSERT_EQ(both.panels.size(), 2U);
  EXPECT_EQ(both.panels[0].unit, "N");
  ASSERT_EQ(both.panels[0].curves.size(), forces.panels[0].curves.size() + 1);
  EXPECT_EQ(both.panels[0].curves.back().label, "b: joint.O4.on_ground.fx[world] (joint.O4.on_ground.fx[world])");
  EXPECT_EQ(both.panels[1].unit, "rad");
}

TEST(RunPlot, ColumnsUnderTheModelsNameWhereNoOtherIsGiven) {
  const RunRecord run{sample::stamp(), sample::trajectory()};
  const Plot plot = make_plot(run, request_for({}, {"joint.O4.angle", "joint.O4.on_ground.fx[world]"}));
  EXPECT_EQ(plot.title, run.stamp.model_name);
  EXPECT_EQ(plot.subtitle, "");
}

TEST(RunPlot, UnitsShareOrSplitPanels) {
  const RunRecord run{sample::stamp(), sample::trajectory()};
  const Plot plot = make_plot(run, request_for({"O4"}, {"joint.O4.angle", "joint.O4.on_ground.fx[world]"}));
  ASSERT_EQ(plot.panels.size(), 2U);
  EXPECT_EQ(plot.panels[0].curves.size(), 4U);
  EXPECT_EQ(plot.panels[1].unit, "rad");
}

TEST(SvgPlot, BandIsDrawnWhereItCanBeSeen) {
  Plot plot;
  plot.x_quantity = "Time";
  plot.x_unit = "s";
  plot.x = {0, 1, 2};
  plot.panels = {{"Force", "N", {{"F", "", {0, 10, 5}}}}};
  EXPECT_EQ(to_svg(plot).find("fill-opacity"), std::string::npos);
  plot.panels[0].curves[0].band = 1e-6;
  EXPECT_EQ(to_svg(plot).find("fill-opacity"), std::string::npos);
  plot.panels[0].curves[0].band = 1;
  EXPECT_NE(to_svg(plot).find("fill-opacity"), std::string::npos);
}

// The axis includes the error of a force that is zero except for roundoff: the roundoff is not magnified, and the band is not cut.
TEST(SvgPlot, BandFarWiderThanTheDataStaysInTheFrame) {
  Plot plot;
  plot.x = {0, 1, 2};
  plot.panels = {{"Force", "N", {{"F", "", {0, 1e-12, std::nan("")}}}}};
  plot.panels[0].curves[0].band = 0.5;
  const std::string svg = to_svg(plot);
  std::size_t at = svg.find("d=\"M", svg.find("fill-opacity")) + 3;
  int points = 0;
  for (const std::size_t end = svg.find('"', at); at < end && svg[at] != 'Z'; ++points) {
    std::size_t used = 0;
    const double x = std::stod(svg.substr(at + 1), &used);
    at += 1 + used;
    const double y = std::stod(svg.substr(at), &used);
    at += used;
    EXPECT_GT(x, 0);
    EXPECT_LT(x, plot.width);
    EXPECT_GT(y, 0);
    EXPECT_LT(y, plot.panel_height + 40);
  }
  EXPECT_EQ(points, 4);
  EXPECT_TRUE(svg_holds(svg, ">0.4<"));
}

}  // namespace
}  // namespace pintle

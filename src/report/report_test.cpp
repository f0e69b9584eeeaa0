#include "pintle/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "report/drawn_run_for_tests.h"
#include "report/page_data.h"
#include "report/page_tables.h"
#include "report/still.h"

namespace pintle {
namespace {

using drawn::run_of;
using drawn::run_of_mechanism;
using Json = nlohmann::json;

bool holds(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

Json data_of(const std::string& html) {
  const std::string begin = "<script type=\"application/json\" id=\"run\">";
  const std::size_t from = html.find(begin) + begin.size();
  return Json::parse(html.substr(from, html.find("</script>", from) - from));
}

std::vector<double> numbers(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  std::uint32_t bits = 0;
  int n_bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    n_bits += 6;
    if (n_bits < 8) continue;
    n_bits -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> n_bits));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = 0;
    for (std::size_t k = 8; k-- > 0;) word = word << 8 | bytes[i + k];
    values.push_back(std::bit_cast<double>(word));
  }
  return values;
}

TEST(Report, CarriesTheNumbersOfTheRunBitByBit) {
  const auto [model, run] = run_of_mechanism("four_bar");
  const Trajectory& trajectory = run.trajectory;
  const Json data = data_of(report_html(model, run));
  EXPECT_EQ(data["rows"], trajectory.n_rows());
  for (const Json& column : data["columns"]) {
    const int place = trajectory.column(column["name"]);
    ASSERT_GE(place, 0) << column["name"];
    const std::vector<double> values = numbers(column["data"]);
    ASSERT_EQ(values.size(), trajectory.n_rows());
    for (std::size_t row = 0; row < values.size(); ++row)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(values[row]), std::bit_cast<std::uint64_t>(trajectory.at(row, static_cast<std::size_t>(place))));
  }
}

TEST(Report, LeavesOutWhatFollowsFromOthers) {
  const auto [model, run] = run_of_mechanism("four_bar");
  const Json data = data_of(report_html(model, run));
  for (const Json& column : data["columns"]) {
    EXPECT_FALSE(holds(column["name"], ".f1[joint]"));
    EXPECT_FALSE(holds(column["name"], "on_ground.f"));
  }
  EXPECT_EQ(data["joints"].size(), 4u);
  for (const Json& joint : data["joints"]) EXPECT_GE(joint["fx"], 1);
}

TEST(Report, NeedsNothingFromElsewhere) {
  const auto [model, run] = run_of_mechanism("andrews");
  const std::string html = report_html(model, run);
  EXPECT_FALSE(holds(html, "http:")) << html.substr(html.find("http:"), 80);
  EXPECT_FALSE(holds(html, "https:"));
  for (const char* outside : {"src=", "<link", "@import", "url(", "fetch(", "import("}) EXPECT_FALSE(holds(html, outside)) << outside;
  EXPECT_TRUE(holds(html, "default-src 'none'"));
}

TEST(Report, NamesCannotBreakOut) {
  auto [model, run] = run_of_mechanism("pendulum");
  const std::string nasty = "</script><b onload=\"x\">'&";
  model.name = run.stamp.model_name = run.stamp.command_line = run.stamp.model_text = model.description = nasty;
  run.trajectory.notes.push_back(nasty);
  run.trajectory.message = nasty;
  run.trajectory.outcome = Outcome::kFailed;
  run.trajectory.joints[0].name = nasty;
  run.trajectory.columns[1].name = nasty;
  const std::string html = report_html(model, run);
  EXPECT_FALSE(holds(html, "<b onload"));
  EXPECT_EQ(count(html, "</script>"), 2u);
  EXPECT_EQ(data_of(html)["name"], nasty);
  EXPECT_TRUE(holds(html, "&lt;/script&gt;&lt;b onload=&quot;x&quot;&gt;'&amp;"));
}

TEST(Report, RunThatFailedSaysWhereAndWhen) {
  const auto [model, run] = run_of(R"toml(format = 1
name = "Burst"
[simulate]
duration = 2
[ground.markers]
O = [0, 0]
[body.bob]
mass = 1
inertia = 0.1
position = [1, 0]
angle = 0
markers.O = [-1, 0]
[joint.pin]
type = "revolute"
between = ["ground.O", "bob.O"]
[force.burst]
on = "bob.O"
torque = "1e3/max(0, 0.1 - t)"
)toml");
  ASSERT_EQ(run.trajectory.outcome, Outcome::kFailed);
  ASSERT_GT(run.trajectory.n_rows(), 1u);
  const std::string html = report_html(model, run);
  EXPECT_TRUE(holds(html, "class=\"verdict bad\""));
  EXPECT_TRUE(holds(html, "The computation failed at t = ")) << verdict_on(run.trajectory).text;
  EXPECT_TRUE(holds(html, run.trajectory.message.substr(0, 20)));
  EXPECT_EQ(data_of(html)["rows"], run.trajectory.n_rows());
}

TEST(Report, PinsTellWhoseAxesTheirPolarDiagramMayHave) {
  const drawn::DrawnRun drawn = run_of_mechanism("four_bar");
  const Json data = data_of(report_html(drawn.model, drawn.run));
  const Json& pin = data["joints"][3]["pin"];
  EXPECT_EQ(pin["first"]["marker"], "ground.O4");
  EXPECT_EQ(pin["first"]["body"], kWorld);
  EXPECT_EQ(pin["second"]["on"], "follower");
  EXPECT_EQ(data["scene"]["bodies"][pin["second"]["body"].get<std::size_t>()]["name"], "follower");
  EXPECT_DOUBLE_EQ(pin["second"]["axis"].get<double>(), 0);
  const drawn::DrawnRun shaper = run_of_mechanism("quick_return");
  const Json joints = data_of(report_html(shaper.model, shaper.run))["joints"];
  for (std::size_t i = 0; i < joints.size(); ++i) EXPECT_EQ(joints[i].contains("pin"), shaper.model.joints[i].type == "revolute") << joints[i]["name"];
}

TEST(Report, BearingsHaveATableOfTheirOwn) {
  EXPECT_FALSE(holds(report_html(run_of_mechanism("four_bar").model, run_of_mechanism("four_bar").run), "id=\"bearings\""));
  const drawn::DrawnRun drawn = run_of(read_file(PINTLE_SOURCE_DIR "/mechanisms/four_bar.toml") + "\n[joint.B.bearing]\ntype = \"roller\"\ndynamic_load_rating = \"5 kN\"\n");
  const std::string html = report_html(drawn.model, drawn.run);
  EXPECT_TRUE(holds(html, "id=\"bearings\""));
  EXPECT_TRUE(holds(html, "L10h"));
  EXPECT_TRUE(holds(html, "joint B: state static_load_rating (C0) for a static safety"));
}

TEST(Report, VerdictNamesTheWorstJoint) {
  auto [model, run] = run_of_mechanism("four_bar");
  EXPECT_EQ(verdict_on(run.trajectory).kind, Verdict::kGood);
  run.trajectory.joints[2].relative_error_estimate = 3e-4;
  run.trajectory.joints[1].relative_error_estimate = 2e-4;
  const Verdict verdict = verdict_on(run.trajectory);
  EXPECT_EQ(verdict.kind, Verdict::kDoubtful);
  EXPECT_EQ(verdict.text, "2 joint forces miss the tolerance of 10⁻⁵ of the peak; largest estimated error: 3.0·10⁻⁴ of its peak, at B.");
  EXPECT_EQ(count(force_table(run.trajectory), "class=\"missed\""), 2u);
  run.trajectory.joints[0].relative_error_estimate = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict_on(run.trajectory).kind, Verdict::kDoubtful);
}

// A finer integration that failed leaves no estimates; nothing may claim that they are zero.
TEST(Report, VerdictWithoutEstimatesSaysSo) {
  auto [model, run] = run_of_mechanism("four_bar");
  for (LoadSummary& joint : run.trajectory.joints) joint.error_estimate = joint.moment_error_estimate = joint.relative_error_estimate = 0;
  run.trajectory.outcome = Outcome::kToleranceNotMet;
  run.trajectory.message = "no step from t = 0.1 s";
  EXPECT_EQ(verdict_on(run.trajectory).text,
            "The tolerance of 10⁻⁵ was not reached: no step from t = 0.1 s; the joint forces have no error estimate.");
  EXPECT_EQ(verdict_on(run.trajectory).kind, Verdict::kDoubtful);
  EXPECT_EQ(count(force_table(run.trajectory), ">–<"), 2 * run.trajectory.joints.size());
  run.trajectory.joints.clear();
  run.trajectory.of_motion = true;
  run.trajectory.motion_error = 2 * run.trajectory.tolerance;
  EXPECT_EQ(verdict_on(run.trajectory).kind, Verdict::kDoubtful);
}

TEST(Report, AppliedForcesAreDrawnWithoutJoints) {
  const auto [model, run] = run_of(R"toml(format = 1
[simulate]
duration = 0.1
[body.block]
mass = 1
inertia = 0.1
position = [0, 0]
angle = 0
markers.A = [0, 0]
[force.push]
on = "block.A"
force = [3, 4]
)toml");
  const Scene scene = make_scene(model, run.trajectory);
  EXPECT_DOUBLE_EQ(scene.arrow_force, 5);
  EXPECT_TRUE(holds(still_svg(scene, instant_at(scene, run.trajectory, 0), {}), "5 N</text>"));
}

// A run thinned in time keeps its ends and the rows next to peaks, and the page says what it shows.
TEST(Report, LargeRunsAreThinnedButKeepTheirPeaks) {
  const auto [model, run] = run_of_mechanism("andrews");
  const Trajectory& trajectory = run.trajectory;
  const ReportOptions small{.most_values = 10'000};
  const std::string html = report_html(model, run, small);
  const Json data = data_of(html);
  EXPECT_LT(data["rows"], trajectory.n_rows() / 2);
  EXPECT_TRUE(holds(html, "of " + std::to_string(trajectory.n_rows()) + " rows"));
  const std::vector<double> times = numbers(data["columns"][0]["data"]);
  EXPECT_EQ(times.front(), trajectory.at(0, 0));
  EXPECT_EQ(times.back(), trajectory.at(trajectory.n_rows() - 1, 0));
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  const double output_step = trajectory.at(1, 0) - trajectory.at(0, 0);
  for (const LoadSummary& joint : trajectory.joints) {
    const auto after = std::lower_bound(times.begin(), times.end(), joint.peak_time);
    ASSERT_NE(after, times.end()) << joint.name;
    EXPECT_LT(*after - joint.peak_time, output_step) << joint.name;
    EXPECT_TRUE(after == times.begin() || joint.peak_time - *std::prev(after) < 1.001 * output_step) << joint.name;
  }
  EXPECT_LT(html.size(), report_html(model, run).size() / 2);
}

TEST(Report, RunsWithNothingToDrawStillHaveTables) {
  auto [model, run] = run_of_mechanism("four_bar");
  model.simulate.record = {"joint.*"};
  run.trajectory = simulate(model);
  EXPECT_TRUE(holds(report_html(model, run), "did not record any body"));
  run.trajectory.values.clear();
  const std::string html = report_html(model, run);
  EXPECT_TRUE(holds(html, "no rows to show"));
  EXPECT_TRUE(holds(html, "id=\"force-table\""));
}

TEST(Report, TablesCanBeReadAloud) {
  const auto [model, run] = run_of_mechanism("quick_return");
  const std::string html = report_html(model, run);
  EXPECT_EQ(count(html, "<th>"), 0u);  // each header states its scope
  for (const std::string id : {"time", "play", "speed", "trace"}) EXPECT_EQ(count(html, " id=\"" + id + "\""), 1u) << id;
  EXPECT_TRUE(holds(html, "role=\"img\" aria-label=\"The moving mechanism\""));
  EXPECT_TRUE(holds(html, "lang=\"en\""));
}

TEST(Still, KeepsWithinItsSize) {
  const auto [model, run] = run_of_mechanism("four_bar");
  const Scene scene = make_scene(model, run.trajectory);
  StillOptions options;
  options.width = 641;
  const StillFrame wide = frame_for(scene, options);
  EXPECT_EQ(wide.width, 642);
  EXPECT_EQ(std::fmod(wide.height, 2), 0);  // films need even sizes
  options.most_height = 200;
  EXPECT_LE(frame_for(scene, options).height, 202);
}

TEST(Still, TraceFollowsItsPoint) {
  const auto [model, run] = run_of_mechanism("trammel");
  const Scene scene = make_scene(model, run.trajectory);
  const Trace trace = make_trace(scene, run.trajectory, "bar.P");
  for (const Vec2& p : trace.points)  // the trammel's ellipse
    EXPECT_NEAR(p[0] * p[0] / (0.1 * 0.1) + p[1] * p[1] / (0.3 * 0.3), 1, 1e-4);
  try {
    make_trace(scene, run.trajectory, "bar.Q");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(holds(error.what(), "found point \"bar.Q\"")) << error.what();
  }
}

// A force of three times the longest arrow: cut in a film, which has the run's scale, and whole in a still, which has its own.
TEST(Still, ArrowsAreCutOrNot) {
  const auto [model, run] = run_of_mechanism("four_bar");
  const Scene scene = make_scene(model, run.trajectory);
  Instant instant = instant_at(scene, run.trajectory, 0);
  instant.forces.front() = {3 * Scene::kLongestArrow * scene.arrow_force, 0};
  StillOptions options;
  const std::string cut = still_svg(scene, instant, options);
  options.whole_arrows = true;
  const std::string whole = still_svg(scene, instant, options);
  EXPECT_TRUE(holds(cut, "500 N, two heads: more than drawn</text>"));
  EXPECT_FALSE(holds(whole, "two heads"));
  EXPECT_TRUE(holds(whole, "1000 N</text>") || holds(whole, "2000 N</text>")) << whole.substr(whole.rfind("<text"));
}

TEST(Still, ArrowsAreInScale) {
  const auto [model, run] = run_of_mechanism("four_bar");
  const Scene scene = make_scene(model, run.trajectory);
  StillOptions options;
  const Instant instant = instant_at(scene, run.trajectory, 0);
  const std::string with = still_svg(scene, instant, options);
  EXPECT_TRUE(holds(with, "500 N</text>"));
  options.forces = false;
  EXPECT_FALSE(holds(still_svg(scene, instant, options), " N</text>"));
}

}  // namespace
}  // namespace pintle

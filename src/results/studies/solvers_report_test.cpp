// The comparison of methods as text, JSON and picture.
#include "results/studies/solvers_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace pintle {
namespace {

SolverStudy small_study() {
  SolverStudy study;
  study.duration = 1;
  study.output_step = 0.01;
  study.window = 0.2;
  study.truth = {"radau", 1e-9, 3e-10, true, "", 0.1};
  SolverRun run;
  run.method = "hht";
  run.tolerance = 1e-3;
  run.t_end = 1;
  run.steps = 100;
  run.evaluations = 400;
  run.seconds = 2e-3;
  run.force_error = 0.1;
  run.worst_joint = "O4";
  study.runs = {run, run, run};
  study.runs[1].tolerance = 1e-4;
  study.runs[1].force_error = 0.01;
  study.runs[1].evaluations = 4000;
  study.runs[2].method = "ode15s";
  study.runs[2].end = SolverEnd::kOutOfTime;
  study.runs[2].t_end = 0.25;
  study.runs[2].force_error = NAN;
  study.orders = {{"hht", 2, 2.0}, {"ode15s", 0, NAN}};
  return study;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(SolversReport, TextSaysWhatTheTruthIsAndWhoWasStopped) {
  const std::string text = solvers_text(small_study(), "Four-bar");
  EXPECT_TRUE(contains(text, "Reference: radau, tolerance 1e-09"));
  EXPECT_TRUE(contains(text, "3.0e-10"));
  EXPECT_TRUE(contains(text, "stopped at t = 0.25 s"));
  EXPECT_TRUE(contains(text, "running mean"));
  EXPECT_FALSE(contains(text, "nan"));
  EXPECT_FALSE(contains(text, "\x1b"));
}

TEST(SolversReport, JsonHasEveryRunAndNoNumberWhereNoneIsKnown) {
  const auto json = nlohmann::json::parse(solvers_json(small_study(), "Four-bar", "four_bar.toml"));
  ASSERT_EQ(json["runs"].size(), 3U);
  EXPECT_EQ(json["runs"][1]["force_error"], 0.01);
  EXPECT_EQ(json["runs"][2]["outcome"], "stopped");
  EXPECT_TRUE(json["runs"][2]["force_error"].is_null());
  EXPECT_TRUE(json["orders"][1]["order"].is_null());
  EXPECT_EQ(json["truth"]["error_estimate"], 3e-10);
}

std::size_t count_in(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// Equal factors give equal distances: the dots of error 0.1 and 0.01 are one power of ten apart, as are the grid lines.
TEST(SolversReport, PictureHasLogarithmicAxes) {
  const std::string svg = to_svg(solvers_plot(small_study(), "Four-bar"));
  EXPECT_EQ(count_in(svg, "<circle"), 4U);  // two runs with an error, in two panels
  EXPECT_TRUE(contains(svg, ">10\u207b\u00b9<"));
  EXPECT_TRUE(contains(svg, "Wall time [ms]"));
  EXPECT_TRUE(contains(svg, "Evaluations"));
  EXPECT_FALSE(contains(svg, "nan"));
  EXPECT_FALSE(contains(svg, "inf"));
}

TEST(SolversReport, PictureOfNothingIsAPicture) {
  SolverStudy study = small_study();
  study.runs.clear();
  EXPECT_TRUE(contains(to_svg(solvers_plot(study, "")), "</svg>"));
}

}  // namespace
}  // namespace pintle

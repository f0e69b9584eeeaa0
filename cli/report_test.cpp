// pintle report, on runs made for it.
#include <gtest/gtest.h>

#include "cli/sandbox_for_tests.h"

namespace pintle::sample {
namespace {

class ReportVerb : public testing::Test {
 protected:
  ReportVerb() {
    sandbox_.write("bob.toml", pendulum_toml("0.2 s", "0.02 s"));
    const Answer answer = sandbox_.pintle("run bob.toml --set body.bob.mass=2 --quiet");
    EXPECT_EQ(answer.exit_code, 0) << answer.error;
  }
  Sandbox sandbox_;
};

TEST_F(ReportVerb, WritesBesideTheRunFolder) {
  const Answer answer = sandbox_.pintle("report bob-run/");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out, "bob-run.html\n");
  const std::string html = sandbox_.read("bob-run.html");
  EXPECT_TRUE(holds(html, "<title>Pendulum: Pintle report</title>"));
  EXPECT_TRUE(holds(html, "body.bob.mass=2"));                // changed by the command line ...
  EXPECT_TRUE(holds(html, "# its bearing"));                  // ... in this file
  EXPECT_EQ(sandbox_.pintle("report bob-run").exit_code, 0);  // its own page may be replaced
}

TEST_F(ReportVerb, WritesToStandardOutput) {
  const Answer answer = sandbox_.pintle("report bob-run --out -");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_TRUE(holds(answer.out, "</html>"));
}

TEST_F(ReportVerb, LeavesOtherFilesAlone) {
  sandbox_.write("mine.html", "<p>mine</p>");
  const Answer answer = sandbox_.pintle("report bob-run --out mine.html");
  EXPECT_EQ(answer.exit_code, 6);
  EXPECT_TRUE(holds(answer.error, "--force")) << answer.error;
  EXPECT_EQ(sandbox_.read("mine.html"), "<p>mine</p>");
  EXPECT_EQ(sandbox_.pintle("report bob-run --out mine.html --force").exit_code, 0);
  EXPECT_TRUE(holds(sandbox_.read("mine.html"), "Pintle report"));
}

TEST_F(ReportVerb, TheModelTravelsWithTheRun) {
  sandbox_.shell("mkdir elsewhere && mv bob-run elsewhere/ && rm bob.toml");
  EXPECT_EQ(sandbox_.pintle("report elsewhere/bob-run").exit_code, 0);
}

TEST_F(ReportVerb, DamagedRunsAreRefusedWithTheirPlace) {
  const std::string series = sandbox_.read("bob-run/series.csv"), model = sandbox_.read("bob-run/model-as-run.toml"),
                    summary = sandbox_.read("bob-run/summary.json");
  const auto answer_with = [&](const char* file, const std::string& text) {
    sandbox_.write(std::string("bob-run/") + file, text);
    const Answer answer = sandbox_.pintle("report bob-run");
    EXPECT_EQ(answer.exit_code, 6) << file;
    sandbox_.write("bob-run/series.csv", series);
    sandbox_.write("bob-run/model-as-run.toml", model);
    sandbox_.write("bob-run/summary.json", summary);
    return answer.error;
  };
  EXPECT_TRUE(holds(answer_with("series.csv", series.substr(0, series.size() / 2)), "series.csv:"));
  EXPECT_TRUE(holds(answer_with("series.csv", ""), "series.csv:1:1"));
  EXPECT_TRUE(holds(answer_with("model-as-run.toml", model + "# changed"), "not the model that was run"));
  EXPECT_TRUE(holds(answer_with("summary.json", summary.substr(0, 100)), "summary.json"));
  EXPECT_TRUE(holds(answer_with("summary.json", "{}"), "summary.json"));
  for (std::size_t cut = 7; cut < summary.size(); cut += summary.size() / 9)
    EXPECT_TRUE(holds(answer_with("summary.json", summary.substr(0, cut)), "summary.json")) << cut;
  EXPECT_FALSE(sandbox_.has("bob-run.html"));
}

TEST_F(ReportVerb, RunThatWasStoppedIsReported) {
  sandbox_.write("endless.toml", pendulum_toml("1e6 s", "10 s"));
  const Answer run = sandbox_.shell("timeout -s INT 1 \"$PINTLE\" run endless.toml --quiet --out stopped");
  ASSERT_TRUE(sandbox_.has("stopped/summary.json")) << run.error;
  const Answer answer = sandbox_.pintle("report stopped");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_TRUE(holds(sandbox_.read("stopped.html"), "Stopped by the user at t = "));
}

}  // namespace
}  // namespace pintle::sample

// pintle plot, on a run folder made up for it.
#include <gtest/gtest.h>

#include "cli/sandbox_for_tests.h"

namespace pintle::sample {
namespace {

class PlotVerb : public testing::Test {
 protected:
  PlotVerb() { write_run(trajectory(), stamp(), sandbox_ / "four-run"); }
  Sandbox sandbox_;
};

TEST_F(PlotVerb, WritesBesideTheRunFolder) {
  const Answer answer = sandbox_.pintle("plot four-run/ --joint O4");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out, "four-run-O4.svg\n");
  EXPECT_TRUE(holds(sandbox_.read("four-run-O4.svg"), "Joint O4: force on rocker"));
}

TEST_F(PlotVerb, WritesToStandardOutput) {
  const Answer answer =
      sandbox_.pintle("plot four-run --column joint.O4.angle --x joint.O4.on_rocker.fx[world] --out -");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_TRUE(holds(answer.out, "</svg>"));
}

TEST_F(PlotVerb, TakesComponentsAsAList) {
  const Answer answer = sandbox_.pintle("plot --components x,y four-run --joint O4 --on ground --out -");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_TRUE(holds(answer.out, "Force on ground, world axes [N]"));
  EXPECT_FALSE(holds(answer.out, "|F|"));
}

TEST_F(PlotVerb, WrongNamesGiveCode2AndASuggestion) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"--joint 04", "O4"},
      {"--joint O4 --on roker", "ground and rocker"},
      {"--joint O4 --components magnitud", "Did you mean \"magnitude\"?"},
      {"--column joint.O4.angel", "Did you mean \"joint.O4.angle\"?"},
      {"--joint O4 --components 1", "f1[joint]"},
      {"--joint O4 --x time", "found column \"time\""},
      {"", "--joint"},
  };
  for (const auto& [words, expected] : mistakes) {
    const Answer answer = sandbox_.pintle(std::string("plot four-run ") + words);
    EXPECT_EQ(answer.exit_code, 2) << words;
    EXPECT_TRUE(holds(answer.error, expected)) << words << "\n" << answer.error;
  }
}

TEST_F(PlotVerb, DamagedRunGivesCode6AndItsPlace) {
  sandbox_.write("four-run/series.csv", sandbox_.read("four-run/series.csv") + "0,0,zero,0,0,0\r\n");
  const Answer answer = sandbox_.pintle("plot four-run --joint O4");
  EXPECT_EQ(answer.exit_code, 6);
  EXPECT_TRUE(holds(answer.error, "series.csv:54:5: series")) << answer.error;
}

TEST_F(PlotVerb, FileSizeLimitLeavesTheOldPlot) {
  sandbox_.write("O4.svg", "old");
  const Answer answer = sandbox_.shell("trap '' XFSZ; ulimit -f 1; \"$PINTLE\" plot four-run --joint O4 --out O4.svg");
  EXPECT_EQ(answer.exit_code, 6);
  EXPECT_TRUE(holds(answer.error, "ulimit")) << answer.error;
  EXPECT_EQ(sandbox_.read("O4.svg"), "old");
}

}  // namespace
}  // namespace pintle::sample

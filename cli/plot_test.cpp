// pintle plot, on a run folder made for these tests.
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

TEST_F(PlotVerb, PolarLoadDiagrams) {
  sandbox_.write("pendulum.toml", pendulum_toml("0.2 s", "10 ms"));
  EXPECT_EQ(sandbox_.pintle("run pendulum.toml -q").exit_code, 0);
  const Answer answer = sandbox_.pintle("plot pendulum-run --polar pin");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out, "pendulum-run-pin-polar.svg\n");
  EXPECT_TRUE(holds(sandbox_.read("pendulum-run-pin-polar.svg"), "axes of its marker on bob"));
  EXPECT_EQ(sandbox_.pintle("plot pendulum-run --polar pin --with pendulum-run --out both.svg").exit_code, 0);
  EXPECT_EQ(sandbox_.pintle("plot pendulum-run --polar pin --joint pin").exit_code, 2);
  EXPECT_EQ(sandbox_.pintle("plot four-run --polar slide").exit_code, 2);
}

// The pendulum's rows are 10 ms apart.
TEST_F(PlotVerb, PoincareSections) {
  sandbox_.write("pendulum.toml", pendulum_toml("0.2 s", "10 ms"));
  EXPECT_EQ(sandbox_.pintle("run pendulum.toml -q").exit_code, 0);
  const Answer section = sandbox_.pintle("plot pendulum-run --x joint.pin.angle --column joint.pin.angle_rate --every 0.04 --from 0.02 --out -");
  ASSERT_EQ(section.exit_code, 0) << section.error;
  EXPECT_TRUE(holds(section.out, "every 0.04 s from 0.02 s: 5 points")) << section.out;
  std::size_t dots = 0;
  for (std::size_t at = section.out.find("<circle"); at != std::string::npos; at = section.out.find("<circle", at + 1)) ++dots;
  EXPECT_EQ(dots, 5u);
  const Answer between = sandbox_.pintle("plot pendulum-run --x joint.pin.angle --column joint.pin.angle_rate --every 0.025 --out -");
  EXPECT_EQ(between.exit_code, 2);
  EXPECT_TRUE(holds(between.error, "found no row at t = 0.025 s")) << between.error;
  EXPECT_TRUE(holds(sandbox_.pintle("plot pendulum-run --column joint.pin.angle --every 0.04 --from 3").error, "ends before it"));
  EXPECT_EQ(sandbox_.pintle("plot pendulum-run --column joint.pin.angle --every -1").exit_code, 2);
}

// The sample has columns of only one joint.
TEST_F(PlotVerb, WithoutWordsTheForcesOfAllJointsAreDrawn) {
  const Answer answer = sandbox_.pintle("plot four-run");
  ASSERT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out, "four-run.svg\n");
  EXPECT_TRUE(holds(sandbox_.read("four-run.svg"), "Joint O4: force on rocker"));
}

TEST_F(PlotVerb, WrongNamesGiveCode2AndASuggestion) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"--joint 04", "O4"},
      {"--joint O4 --on roker", "ground and rocker"},
      {"--joint O4 --components magnitud", "Did you mean \"magnitude\"?"},
      {"--column joint.O4.angel", "Did you mean \"joint.O4.angle\"?"},
      {"--joint O4 --components 1", "f1[joint]"},
      {"--joint O4 --x time", "found column \"time\""},
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

/// Four bytes of a PNG file as a number, highest byte first.
unsigned number_at(const std::string& png, std::size_t place) {
  unsigned number = 0;
  for (std::size_t i = place; i < place + 4; ++i) number = number << 8 | static_cast<unsigned char>(png.at(i));
  return number;
}

TEST_F(PlotVerb, PngHasTheSizeAskedFor) {
  const Answer answer = sandbox_.pintle("plot four-run --joint O4 --width 400 --dpi 240 --out O4.png");
  if (holds(answer.error, "without librsvg")) GTEST_SKIP() << answer.error;
  ASSERT_EQ(answer.exit_code, 0) << answer.error;
  const std::string png = sandbox_.read("O4.png");
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(number_at(png, 16), 1000u);
  EXPECT_EQ(png.substr(37, 4), "pHYs");
  EXPECT_EQ(number_at(png, 41), 9449u);  // 240 per inch, converted to per metre
  EXPECT_EQ(number_at(png, 50), 0x5024e7f8u);  // zlib's crc32 of the chunk
}

TEST_F(PlotVerb, SvgHasTheWidthAskedFor) {
  EXPECT_TRUE(holds(sandbox_.pintle("plot four-run --joint O4 --width 400 --out -").out, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"400\""));
}

TEST_F(PlotVerb, RunsLieOverOneAnother) {
  write_run(trajectory(26), stamp(), sandbox_ / "other-run");
  const Answer answer = sandbox_.pintle("plot four-run --with other-run --joint O4 --components magnitude --out -");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_TRUE(holds(answer.out, "four-run: |F|"));
  EXPECT_TRUE(holds(answer.out, "other-run: |F|"));
  EXPECT_EQ(sandbox_.pintle("plot four-run --with no-run --joint O4 --out -").exit_code, 6);
}

TEST_F(PlotVerb, RunsOfOneNameAreToldApartByTheirFolders) {
  write_run(trajectory(26), stamp(), sandbox_ / "old" / "four-run");
  const Answer answer = sandbox_.pintle("plot four-run --with old/four-run --joint O4 --components magnitude --out -");
  EXPECT_TRUE(holds(answer.out, ">old/four-run: |F|")) << answer.error;
  EXPECT_TRUE(holds(answer.out, ">four-run: |F|"));
}

// The command must not overwrite a model, nor write SVG into a file of another type.
TEST_F(PlotVerb, OtherEndingsAreRefused) {
  sandbox_.write("four.toml", "mine");
  for (const char* file : {"four.toml", "forces.pdf"}) {
    const Answer answer = sandbox_.pintle(std::string("plot four-run --joint O4 --out ") + file);
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_TRUE(holds(answer.error, "must end in .svg or .png")) << answer.error;
  }
  EXPECT_EQ(sandbox_.read("four.toml"), "mine");
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

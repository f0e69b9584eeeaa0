// pintle run, on a pendulum.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/sandbox_for_tests.h"

namespace pintle::sample {
namespace {

const std::string kRunModel = pendulum_toml("0.2 s", "10 ms");

class RunVerb : public testing::Test {
 protected:
  RunVerb() { sandbox_.write("pendulum.toml", kRunModel); }
  Sandbox sandbox_;
};

TEST_F(RunVerb, WritesTheRunFolderAndATableWithoutEscapes) {
  const Answer answer = sandbox_.pintle("run pendulum.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.error, "");  // no progress is shown in a pipe
  EXPECT_TRUE(holds(answer.out, "pin"));
  EXPECT_TRUE(holds(answer.out, "Results in pendulum-run/"));
  EXPECT_FALSE(holds(answer.out, "\x1b"));
  EXPECT_EQ(read_run(sandbox_ / "pendulum-run").trajectory.n_rows(), 21U);
}

TEST_F(RunVerb, JsonOnStandardOutputIsTheSummary) {
  const Answer answer = sandbox_.pintle("run pendulum.toml --json --progress json");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out, sandbox_.read("pendulum-run/summary.json"));
  const nlohmann::json summary = nlohmann::json::parse(answer.out);
  EXPECT_EQ(summary["command_line"], "pintle run pendulum.toml --json --progress json");
  EXPECT_EQ(summary["input_hash"].get<std::string>().size(), 7U + 64U);
  const std::string last = answer.error.substr(answer.error.rfind('\n', answer.error.size() - 2) + 1);
  EXPECT_EQ(nlohmann::json::parse(last)["event"], "finished");
}

TEST_F(RunVerb, NamesTheForceThatIsNotANumber) {
  sandbox_.write("broken.toml", pendulum_toml("1 s", "10 ms") + "[force.pull]\non = \"bob.O\"\nforce = [\"1 N*sqrt(0.5 - t/(1 s))\", 0]\n");
  const Answer answer = sandbox_.pintle("run broken.toml");
  EXPECT_EQ(answer.exit_code, 5);
  EXPECT_TRUE(holds(answer.error, "at t = 0.5 s")) << answer.error;
  EXPECT_TRUE(holds(answer.error, "force pull is not finite there")) << answer.error;
}

TEST_F(RunVerb, NamesTheMotorThatIsNotANumber) {
  for (const char* equations : {"newtonian", "relative"}) {
    sandbox_.write("broken.toml", pendulum_toml("1 s", "10 ms") + "[motor.drag]\njoint = \"pin\"\ntorque = \"-1 N*m*rate/abs(rate)\"\n");
    const Answer answer = sandbox_.pintle(std::string("run broken.toml --force --equations ") + equations);
    EXPECT_EQ(answer.exit_code, 5);
    EXPECT_TRUE(holds(answer.error, "at t = 0 s: motor drag is not finite there")) << answer.error;
  }
}

TEST_F(RunVerb, QuietIsQuiet) {
  const Answer answer = sandbox_.pintle("run --quiet pendulum.toml --out there");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out + answer.error, "");
  EXPECT_TRUE(sandbox_.has("there/summary.json"));
}

TEST_F(RunVerb, OptionsOverrideTheModel) {
  const Answer answer = sandbox_.pintle(
      "run --set body.bob.mass='2 kg' pendulum.toml --duration '100 ms' --tolerance 1e-4 --method dopri5");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  const Trajectory trajectory = read_run(sandbox_ / "pendulum-run").trajectory;
  EXPECT_DOUBLE_EQ(trajectory.t_end, 0.1);
  EXPECT_DOUBLE_EQ(trajectory.tolerance, 1e-4);
  EXPECT_EQ(trajectory.method, "dopri5");
  EXPECT_EQ(sandbox_.pintle("run pendulum.toml --duration '2 kg'").exit_code, 3);
}

TEST_F(RunVerb, RefusesAStrangersFolderBeforeItRuns) {
  std::filesystem::create_directory(sandbox_ / "thesis");
  sandbox_.write("thesis/chapter.tex", "text");
  const Answer answer = sandbox_.pintle("run pendulum.toml --out thesis");
  EXPECT_EQ(answer.exit_code, 6);
  EXPECT_TRUE(holds(answer.error, "--force")) << answer.error;
  EXPECT_EQ(sandbox_.pintle("run pendulum.toml --out thesis --force").exit_code, 0);
  EXPECT_EQ(sandbox_.read("thesis/chapter.tex"), "text");
}

TEST_F(RunVerb, FileSizeLimitLeavesTheOldRun) {
  ASSERT_EQ(sandbox_.pintle("run pendulum.toml").exit_code, 0);
  const std::string old = sandbox_.read("pendulum-run/summary.json");
  const Answer answer =
      sandbox_.shell("trap '' XFSZ; ulimit -f 4; \"$PINTLE\" run pendulum.toml --set simulate.output_step=1e-5");
  EXPECT_EQ(answer.exit_code, 6) << answer.error;
  EXPECT_EQ(sandbox_.read("pendulum-run/summary.json"), old);
  EXPECT_EQ(sandbox_.shell("ls -A | grep -c tmp").out, "0\n");
}

TEST_F(RunVerb, TerminationKeepsTheResults) {
  const Answer answer = sandbox_.shell(
      "\"$PINTLE\" run pendulum.toml --duration 1e6 --set simulate.output_step=1e3 --method dopri5 --quiet & "
      "sleep 2; kill -TERM $!; wait $!");
  EXPECT_EQ(answer.exit_code, 130) << answer.error;
  const Trajectory trajectory = read_run(sandbox_ / "pendulum-run").trajectory;
  EXPECT_EQ(trajectory.outcome, Outcome::kInterrupted);
  EXPECT_LT(trajectory.t_end, 1e6);
}

}  // namespace
}  // namespace pintle::sample

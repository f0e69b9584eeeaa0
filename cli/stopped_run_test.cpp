// Runs stopped from outside, by signals and full disks. The previous or the new content of the run folder is always valid.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/sandbox_for_tests.h"

namespace pintle::sample {
namespace {

const std::string kStopped = pendulum_toml("0.2 s", "10 ms");

// A run of many hours.
constexpr const char* kLong =
    "\"$PINTLE\" run pendulum.toml --duration 1e6 --set simulate.output_step=1e3 --method dopri5 ";

class StoppedRun : public testing::Test {
 protected:
  StoppedRun() { sandbox_.write("pendulum.toml", kStopped); }
  std::string stopped_by(const char* signal) { return signalled(signal, 2, kLong); }
  /// Nothing is left next to the run folder: no temporary folder, no partial file.
  std::string others() { return sandbox_.shell("ls -A | grep -v -e pendulum -e '^[.]out$' -e '^[.]error$'").out; }
  Sandbox sandbox_;
};

TEST_F(StoppedRun, InterruptKeepsTheResults) {
  const Answer answer = sandbox_.shell(stopped_by("INT") + "--json");
  EXPECT_EQ(answer.exit_code, 130) << answer.error;
  const Trajectory trajectory = read_run(sandbox_ / "pendulum-run").trajectory;
  EXPECT_EQ(trajectory.outcome, Outcome::kInterrupted);
  EXPECT_GT(trajectory.n_rows(), 0U);
  EXPECT_LT(trajectory.t_end, 1e6);
  EXPECT_EQ(nlohmann::json::parse(answer.out)["outcome"], "interrupted");
  EXPECT_EQ(answer.out, sandbox_.read("pendulum-run/summary.json"));
  EXPECT_EQ(others(), "");
}

// The default behaviour of `timeout` when not told to stay in the foreground.
TEST_F(StoppedRun, ASignalToTheProcessAndToItsGroupIsOneRequest) {
  const Answer answer = sandbox_.shell(std::string("timeout --preserve-status -s INT 2 ") + kLong + "--quiet");
  EXPECT_EQ(answer.exit_code, 130) << answer.error;
  EXPECT_EQ(read_run(sandbox_ / "pendulum-run").trajectory.outcome, Outcome::kInterrupted);
}

TEST_F(StoppedRun, AnInterruptedRunCanBePlotted) {
  ASSERT_EQ(sandbox_.shell(stopped_by("INT") + "--quiet").exit_code, 130);
  EXPECT_EQ(sandbox_.pintle("plot pendulum-run --joint pin --out pendulum.svg").exit_code, 0);
}

TEST_F(StoppedRun, AKilledRunLeavesTheOldOne) {
  ASSERT_EQ(sandbox_.pintle("run pendulum.toml").exit_code, 0);
  const std::string old = sandbox_.read("pendulum-run/summary.json");
  EXPECT_EQ(sandbox_.shell(stopped_by("KILL")).exit_code, 137);
  EXPECT_EQ(sandbox_.read("pendulum-run/summary.json"), old);
  EXPECT_EQ(read_run(sandbox_ / "pendulum-run").trajectory.n_rows(), 21U);
}

TEST_F(StoppedRun, AFullDiskLeavesNoHalfRun) {
  const Answer answer =
      sandbox_.shell("trap '' XFSZ; ulimit -f 4; \"$PINTLE\" run pendulum.toml --set simulate.output_step=1e-5");
  EXPECT_EQ(answer.exit_code, 6) << answer.error;
  EXPECT_TRUE(holds(answer.error, "series.csv")) << answer.error;
  EXPECT_FALSE(sandbox_.has("pendulum-run"));
  EXPECT_EQ(others(), "");
}

// Root may mount a small disk; for other users the test above takes its place.
TEST_F(StoppedRun, ASmallDisk) {
  std::filesystem::create_directory(sandbox_ / "pendulum-disk");
  if (sandbox_.shell("mount -t tmpfs -o size=64k tmpfs pendulum-disk").exit_code != 0) GTEST_SKIP() << "cannot mount";
  const Answer first = sandbox_.pintle("run pendulum.toml --out pendulum-disk/run");
  const Answer second = sandbox_.pintle("run pendulum.toml --set simulate.output_step=1e-5 --out pendulum-disk/run");
  const std::string left = sandbox_.shell("ls -A pendulum-disk").out;
  const std::size_t n_rows = first.exit_code == 0 ? read_run(sandbox_ / "pendulum-disk/run").trajectory.n_rows() : 0;
  sandbox_.shell("umount pendulum-disk");
  EXPECT_EQ(first.exit_code, 0) << first.error;
  EXPECT_EQ(second.exit_code, 6) << second.error;
  EXPECT_TRUE(holds(second.error, "space")) << second.error;
  EXPECT_EQ(n_rows, 21U);
  EXPECT_EQ(left, "run\n");
}

TEST_F(StoppedRun, AFullStandardOutputIsAnError) {
  for (const char* words : {"run pendulum.toml", "run pendulum.toml --json", "convert pendulum.toml", "schema"}) {
    const Answer answer = sandbox_.shell(fmt::format("\"$PINTLE\" {} > /dev/full", words));
    EXPECT_EQ(answer.exit_code, 6) << words << answer.error;
    EXPECT_FALSE(answer.error.empty()) << words;
  }
  EXPECT_EQ(read_run(sandbox_ / "pendulum-run").trajectory.n_rows(), 21U);  // from the previous run
}

TEST_F(StoppedRun, AFullOutputFileIsAnError) {
  ASSERT_EQ(sandbox_.pintle("run pendulum.toml").exit_code, 0);
  for (const char* words : {"convert pendulum.toml --out /dev/full", "schema --out /dev/full",
                            "plot pendulum-run --joint pin --out /dev/full"}) {
    const Answer answer = sandbox_.pintle(words);
    EXPECT_EQ(answer.exit_code, 6) << words << answer.error;
    EXPECT_TRUE(holds(answer.error, "/dev/full")) << words << answer.error;
  }
}

// A reader that stops early, as in `pintle schema | head`, is not an error.
TEST_F(StoppedRun, AClosedPipeEndsQuietly) {
  const Answer answer = sandbox_.shell("\"$PINTLE\" schema | head -n 1");
  EXPECT_EQ(answer.error, "");
}

}  // namespace
}  // namespace pintle::sample

// pintle sweep from the command line, on a pendulum.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/sandbox_for_tests.h"
#include "sweeps/storage/sweep_file.h"
#include "sweeps/sweep_models_for_tests.h"

namespace pintle::sample {
namespace {

class SweepVerb : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_hdf5()) GTEST_SKIP() << kNoHdf5;
    sandbox_.write("pendulum.toml", request({}).model_text);
  }
  Sandbox sandbox_;
};

TEST_F(SweepVerb, PrintsAndDrawsPeaks) {
  const Answer answer = sandbox_.pintle("sweep pendulum.toml --vary joint.pin.stiffness='1e6..1e9 N/m:log:4' --plot peaks.svg");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.error, "");
  for (const char* part : {"4 samples of joint.pin.stiffness", "median [N]", "Results in pendulum-sweep.h5"}) EXPECT_TRUE(holds(answer.out, part)) << answer.out;
  EXPECT_TRUE(holds(sandbox_.read("peaks.svg"), "<svg"));
  const Answer again = sandbox_.pintle("sweep pendulum.toml --vary joint.pin.stiffness='1e6..1e9 N/m:log:4'");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_TRUE(holds(again.out, "is already complete")) << again.out;
  const Answer other = sandbox_.pintle("sweep pendulum.toml --vary joint.pin.stiffness='1e6..1e9 N/m:log:5'");
  EXPECT_EQ(other.exit_code, 6);
  EXPECT_TRUE(holds(other.error, "--force")) << other.error;
}

TEST_F(SweepVerb, JsonAndProgress) {
  const Answer answer = sandbox_.pintle("sweep pendulum.toml --sample 40 --seed 3 --latin --check-every 10 --json --progress json");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  const nlohmann::json summary = nlohmann::json::parse(answer.out);
  EXPECT_EQ(summary["samples"], 40);
  EXPECT_EQ(summary["status"]["completed"], 40);
  EXPECT_LT(summary["joints"][0]["least"], summary["joints"][0]["most"]);
  const nlohmann::json last = nlohmann::json::parse(answer.error.substr(answer.error.rfind('\n', answer.error.size() - 2) + 1));
  EXPECT_EQ(last["event"], "finished");
  EXPECT_EQ(last["total"], 40);
}

TEST_F(SweepVerb, SaysWhatIsWrong) {
  const Answer misspelt = sandbox_.pintle("sweep pendulum.toml --vary joint.pin.stifness=1e6..1e9:log:4");
  EXPECT_EQ(misspelt.exit_code, 3);
  EXPECT_TRUE(holds(misspelt.error, "--vary:1:1: joint.pin.stifness")) << misspelt.error;
  EXPECT_EQ(sandbox_.pintle("sweep pendulum.toml").exit_code, 3);
  EXPECT_EQ(sandbox_.pintle("sweep pendulum.toml --sample -3").exit_code, 2);
  EXPECT_EQ(sandbox_.pintle("sweep nothing.toml --sample 3").exit_code, 6);
  EXPECT_EQ(sandbox_.pintle("sweep pendulum.toml --sample 3 --out no/such/folder.h5").exit_code, 6);
}

using SlowSweepVerb = SweepVerb;

// SIGKILL at random times; the resulting file equals that of an undisturbed sweep.
TEST_F(SlowSweepVerb, KilledSweepsGoOn) {
  const std::string words = "sweep pendulum.toml --sample 1500 --quiet --out ";
  ASSERT_EQ(sandbox_.pintle(words + "whole.h5").exit_code, 0);
  for (int i = 0; i < 3; ++i) sandbox_.shell(fmt::format("timeout -s KILL 0.{} \"$PINTLE\" {} killed.h5", 2 + i, words));
  const Answer answer = sandbox_.shell(signalled("INT", 0.3, "\"$PINTLE\" " + words + "killed.h5"));
  if (answer.exit_code == 130) {
    EXPECT_TRUE(holds(answer.error, "the same command again")) << answer.error;
  }
  ASSERT_EQ(sandbox_.pintle(words + "killed.h5").exit_code, 0);
  EXPECT_EQ(sandbox_.read("killed.h5"), sandbox_.read("whole.h5"));
}

TEST_F(SlowSweepVerb, ProcessesOfMpiGiveTheSameFile) {
  const std::string mpirun = "mpirun -n 3 --oversubscribe --allow-run-as-root ";
  if (sandbox_.shell("mpirun --version && ldd \"$PINTLE\"-sweep | grep -q libmpi").exit_code != 0) GTEST_SKIP() << "no mpirun";
  const std::string words = "sweep pendulum.toml --sample 300 --quiet --threads 2 --out ";
  ASSERT_EQ(sandbox_.pintle(words + "alone.h5").exit_code, 0);
  const Answer answer = sandbox_.shell(mpirun + "\"$PINTLE\" " + words + "together.h5");
  ASSERT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(sandbox_.read("alone.h5"), sandbox_.read("together.h5"));
  EXPECT_EQ(sandbox_.shell(mpirun + "\"$PINTLE\" " + words + "together.h5").exit_code, 0);
  const Answer wrong = sandbox_.shell(mpirun + "\"$PINTLE\" sweep pendulum.toml --vary body.bob.mas=1,2");
  EXPECT_TRUE(holds(wrong.error, "did you mean")) << wrong.error;
}

}  // namespace
}  // namespace pintle::sample

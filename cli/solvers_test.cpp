// pintle solvers, on a pendulum.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/sandbox_for_tests.h"
#include "integrators/general/sundials_stepper.h"

namespace pintle::sample {
namespace {

const std::string kShortPendulum = pendulum_toml("0.1 s", "1 ms");

class SolversVerb : public testing::Test {
 protected:
  SolversVerb() { sandbox_.write("pendulum.toml", kShortPendulum); }
  Sandbox sandbox_;
};

TEST_F(SolversVerb, PrintsARowForEveryMethodAndTolerance) {
  const Answer answer = sandbox_.pintle("solvers pendulum.toml --tolerances 1e-3,1e-5");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.error, "");
  for (const char* method : {"radau", "dopri5", "ode23t", "hht", "generalised_alpha", "ode45", "ode15s", "ode113"})
    EXPECT_TRUE(holds(answer.out, method)) << method;
  EXPECT_TRUE(holds(answer.out, "Reference: radau, tolerance 1e-09"));
  EXPECT_EQ(holds(answer.out, "no SUNDIALS"), !has_sundials());
}

TEST_F(SolversVerb, JsonAndPlot) {
  const Answer answer = sandbox_.pintle("solvers pendulum.toml --methods radau,hht --tolerances 1e-4 --json --plot work.svg");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  const nlohmann::json study = nlohmann::json::parse(answer.out);
  ASSERT_EQ(study["runs"].size(), 2U);
  EXPECT_LT(study["runs"][0]["force_error"], study["runs"][1]["force_error"]);
  EXPECT_TRUE(holds(sandbox_.read("work.svg"), "generalised") == false && holds(sandbox_.read("work.svg"), "hht"));
}

TEST_F(SolversVerb, OptionsReachTheModel) {
  const Answer answer =
      sandbox_.pintle("solvers pendulum.toml --methods hht --tolerances 1e-2 --duration '50 ms' --max-step '0.1 ms' --set body.bob.mass='2 kg' --json");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  const nlohmann::json study = nlohmann::json::parse(answer.out);
  EXPECT_EQ(study["duration"], 0.05);
  EXPECT_GE(study["runs"][0]["steps"], 500);
}

TEST_F(SolversVerb, SaysWhatIsWrong) {
  Answer answer = sandbox_.pintle("solvers pendulum.toml --methods euler");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_TRUE(holds(answer.error, "euler"));
  EXPECT_EQ(sandbox_.pintle("solvers pendulum.toml --tolerances -1").exit_code, 2);
  EXPECT_EQ(sandbox_.pintle("solvers nothing.toml").exit_code, 6);
  answer = sandbox_.pintle("solvers pendulum.toml --set simulate.equations=relative");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_TRUE(holds(answer.error, "newtonian")) << answer.error;
}

// The paper's methods in a normal run.
TEST_F(SolversVerb, RunTakesTheMethodsToo) {
  const Answer answer = sandbox_.pintle("run pendulum.toml --method ode23t --tolerance 1e-3 --json");
  EXPECT_EQ(answer.exit_code, 0) << answer.error << answer.out;
  EXPECT_EQ(nlohmann::json::parse(answer.out)["method"], "ode23t");
  const Answer synonym = sandbox_.pintle("run pendulum.toml --method trapezoidal --tolerance 1e-3 --json");
  EXPECT_EQ(synonym.exit_code, 0) << synonym.error;
  EXPECT_EQ(nlohmann::json::parse(synonym.out)["method"], "ode23t");
}

}  // namespace
}  // namespace pintle::sample

// pintle compare and pintle stiffen, on a pendulum.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/sandbox_for_tests.h"
#include "pintle/read_model.h"

namespace pintle::sample {
namespace {

const std::string kPendulum = pendulum_toml("0.2 s", "10 ms");

class CompareVerb : public testing::Test {
 protected:
  CompareVerb() { sandbox_.write("pendulum.toml", kPendulum); }
  Sandbox sandbox_;
};
using StiffenVerb = CompareVerb;

TEST_F(CompareVerb, PrintsATableAndDrawsAPicture) {
  const Answer answer = sandbox_.pintle("compare pendulum.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_TRUE(holds(answer.out, "compliant joints against ideal joints"));
  EXPECT_TRUE(holds(answer.out, "Plot: pendulum-compare.svg"));
  EXPECT_TRUE(holds(sandbox_.read("pendulum-compare.svg"), "</svg>"));
}

TEST_F(CompareVerb, PicturesAreSvg) {
  for (const char* verb : {"compare", "stiffen", "solvers"}) {
    const Answer answer = sandbox_.pintle(std::string(verb) + " pendulum.toml --plot picture.png");
    EXPECT_EQ(answer.exit_code, 2) << verb;
    EXPECT_TRUE(holds(answer.error, "found \"picture.png\": it must end in .svg")) << answer.error;
    EXPECT_FALSE(sandbox_.has("picture.png"));
  }
  EXPECT_EQ(sandbox_.pintle("solvers pendulum.toml --plot none").exit_code, 2);
}

TEST_F(CompareVerb, JsonAndNoPicture) {
  const Answer answer = sandbox_.pintle("compare pendulum.toml --json --plot none --against relative --set joint.pin.ideal=true");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  const nlohmann::json json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json["against"], "relative");
  ASSERT_EQ(json["forces"].size(), 1U);
  EXPECT_GT(json["forces"][0]["digits"], 4);
  EXPECT_FALSE(sandbox_.has("pendulum-compare.svg"));
  const Answer synonym = sandbox_.pintle("compare pendulum.toml --json --plot none --against lagrangian --set joint.pin.ideal=true");
  EXPECT_EQ(nlohmann::json::parse(synonym.out)["against"], "relative") << synonym.error;
}

TEST_F(CompareVerb, EquationsAreAnOptionOfRun) {
  const Answer answer = sandbox_.pintle("run pendulum.toml --equations ideal");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(read_run(sandbox_ / "pendulum-run").trajectory.method, "dopri5");
  EXPECT_EQ(sandbox_.pintle("run pendulum.toml --equations ideal --method radau").exit_code, 3);
}

TEST_F(StiffenVerb, WritesWhatItRecommendsAndNothingElse) {
  const Answer answer = sandbox_.pintle("stiffen pendulum.toml --write");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_TRUE(holds(answer.out, "Found: the digits agree at"));
  const std::string text = sandbox_.read("pendulum.toml");
  EXPECT_TRUE(holds(text, "[joint.pin]  # its bearing"));
  const Model model = parse_model(text, "pendulum.toml");
  EXPECT_EQ(model.joints[0].law.values.at("damping").front(), 500);
  EXPECT_GE(model.joints[0].law.values.at("stiffness").front(), 1e6);
  EXPECT_EQ(sandbox_.pintle("run pendulum.toml -q").exit_code, 0);
}

TEST_F(StiffenVerb, NoAnswerHasAnExitCodeAndAReason) {
  const Answer answer = sandbox_.pintle("stiffen pendulum.toml --digits 8 --to 1e7 --write --json");
  EXPECT_EQ(answer.exit_code, 7) << answer.error;
  const nlohmann::json json = nlohmann::json::parse(answer.out);
  EXPECT_FALSE(json["found"]);
  EXPECT_FALSE(json["reason"].get<std::string>().empty());
  EXPECT_EQ(sandbox_.read("pendulum.toml"), kPendulum);
}

TEST_F(StiffenVerb, AMisspeltJointIsNamed) {
  const Answer answer = sandbox_.pintle("stiffen pendulum.toml --joint pim");
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(holds(answer.error, "pin")) << answer.error;
}

}  // namespace
}  // namespace pintle::sample

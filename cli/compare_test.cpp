// pintle compare and pintle stiffen, on a pendulum.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/sandbox_for_tests.h"
#include "pintle/read_model.h"

namespace pintle::sample {
namespace {

const std::string kCompared = pendulum_toml("0.2 s", "10 ms");

class CompareVerb : public testing::Test {
 protected:
  CompareVerb() { sandbox_.write("pendulum.toml", kCompared); }
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

TEST_F(CompareVerb, RelativeCoordinatesNeedAnIdealJoint) {
  const Answer answer = sandbox_.pintle("compare pendulum.toml --plot none --against relative");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_TRUE(holds(answer.error, "no joint of pendulum.toml is marked ideal")) << answer.error;
  EXPECT_TRUE(holds(answer.error, "--set joint.pin.ideal=true")) << answer.error;
}

TEST_F(CompareVerb, SeveralModelsSideBySide) {
  sandbox_.write("heavy.toml", kCompared);
  EXPECT_EQ(sandbox_.shell("sed -i 's/1 kg\"/2 kg\"/; s/0.1 kg/0.2 kg/' heavy.toml").exit_code, 0);
  const Answer answer = sandbox_.pintle("compare pendulum.toml heavy.toml --json");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  const nlohmann::json json = nlohmann::json::parse(answer.out);
  ASSERT_EQ(json["runs"].size(), 2U);
  EXPECT_EQ(json["runs"][1]["name"], "heavy");
  const nlohmann::json& loads = json["joints"][0]["loads"];
  for (const char* what : {"peak_change", "mean_change", "rms_change"}) EXPECT_NEAR(loads[1][what].get<double>(), 1, 1e-4) << what;  // twice the weight, with the same time history
  EXPECT_EQ(loads[1]["peak_difference_is"], "physical");
  EXPECT_EQ(loads[0]["peak_change"], 0);
  const std::string picture = sandbox_.read("pendulum-compare.svg");
  EXPECT_TRUE(holds(picture, "heavy") && holds(picture, "Force at pin"));
  const Answer text = sandbox_.pintle("compare pendulum.toml heavy.toml --plot none");
  EXPECT_TRUE(holds(text.out, "+100.00 %")) << text.out;
  EXPECT_TRUE(holds(text.out, "2 runs side by side")) << text.out;
}

TEST_F(CompareVerb, LawsSideBySide) {
  const Answer answer = sandbox_.pintle("compare pendulum.toml --plot none --law joint.pin=linear,stiffness=1e5 --law joint.pin=maxwell,branch_ratio=[1],branch_time=[0.01] --against ideal");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  for (const char* part : {"4 runs side by side", "pendulum, pin=linear ", "pendulum, pin=maxwell ", "ideal joints", "joint pin: law maxwell instead of linear"}) EXPECT_TRUE(holds(answer.out, part)) << answer.out;
}

// For a joint that is missing in one model: a dash instead of a number.
TEST_F(CompareVerb, JointsOfOneModelOnly) {
  sandbox_.write("other.toml", kCompared);
  EXPECT_EQ(sandbox_.shell("sed -i 's/joint.pin/joint.hinge/' other.toml").exit_code, 0);
  const nlohmann::json json = nlohmann::json::parse(sandbox_.pintle("compare pendulum.toml other.toml --json --plot none").out);
  ASSERT_EQ(json["joints"].size(), 2U);
  EXPECT_TRUE(json["joints"][0]["loads"][1].is_null());
  EXPECT_TRUE(json["joints"][1]["loads"][0].is_null());
  EXPECT_TRUE(json["joints"][1]["loads"][1]["peak_change"].is_null());
}

TEST_F(CompareVerb, LawIsAnOptionOfRunAndCheck) {
  const Answer answer = sandbox_.pintle("run pendulum.toml --law joint.pin=maxwell,branch_ratio=[1],branch_time=[0.01]");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_TRUE(holds(answer.out, "joint pin: law maxwell instead of linear")) << answer.out;
  EXPECT_EQ(sandbox_.pintle("report pendulum-run").exit_code, 0);  // it reads the model as it was run
  EXPECT_TRUE(holds(sandbox_.read("pendulum-run.html"), "--law joint.pin=maxwell"));
  EXPECT_TRUE(holds(sandbox_.pintle("check pendulum.toml --law joint.pin=linear,stiffness=1e5").out, "joint pin: law linear"));
  const Answer wrong = sandbox_.pintle("check pendulum.toml --law joint.pin=liner");
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_TRUE(holds(wrong.error, "--law:1:11: joint.pin.law") && holds(wrong.error, "linear")) << wrong.error;
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
  EXPECT_EQ(sandbox_.read("pendulum.toml"), kCompared);
}

TEST_F(StiffenVerb, AMisspeltJointIsNamed) {
  const Answer answer = sandbox_.pintle("stiffen pendulum.toml --joint pim");
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(holds(answer.error, "pin")) << answer.error;
}

}  // namespace
}  // namespace pintle::sample

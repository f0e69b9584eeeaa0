// pintle life, on a pendulum: from its model, and from an existing run.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/sandbox_for_tests.h"

namespace pintle::sample {
namespace {

using Json = nlohmann::json;

const std::string kSized = pendulum_toml("0.2 s", "2 ms") + "[joint.pin.bearing]\ntype = \"ball\"\ndynamic_load_rating = \"1 kN\"\n";

class LifeVerb : public testing::Test {
 protected:
  LifeVerb() {
    sandbox_.write("pendulum.toml", pendulum_toml("0.2 s", "2 ms"));
    sandbox_.write("sized.toml", kSized);
  }
  Json bearing(const std::string& words) {
    const Answer answer = sandbox_.pintle(words);
    EXPECT_EQ(answer.exit_code, 0) << answer.error;
    const Json list = Json::parse(answer.out).at("bearings");
    return list.size() == 1 ? list[0] : Json();
  }
  Sandbox sandbox_;
};

TEST_F(LifeVerb, WithoutSizesItSaysWhatItNeeds) {
  const Answer answer = sandbox_.pintle("life pendulum.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_TRUE(holds(answer.out, "joint pin: state type and dynamic_load_rating (C) for a life")) << answer.out;
  EXPECT_TRUE(holds(answer.out, "mean force"));
  EXPECT_FALSE(holds(answer.out, "L10h"));
}

// The model's dimensions, the same set on its run, and the run's own summary all give one table.
TEST_F(LifeVerb, RunAndModelAgree) {
  const Json of_model = bearing("life sized.toml --json");
  EXPECT_EQ(of_model["joint"], "pin");
  EXPECT_GT(of_model["life_hours"].get<double>(), 0);
  EXPECT_EQ(of_model["wants"].size(), 1U);  // the static rating
  EXPECT_EQ(sandbox_.pintle("run pendulum.toml -q").exit_code, 0);
  const Json of_run = bearing("life pendulum-run --json --set joint.pin.bearing.type=ball --set joint.pin.bearing.dynamic_load_rating='1 kN'");
  EXPECT_EQ(of_model, of_run);
  EXPECT_EQ(sandbox_.pintle("run sized.toml -q").exit_code, 0);
  EXPECT_EQ(Json::parse(sandbox_.read("sized-run/summary.json"))["bearings"][0], of_model);
  EXPECT_TRUE(holds(sandbox_.pintle("run sized.toml").out, "Rolling bearings"));
}

// Twice the rating gives eight times the life of a ball bearing.
TEST_F(LifeVerb, LifeGoesAsTheCubeOfTheRating) {
  const Json one = bearing("life sized.toml --json"), two = bearing("life sized.toml --json --set joint.pin.bearing.dynamic_load_rating='2 kN'");
  EXPECT_NEAR(two["life"].get<double>(), 8 * one["life"].get<double>(), 1e-9 * two["life"].get<double>());
}

TEST_F(LifeVerb, OfARunOnlyBearingsChange) {
  EXPECT_EQ(sandbox_.pintle("run pendulum.toml -q").exit_code, 0);
  for (const char* change : {"--set body.bob.mass=2", "--law joint.pin=linear,stiffness=1e6", "--duration 3", "--set joint.pin.stiffness=1e6"}) {
    const Answer answer = sandbox_.pintle(std::string("life pendulum-run ") + change);
    EXPECT_EQ(answer.exit_code, 2) << change;
    EXPECT_TRUE(holds(answer.error, "this would be another run")) << answer.error;
  }
}

TEST_F(LifeVerb, NonsenseIsLocated) {
  const Answer answer = sandbox_.pintle("life pendulum.toml --set joint.pin.bearing.dynamic_load_rating=0");
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(holds(answer.error, "--set:1:39: joint.pin.bearing.dynamic_load_rating")) << answer.error;
  EXPECT_EQ(sandbox_.pintle("life nowhere").exit_code, 6);
}

}  // namespace
}  // namespace pintle::sample

// pintle check, on the collection's four-bar and on faulty models.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/sandbox_for_tests.h"

namespace pintle::sample {
namespace {

const std::string kFourBar = std::string(PINTLE_SOURCE_DIR) + "/mechanisms/four_bar.toml";

TEST(CheckVerb, TellsMobilityLoopsAndBatteries) {
  Sandbox sandbox;
  const Answer answer = sandbox.pintle("check " + kFourBar);
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.error, "");
  for (const char* part : {"true mobility: 1", "O2", "Jacobians against finite differences: passed", "total mass 9.0000 kg"})
    EXPECT_TRUE(holds(answer.out, part)) << part;
  EXPECT_FALSE(holds(answer.out, "\x1b"));
}

TEST(CheckVerb, JsonHoldsTheSame) {
  Sandbox sandbox;
  const Answer answer = sandbox.pintle("check --json " + kFourBar);
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  const nlohmann::json report = nlohmann::json::parse(answer.out);
  EXPECT_EQ(report["pintle_check"], 1);
  EXPECT_EQ(report["mobility"]["mobility"], 1);
  EXPECT_EQ(report["topology"]["n_loops"], 1);
  EXPECT_EQ(report["frequencies"]["modes"].size(), 8U);
  EXPECT_TRUE(report["jacobian_battery"]["passed"].get<bool>());
}

TEST(CheckVerb, ExitCodesSayWhatIsWrong) {
  Sandbox sandbox;
  EXPECT_EQ(sandbox.pintle("check " + kFourBar + " --set body.crank.mass='-1 kg'").exit_code, 3);
  const Answer open = sandbox.pintle("check " + kFourBar + " --set ground.markers.O4='[20, 0]'");
  EXPECT_EQ(open.exit_code, 4);
  EXPECT_TRUE(holds(open.error, "loop: ")) << open.error;
}

// A force that becomes NaN at some time of the run is found before the run.
TEST(CheckVerb, NamesAnExpressionThatBreaksDown) {
  Sandbox sandbox;
  const std::string model =
      read_file(kFourBar) + "\n[force.push]\non = \"coupler.A\"\nforce = [\"1 N*sqrt(0.1 - t)\", 0]\n";
  sandbox.write("push.toml", model);
  const Answer answer = sandbox.pintle("check push.toml");
  EXPECT_EQ(answer.exit_code, 8) << answer.out;
  EXPECT_TRUE(holds(answer.out, "force push")) << answer.out;
}

}  // namespace
}  // namespace pintle::sample

// The crane's start: its load hangs in a rubber bushing that bounces at 5 Hz, whatever the stiffness of the steel pins.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reference_tables.h"
#include "start/start.h"

namespace pintle {
namespace {

constexpr int kBushing = 4;

State crane_with_pins(const std::string& stiffness) {
  std::vector<std::string> settings;
  for (const char* pin : {"O", "Q", "H_boom", "H_tie"})
    for (const std::string& value : {"stiffness=" + stiffness, std::string("damping=500")}) settings.push_back("joint." + std::string(pin) + "." + value);
  const Model model = reference::mechanism("crane_bushing", settings);
  const Assembly start = start_of_run(model);
  EXPECT_EQ(start.system.joints[kBushing].name, "bushing");
  return start.state;
}

// The difference is proportional to the pins' compliance, and vanishes with it.
TEST(SoftStart, TheLoadOfTheCraneBouncesAlikeOnPinsOfAnyStiffness) {
  const State limit = crane_with_pins("1e12");
  const double force = limit.force[kBushing].head<2>().norm(), rate = limit.gap_rate[kBushing].head<2>().norm();
  EXPECT_GT(rate, 0);
  for (const double k : {1e9, 1e10, 1e11}) {
    const State state = crane_with_pins(std::to_string(k));
    const double share = 2e-5 + 2e-3 * 1e9 / k;
    EXPECT_LT((state.force[kBushing] - limit.force[kBushing]).head<2>().norm(), share * force) << k;
    EXPECT_LT((state.gap_rate[kBushing] - limit.gap_rate[kBushing]).head<2>().norm(), share * rate) << k;
  }
}

}  // namespace
}  // namespace pintle

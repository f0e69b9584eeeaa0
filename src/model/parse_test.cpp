// Expressions that a program parses.
#include "pintle/parse.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace pintle {
namespace {

TEST(Parse, ConvertsUnitsAndKnowsTheVariablesGiven) {
  const Expression torque = parse("5 N*cm - 0.1*rate + pin.angle", {"rate", "pin.angle"});
  ASSERT_EQ(torque.variables(), (std::vector<std::string>{"rate", "pin.angle"}));
  EXPECT_NEAR(torque.value(std::array{2.0, 0.25}), 0.05 - 0.2 + 0.25, 1e-15);
  EXPECT_NEAR(parse("20*sin(3*t)").value(std::array{0.5}), 20 * std::sin(1.5), 1e-14);
}

TEST(Parse, SaysWhereATextIsWrong) {
  try {
    static_cast<void>(parse("2*x", {"t"}));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("\"2*x\", at character 3"), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(parse("2*(")), std::invalid_argument);
}

}  // namespace
}  // namespace pintle

#include "base/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/constants.h"

namespace pintle {
namespace {

struct KnownUnit {
  const char* text;
  double factor;
  Dimension dimension;
};

TEST(Units, KnownValues) {
  const KnownUnit known[] = {
      {"m", 1, kLength},
      {"mm", 0.001, kLength},
      {"in", 0.0254, kLength},
      {"ft", 0.3048, kLength},
      {"km", 1000, kLength},
      {"\xC2\xB5m", 1e-6, kLength},
      {"g", 0.001, kMass},
      {"lb", 0.45359237, kMass},
      {"slug", 14.59390293720636, kMass},
      {"oz", 0.028349523125, kMass},
      {"ozf", 0.27801385095378, kForce},
      {"kip", 4448.2216152605, kForce},
      {"ksi", 6894757.293168361, {{-1, 1, -2, 0}, false}},
      {"hp", 745.6998715822702, {{2, 1, -3, 0}, false}},
      {"mph", 0.44704, kLinearSpeed},
      {"lbf", 4.4482216152605, kForce},
      {"t", 1000, kMass},
      {"min", 60, kTime},
      {"h", 3600, kTime},
      {"us", 1e-6, kTime},
      {"MN", 1e6, kForce},
      {"mN", 1e-3, kForce},
      {"\xC2\xB5N", 1e-6, kForce},
      {"ug", 1e-9, kMass},
      {"kJ", 1000, kTorque},
      {"deg", kPi / 180, kAngle},
      {"\xC2\xB0", kPi / 180, kAngle},
      {"rev", 2 * kPi, kAngle},
      {"rpm", kPi / 30, kAngularSpeed},
      {"N/m", 1, kStiffness},
      {"N/mm", 1000, kStiffness},
      {"N*s/m", 1, kDamping},
      {"N*m/rad", 1, kAngularStiffness},
      {"N*m*s/rad", 1, kAngularDamping},
      {"kg*m^2", 1, kInertia},
      {"kg\xC2\xB7m\xC2\xB2", 1, kInertia},
      {"kg*mm^2", 1e-6, kInertia},
      {"m/s^2", 1, kAcceleration},
      {"m*s^-2", 1, kAcceleration},
      {"kg*m/(s*s)", 1, kForce},
      {"(kg*m)/(s^2)", 1, kForce},
      {"km/h", 1 / 3.6, kLinearSpeed},
      {"1/s", 1, {{0, 0, -1, 0}, false}},
      {"Hz", 1, {{0, 0, -1, 0}, false}},
      {"W", 1, {{2, 1, -3, 0}, false}},
      {"", 1, kPureNumber},
      {"1", 1, kPureNumber},
  };
  for (const KnownUnit& unit : known) {
    const std::optional<Unit> found = parse_unit(unit.text);
    ASSERT_TRUE(found) << unit.text;
    EXPECT_NEAR(found->factor / unit.factor, 1, 1e-14) << unit.text;
    EXPECT_EQ(found->dimension, unit.dimension) << unit.text;
  }
}

TEST(Units, NotUnits) {
  for (const char* text : {"x", "N*", "N m", "m^", "m^1.5", "m^x", "m^2^2", "(m", "m)", "2 m", "m^21", "m/", "*m", "Nm",
                           "m^20*m^20*m^20*m^20*m^20*m^20", "(((((((((((((((((((((((m)))))))))))))))))))))))"}) {
    EXPECT_FALSE(parse_unit(text)) << text;
  }
}

TEST(Units, EverySymbolIsListedOnceAndParses) {
  std::set<std::string_view> seen;
  for (const std::string_view symbol : unit_symbols()) {
    EXPECT_TRUE(seen.insert(symbol).second) << symbol;
    EXPECT_TRUE(is_unit_symbol(symbol));
    const std::optional<Unit> unit = parse_unit(symbol);
    ASSERT_TRUE(unit) << symbol;
    EXPECT_GT(unit->factor, 0);
  }
  EXPECT_FALSE(is_unit_symbol("crank"));
  EXPECT_FALSE(is_unit_symbol(""));
}

TEST(Units, EveryNameReadsBackAsItsDimension) {
  for (const Dimension& dimension :
       {kPureNumber, kLength, kMass, kTime, kAngle, kLinearSpeed, kAcceleration, kAngularSpeed, kInertia, kForce, kTorque,
        kStiffness, kDamping, kAngularStiffness, kAngularDamping, Dimension{{3, -2, 1, -1}, false},
        Dimension{{-1, 2, -3, 4}, false}}) {
    const std::optional<Unit> unit = parse_unit(to_unit_text(dimension));
    ASSERT_TRUE(unit) << to_unit_text(dimension);
    EXPECT_EQ(unit->factor, 1);
    EXPECT_EQ(unit->dimension, dimension);
  }
}

TEST(Units, Words) {
  EXPECT_EQ(to_words(kLength), "a length [m]");
  EXPECT_EQ(to_words(kStiffness), "a stiffness [N/m]");
  EXPECT_EQ(to_words(kBareNumber), "a bare number");
  EXPECT_EQ(to_words(kPureNumber), "a pure number");
  EXPECT_EQ(to_words({{1, 1, -3, 0}, false}), "a quantity in [kg*m/s^3]");
  EXPECT_EQ(to_words({{-1, 0, 0, 0}, false}), "a quantity in [1/m]");
}

TEST(Units, WhatFits) {
  EXPECT_TRUE(fits(kBareNumber, kMass));
  EXPECT_TRUE(fits(kAngle, kPureNumber));
  EXPECT_TRUE(fits(kTorque, kAngularStiffness));
  EXPECT_TRUE(fits({{0, 0, -1, 0}, false}, kAngularSpeed));
  EXPECT_FALSE(fits(kAngle, kLength));
  EXPECT_FALSE(fits(kStiffness, kAngularStiffness));
  EXPECT_EQ(check_dimension(kAngle, kPureNumber), std::nullopt);
  EXPECT_EQ(check_dimension(kAngle, kLength), "a length [m] is expected here, not an angle [rad]");
  EXPECT_EQ(check_dimension(kMass, kForce), "a force [N] is expected here, not a mass [kg]; g, kg, oz and lb are masses: the forces are N, ozf and lbf");
  EXPECT_EQ(check_dimension(parse_unit("ft*lb")->dimension, kTorque),
            "a torque or an energy [N*m] is expected here, not a quantity in [kg*m]; g, kg, oz and lb are masses: the forces are N, ozf and lbf");
  EXPECT_EQ(check_dimension(kForce, kMass), "a mass [kg] is expected here, not a force [N]; N, ozf and lbf are forces: the masses are g, kg, oz and lb");
  // 3*4/12 kg*m^2 is 12/(12 kg*m^2)
  EXPECT_EQ(check_dimension(*power(kInertia, -1), kInertia),
            "a moment of inertia [kg*m^2] is expected here, not a quantity in [1/kg/m^2]; a unit belongs to the number before it, so that parentheses are needed in (3*4/12) kg*m^2");
}

TEST(Units, ExponentsDoNotOverflow) {
  const Dimension large{{100, 0, 0, 0}, false};
  EXPECT_FALSE(product(large, kLength));
  EXPECT_FALSE(quotient({{-100, 0, 0, 0}, false}, kLength));
  EXPECT_FALSE(power(Dimension{{2, 0, 0, 0}, false}, 51));
  EXPECT_FALSE(power(kLength, 2000000000));
  EXPECT_EQ(power(kLength, -3), (Dimension{{-3, 0, 0, 0}, false}));
}

}  // namespace
}  // namespace pintle

// Blocks that hang at rest on a pin parallel to a spring of stiffness s: a pin of stiffness k carries W / (1 + s/k), so that every number of the procedure is
// known.
#include "pintle/stiffen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "pintle/read_model.h"

namespace pintle {
namespace {

constexpr double kWeight = 100;  // of each block, 10 kg [N]

// The springs parallel to the pins have 1.1e3 and 1e4 N/m; `second` holds keys of the second pin.
Model hanging_blocks(const std::string& second = "") {
  return parse_model(R"(
format = 1
name = "Two blocks"
gravity = [0, "-10 m/s^2"]
[simulate]
duration = "10 ms"
output_step = "1 ms"
start = "settled"
[ground.markers]
a = [0, "-1 m"]
b = ["2 m", "-1 m"]
high_a = [0, 0]
high_b = ["2 m", 0]
[body.block1]
mass = "10 kg"
inertia = "1 kg*m^2"
position = [0, "-1 m"]
angle = 0
markers.c = [0, 0]
[body.block2]
mass = "10 kg"
inertia = "1 kg*m^2"
position = ["2 m", "-1 m"]
angle = 0
markers.c = [0, 0]
[joint.A]
type = "revolute"
between = ["ground.a", "block1.c"]
[spring.a]
between = ["ground.high_a", "block1.c"]
stiffness = "1.1e3 N/m"
free_length = "1 m"
[spring.b]
between = ["ground.high_b", "block2.c"]
stiffness = "1e4 N/m"
free_length = "1 m"
[joint.B]
type = "revolute"
between = ["ground.b", "block2.c"]
)" + second, "blocks.toml");
}

double carried(double spring, double pin) { return kWeight / (1 + spring / pin); }

TEST(StiffenByHand, RaisesTenfoldUntilTheDigitsAgree) {
  StiffenRequest request;
  request.digits = 3;
  const Stiffening s = stiffen(hanging_blocks(), request);
  ASSERT_TRUE(s.found) << s.reason;
  EXPECT_DOUBLE_EQ(s.stiffness, 1e9);  // from 1e8 it changes by 9e-5, from 1e7 to 1e8 by 9e-4
  ASSERT_EQ(s.steps.size(), 4u);
  ASSERT_EQ(s.quantities, (std::vector<std::string>{"A", "B"}));
  EXPECT_TRUE(std::isnan(s.steps[0].change));
  for (std::size_t i = 0; i < 4; ++i) {
    const double k = 1e6 * std::pow(10, static_cast<double>(i));
    EXPECT_DOUBLE_EQ(s.steps[i].stiffness, k);
    EXPECT_NEAR(s.steps[i].peaks[0], carried(1.1e3, k), 1e-9 * kWeight);
    EXPECT_NEAR(s.steps[i].peaks[1], carried(1e4, k), 1e-9 * kWeight);
    if (i == 0) continue;
    EXPECT_EQ(s.steps[i].where, "B");
    EXPECT_NEAR(s.steps[i].change, 1 - carried(1e4, k / 10) / carried(1e4, k), 1e-8);
    EXPECT_NEAR(s.steps[i].changes[0], 1 - carried(1.1e3, k / 10) / carried(1.1e3, k), 1e-8);
  }
  for (const StiffenLimit& limit : s.limits) {
    EXPECT_NEAR(limit.limit, kWeight, 1e-8 * kWeight) << limit.name;
    EXPECT_EQ(limit.unit, "N");
  }
  EXPECT_EQ(s.limits[0].digits, 4);  // 1e-5
  EXPECT_EQ(s.limits[1].digits, 3);  // 9e-5
}

// Pins are softened within half the wanted agreement: A to 1e7, B to 1e8 N/m, where they change the forces by 1.1e-4 and 1e-4.
TEST(StiffenByHand, SoftensThePinsThatMatterLittle) {
  StiffenRequest request;
  request.digits = 3;
  const Stiffening s = stiffen(hanging_blocks(), request);
  ASSERT_EQ(s.joints.size(), 2u);
  EXPECT_DOUBLE_EQ(s.joints[0].stiffness, 1e7);
  EXPECT_DOUBLE_EQ(s.joints[1].stiffness, 1e8);
  for (const StiffenJoint& joint : s.joints) {
    EXPECT_NEAR(joint.influence, joint.name == "A" ? 1.1e-4 : 1e-4, 1e-6) << joint.name;
    EXPECT_FALSE(joint.kept);
    EXPECT_EQ(joint.stated, 1e8);
    EXPECT_EQ(joint.damping, 500);
    EXPECT_EQ(joint.angular_stiffness, 0);
  }
  EXPECT_EQ(s.kept_influence, 0);
}

// With two runs the limit's error is its distance from the last one; with three, a tenth of the change by the last one. The runs' own errors are added in both
// cases.
TEST(StiffenByHand, TheLimitStatesItsError) {
  StiffenRequest request;
  request.digits = 7;
  request.last = 1e7;
  const Stiffening two = stiffen(hanging_blocks(), request);
  EXPECT_FALSE(two.found);
  ASSERT_EQ(two.steps.size(), 2u);
  request.last = 1e8;
  const Stiffening three = stiffen(hanging_blocks(), request);
  ASSERT_EQ(three.steps.size(), 3u);
  const auto own = [](const Stiffening& s, std::size_t i) { return 1.3 * s.steps.back().error_estimate * s.steps.back().peaks[i]; };
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(two.limits[i].error, own(two, i) + std::abs(two.limits[i].limit - two.limits[i].peak), 1e-12);
    EXPECT_NEAR(three.limits[i].error, own(three, i) + std::abs(three.limits[i].limit - two.limits[i].limit) / 10, 1e-12);
    EXPECT_GE(three.limits[i].error, std::abs(three.limits[i].limit - kWeight));
  }
  EXPECT_NE(three.reason.find("B still changes by 0.0009 of its peak from 1e+07 to 1e+08 N/m; the change falls as 1/stiffness: 1e+08 N/m is within 0.0001 of the limit"),
            std::string::npos) << three.reason;
}

TEST(StiffenByHand, MotionNeedsLess) {
  StiffenRequest request;
  request.digits = 3;
  request.motion_only = true;
  const Stiffening s = stiffen(hanging_blocks(), request);
  ASSERT_TRUE(s.found) << s.reason;
  EXPECT_EQ(s.steps.front().stiffness, 1e5);
  EXPECT_DOUBLE_EQ(s.stiffness, 1e7);  // the blocks, 1 m below, sink by 1e-5 m; at 1e6 N/m by 1e-4 m
}

// Rubber is intentionally soft, whether its stiffness is stated or not (then 1e5 N/m).
TEST(StiffenByHand, RubberIsKept) {
  StiffenRequest request;
  request.digits = 3;
  const Stiffening s = stiffen(hanging_blocks("law = \"rubber-bushing\"\n"), request);
  EXPECT_FALSE(s.joints[0].kept);
  const StiffenJoint& rubber = s.joints[1];
  EXPECT_TRUE(rubber.kept);
  EXPECT_EQ(rubber.stated, 1e5);
  EXPECT_EQ(rubber.stiffness, 1e5);
  EXPECT_EQ(rubber.damping, 500);
  // Without rubber B would carry the whole weight, a tenth more than with it.
  EXPECT_EQ(s.kept_where, "B");
  EXPECT_NEAR(s.kept_influence, 0.1, 1e-3);
  EXPECT_NE(s.reason.find("B: its own flexibility matters"), std::string::npos) << s.reason;
  const Model model = stiffened(hanging_blocks("law = \"rubber-bushing\"\n"), s.joints);
  EXPECT_EQ(model.joints[1].law.values.at("stiffness").front(), 1e5);
  EXPECT_EQ(model.joints[0].law.values.at("stiffness").front(), s.joints[0].stiffness);
}

TEST(StiffenByHand, OnlyTheChosenJointsCount) {
  StiffenRequest request;
  request.digits = 3;
  request.joints = {"A"};
  const Stiffening s = stiffen(hanging_blocks(), request);
  EXPECT_EQ(s.quantities, (std::vector<std::string>{"A"}));
  EXPECT_DOUBLE_EQ(s.stiffness, 1e8);  // from 1e7 it changes by 1e-4
}

// As a fraction of critical damping: 2 zeta sqrt(k m). A weld also holds the angle, scaled by the mechanism's length.
TEST(StiffenByHand, DampingMayBeOfCritical) {
  StiffenRequest request;
  request.digits = 3;
  request.damping_ratio = 0.3;
  const Stiffening s = stiffen(hanging_blocks(), request);
  for (const StiffenJoint& joint : s.joints) EXPECT_NEAR(joint.damping, 2 * 0.3 * std::sqrt(joint.stiffness * 10), 1e-6 * joint.damping) << joint.name;
}

TEST(StiffenByHand, AnglesAreHeldByTheMechanismsLength) {
  Model model = hanging_blocks();
  model.joints[0].type = "fixed";
  StiffenRequest request;
  request.digits = 3;
  const Stiffening s = stiffen(model, request);
  ASSERT_TRUE(s.found) << s.reason;
  const StiffenJoint& weld = s.joints[0];
  EXPECT_GT(weld.angular_stiffness, 0);
  EXPECT_NEAR(weld.angular_damping / weld.damping, weld.angular_stiffness / weld.stiffness, 1e-9 * weld.angular_stiffness / weld.stiffness);
  const Model stiff = stiffened(model, s.joints);
  EXPECT_EQ(stiff.joints[0].law.values.at("angular_stiffness").front(), weld.angular_stiffness);
  EXPECT_EQ(stiff.joints[1].law.values, stiffened(model, {s.joints[1]}).joints[1].law.values);
  EXPECT_EQ(stiff.joints[1].law.values.at("angular_stiffness"), model.joints[1].law.values.at("angular_stiffness"));  // a pin holds no angle
}

TEST(StiffenByHand, WithNothingToRaiseItSaysSo) {
  Model model = hanging_blocks("law = \"rubber-bushing\"\n");
  model.joints[0].law = model.joints[1].law;
  const Stiffening s = stiffen(model, {});
  EXPECT_TRUE(s.steps.empty());
  EXPECT_NE(s.reason.find("no joint has a stiffness to raise"), std::string::npos) << s.reason;
}

}  // namespace
}  // namespace pintle

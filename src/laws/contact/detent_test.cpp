// A ball in its notches: geometry by hand, the breakaway force and moment in closed form.
#include "laws/contact/detent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "laws/catalog.h"
#include "laws/law.h"

namespace pintle {
namespace {

using Vec = Planar::Vec;

// sin phi = 3/5: the ball reaches the edge 1.2 mm from the middle, lifted by 2 mm (1 - 4/5), and lies on the surface 3 mm from it, lifted by a further 3 mm/5.
constexpr NotchProfile kNotch{.ball = 3e-3, .notch = 5e-3, .width = 6e-3, .pitch = 0};

TEST(Detent, TheBallIsLiftedByArcAndEdge) {
  EXPECT_DOUBLE_EQ(kNotch.edge(), 1.2e-3);
  EXPECT_EQ(kNotch.at(0).y, 0);
  EXPECT_NEAR(kNotch.at(1.2e-3).y, 0.4e-3, 1e-17);
  EXPECT_NEAR(kNotch.at(1.2e-3).slope, 0.75, 1e-14);
  EXPECT_NEAR(kNotch.at(-1.2e-3 - 1e-12).slope, -0.75, 1e-8);
  EXPECT_NEAR(kNotch.at(3e-3).y, 1e-3, 1e-17);
  EXPECT_EQ(kNotch.at(3.1e-3).slope, 0);
  // On the edge the ball's centre moves on a circle of the ball's radius about the edge.
  for (const double u : {1.3e-3, 2e-3, 2.9e-3}) {
    const BallLift lift = kNotch.at(u);
    EXPECT_NEAR(std::hypot(3e-3 - u, lift.y - 1e-3 + 3e-3), 3e-3, 1e-17);
    const double h = 1e-7;
    EXPECT_NEAR((kNotch.at(u + h).y - kNotch.at(u - h).y) / (2 * h), lift.slope, 1e-7);
    EXPECT_NEAR((kNotch.at(u + h).slope - kNotch.at(u - h).slope) / (2 * h), lift.curvature, 1e-4 * std::abs(lift.curvature));
  }
}

// With a soft spring and a high preload the largest resistance is at the edge: (F_0 + k y_1) tan phi.
TEST(Detent, BreaksAwayAtTheEdge) {
  for (const bool turns : {false, true}) {
    const std::string type = turns ? "revolute" : "prismatic";
    std::map<std::string, std::vector<double>> values{{"ball_radius", {3e-3}}, {"notch_radius", {5e-3}}, {"notch_width", {6e-3}}, {"detent_preload", {20}}, {"detent_rate", {5e3}}};
    if (turns) {
      values["detent_radius"] = {0.02};
      values["detent_pitch"] = {std::numbers::pi / 6};
    }
    const LawInfo& info = *find_law("ball-detent");
    LawSetting at;
    at.joint_type = type;
    at.free[turns ? 2 : 0] = true;
    at.values = &values;
    at.keys = info.keys;
    ASSERT_EQ(info.fault(at).key, "");
    Law law;
    info.make(at, law);
    const double radius = turns ? 0.02 : 1, still[3] = {};
    double most = 0;
    for (int i = 0; i <= 3000; ++i) {
      Vec gap = Vec::Zero();
      gap[turns ? 2 : 0] = i * 1e-6 / radius;
      most = std::max(most, -law.force({0, gap, Vec::Map(still), nullptr})[turns ? 2 : 0]);
    }
    EXPECT_NEAR(most, radius * (20 + 5e3 * 0.4e-3) * 0.75, 1e-9);
    // The work to lift the ball over the edge, once through: F_0 y + k y^2/2 at y = 1 mm. The next notch, a twelfth of a turn on, is the same.
    Vec out = Vec::Zero(), next = Vec::Zero();
    out[turns ? 2 : 0] = 3.05e-3 / radius;
    next[2] = std::numbers::pi / 6 + 1e-3 / radius;
    EXPECT_NEAR(law.energy({0, out, Vec::Map(still), nullptr}), 20e-3 + 0.5 * 5e3 * 1e-6, 1e-15);
    if (!turns) continue;
    const double again = kNotch.at(1e-3).y;
    EXPECT_NEAR(law.energy({0, next, Vec::Map(still), nullptr}), (20 + 2.5e3 * again) * again, 1e-12);
  }
}

TEST(Detent, WrongNotchesAreRefused) {
  const LawInfo& info = *find_law("ball-detent");
  const auto fault = [&info](const std::string& key, double value) {
    std::map<std::string, std::vector<double>> values{{"ball_radius", {3e-3}}, {"notch_radius", {5e-3}}, {"notch_width", {6e-3}}, {"detent_preload", {20}}, {"detent_radius", {0.02}}};
    values[key] = {value};
    LawSetting at;
    at.joint_type = "revolute";
    at.free = {false, false, true};
    at.values = &values;
    at.keys = info.keys;
    return info.fault(at).key;
  };
  EXPECT_EQ(fault("ball_radius", 6e-3), "notch_radius");
  EXPECT_EQ(fault("notch_width", 11e-3), "notch_width");
  EXPECT_EQ(fault("detent_radius", 0), "detent_radius");
  EXPECT_EQ(fault("detent_pitch", 0.1), "detent_pitch");
  EXPECT_EQ(fault("detent_pitch", 1), "detent_pitch");
  EXPECT_EQ(fault("detent_pitch", std::numbers::pi / 6), "");
}

}  // namespace
}  // namespace pintle

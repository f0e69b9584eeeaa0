// Detents in whole runs: loads that a ball holds and loads that it does not, ringing in a notch, balances.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "pintle/complaint.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::drift;
using reference::value;

// sin phi = 3/5, edge reached at a lift of 0.4 mm: it holds (20 + 2) N tan phi = 16.5 N, or 0.33 N*m at 20 mm.
const std::string kBall = R"(detent = "ball-detent"
ball_radius = "3 mm"
notch_radius = "5 mm"
notch_width = "6 mm"
detent_preload = "20 N"
detent_rate = "5 N/mm"
)";

// A slide of 1 kg or a disc of 4e-4 kg*m^2 with the detent, pushed or turned.
Model detent(bool turns, const std::string& push, const std::string& more = "", double speed = 0) {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "0.5 s"
tolerance = 1e-6
[ground.markers]
o = [0, 0]
[body.block]
mass = 1
inertia = 4e-4
position = [0, 0]
velocity = [{}, 0]
spin = {}
angle = 0
hold = ["x", "y", "angle"]
markers.c = [0, 0]
[joint.guide]
type = "{}"
between = ["ground.o", "block.c"]
{}{}{}
[motor.push]
joint = "guide"
{} = "{}"
)toml",
                                 turns ? 0 : speed, turns ? speed / 0.02 : 0, turns ? "revolute" : "prismatic", kBall, turns ? "detent_radius = \"20 mm\"\ndetent_pitch = \"30 deg\"\n" : "", more,
                                 turns ? "torque" : "force", push),
                     "detent.toml");
}

// Pushed slowly to just below and just above the load that it holds.
TEST(Detents, ABallHoldsUpToItsBreakawayForce) {
  for (const bool turns : {false, true})
    for (const double share : {0.99, 1.01}) {
      const double most = turns ? 0.33 : 16.5;
      const Trajectory run = completed(detent(turns, fmt::format("{} {}*smoothstep(0 s, 0.4 s, t)", share * most, turns ? "N*m" : "N")));
      const double moved = turns ? 0.02 * at_end(run, "joint.guide.angle") : at_end(run, "joint.guide.slide");
      if (share < 1) EXPECT_LT(moved, 1.2e-3);
      else EXPECT_GT(moved, 3e-3);
      double held = 0;
      for (std::size_t i = 0; i < run.n_rows(); ++i) held = std::max(held, std::abs(value(run, i, "joint.guide.detent")));
      EXPECT_LT(held, 1.0001 * most);
      EXPECT_LT(drift(run), 1e-5);
    }
}

// Without friction a notch takes no energy: a body leaves it as fast as it came; while out, the lift reduces the square of its speed by 2 (F_0 y + k y^2/2)/m.
TEST(Detents, ABodyThatGetsOutHasPaidTheLift) {
  const double lift = 20e-3 + 0.5 * 5e3 * 1e-6, speed = 0.4;
  const Trajectory run = completed(detent(false, "0 N", "", speed));
  EXPECT_NEAR(at_end(run, "joint.guide.slide_rate"), std::sqrt(speed * speed - 2 * lift), 1e-6);
  EXPECT_NEAR(at_end(run, "joint.guide.detent_lift"), 1e-3, 1e-12);
  const Trajectory held = completed(detent(false, "0 N", "", 0.2));  // 20 mJ of 22.5
  for (std::size_t i = 0; i < held.n_rows(); ++i) EXPECT_LT(std::abs(value(held, i, "joint.guide.slide")), 3e-3);
  EXPECT_LT(drift(held), 1e-5);
}

// w^2 = F_0/(rho - R)/m for small swings.
TEST(Detents, RingsInItsNotch) {
  Model model = detent(false, "0 N", "", 1e-3);
  const Trajectory run = completed(model);
  const double w = std::sqrt(20 / 2e-3);
  for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_NEAR(value(run, i, "joint.guide.slide"), 1e-3 / w * std::sin(w * value(run, i, "t")), 2e-8);
}

TEST(Detents, OneOfAnotherJointIsLocated) {
  try {
    parse_model("format = 1\nground.markers.o = [0, 0]\n[body.a]\nmass = 1\ninertia = 1\nmarkers.c = [0, 0]\n[joint.j]\ntype = \"slot\"\nbetween = [\"ground.o\", \"a.c\"]\n" + kBall, "slot.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("slot.toml:10"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("revolute, prismatic"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pintle

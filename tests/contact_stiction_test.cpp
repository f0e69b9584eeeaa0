// Surfaces in contact that stick: blocks and rollers on a slope, in closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/constants.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::value;

// A body on the +y side of an edge that falls by `slope` (its tangent) to the right; its centre is the pin, of `radius`.
Model on_slope(double slope, double radius, const std::string& friction, const std::string& method = "radau") {
  const double angle = std::atan(slope), c = std::cos(angle), s = std::sin(angle);
  return parse_model(fmt::format(R"toml(
format = 1
[simulate]
duration = "0.5 s"
output_step = "5 ms"
tolerance = 1e-6
method = "{}"
[ground.markers]
slope = [0, 0, "{:.17g} rad"]
[body.block]
mass = 2
inertia = {:.17g}
position = [{:.17g}, {:.17g}]
angle = 0
velocity = [0, 0]
spin = 0
markers.c = [0, 0]
[joint.floor]
type = "slot"
between = ["ground.slope", "block.c"]
law = "contact"
pin_radius = {}
contact_model = "linear"
contact_stiffness = 1e7
contact_damping = 2e3
contact_exponent = 1
{}
)toml",
                                 method, -angle, radius > 0 ? 0.5 * 2 * radius * radius : 1e-3, radius * s, radius * c, radius, friction),
                     "slope.toml");
}

double along(const Trajectory& run, std::size_t row, double slope) {
  const double angle = std::atan(slope);
  return value(run, row, "body.block.x") * std::cos(angle) - value(run, row, "body.block.y") * std::sin(angle);
}

constexpr const char* kStiction = "friction_coefficient = 0.2\nstatic_friction = 0.3";

// Under a push that grows to a thousandth less or more than the static coefficient holds.
TEST(ContactStiction, ABlockHoldsUpToTheStaticCoefficient) {
  const auto pushed = [](double share) {
    const double push = share * 0.3 * 2 * kStandardGravity;
    return completed(on_slope(0, 0, fmt::format("{}\n[force.push]\non = \"block.c\"\nforce = [\"{:.17g}*smoothstep(0, 0.3, t)\", 0]", kStiction, push)));
  };
  const Trajectory held = pushed(0.999), broken = pushed(1.001);
  EXPECT_NEAR(at_end(held, "body.block.x"), 0.999 * 0.3 * 2 * kStandardGravity / 1e8, 1e-10);
  EXPECT_EQ(at_end(held, "joint.floor.stuck"), 1);
  EXPECT_GT(at_end(broken, "body.block.x"), 0.01);
  EXPECT_EQ(at_end(broken, "joint.floor.stuck"), 0);
}

// On a slope steeper than its static coefficient a block slides against the kinetic one.
TEST(ContactStiction, ABlockSlidesOnASteepSlope) {
  const Trajectory slid = completed(on_slope(0.3 + 1e-2, 0, kStiction));
  EXPECT_EQ(at_end(slid, "joint.floor.stuck"), 0);
  const double slope = 0.3 + 1e-2, accel = kStandardGravity * (std::sin(std::atan(slope)) - 0.2 * std::cos(std::atan(slope)));
  EXPECT_NEAR(along(slid, slid.n_rows() - 1, slope), 0.5 * accel * 0.25, 2e-3 * accel);
}

// With a friction ramp it creeps.
TEST(ContactStiction, WithoutItABlockCreeps) {
  const Trajectory run = completed(on_slope(0.1, 0, "friction_coefficient = 0.2"));
  EXPECT_NEAR(along(run, run.n_rows() - 1, 0.1), 0.5 * 0.5e-3, 5e-6);  // half of friction_full_speed
}

// A disc rolls with two thirds of the acceleration while friction suffices, up to a slope of three times the static coefficient, and slips beyond; in every
// method.
TEST(ContactStiction, ARollerRollsUntilItSlips) {
  for (const char* method : {"radau", "dopri5", "ode15s"}) {
    const double slope = 0.5, angle = std::atan(slope);
    const Trajectory rolls = completed(on_slope(slope, 0.05, kStiction, method));
    const std::size_t last = rolls.n_rows() - 1;
    const double way = along(rolls, last, slope) - along(rolls, 0, slope), accel = 2.0 / 3 * kStandardGravity * std::sin(angle);
    EXPECT_NEAR(way, 0.5 * accel * 0.25, 1e-5) << method;
    EXPECT_NEAR(at_end(rolls, "body.block.spin"), -accel * 0.5 / 0.05, 1e-3) << method;
    EXPECT_EQ(at_end(rolls, "joint.floor.stuck"), 1) << method;
  }
  const double slope = 1, angle = std::atan(slope);
  const Trajectory slips = completed(on_slope(slope, 0.05, kStiction));
  const std::size_t last = slips.n_rows() - 1;
  const double accel = kStandardGravity * (std::sin(angle) - 0.2 * std::cos(angle));
  EXPECT_NEAR(along(slips, last, slope) - along(slips, 0, slope), 0.5 * accel * 0.25, 2e-3 * accel);
  EXPECT_NEAR(at_end(slips, "body.block.spin"), -0.2 * kStandardGravity * std::cos(angle) * 2 / 0.05 * 0.5, 0.2);
  EXPECT_EQ(at_end(slips, "joint.floor.stuck"), 0);
}

// A ball that strikes a floor obliquely without bouncing sticks when its slip has ended, and rolls on with 2/3 of its speed (a disc).
TEST(ContactStiction, SlidingEndsInRollingAndIsAnEvent) {
  Model model = on_slope(0, 0.05, kStiction);
  model.bodies[0].velocity = {{1.5, 0}};
  const Trajectory run = completed(model);
  EXPECT_NEAR(at_end(run, "body.block.vx"), 1.0, 2e-3);
  EXPECT_NEAR(at_end(run, "body.block.spin"), -20, 4e-2);
  ASSERT_EQ(run.events.size(), 1U);
  double sticks = -1;
  for (const JointEvent& event : run.events.front().events)
    if (event.what == "sticks" && sticks < 0) sticks = event.t;
  EXPECT_NEAR(sticks, 0.5 / (0.2 * kStandardGravity), 2e-3);  // slip falls by 3 mu g t
}

// A loose slider in a guide inclined by 6 degrees lies on it with both ends, which hold it up to 16.7 degrees and slide beyond.
TEST(ContactStiction, TheEndsOfALooseSliderHoldItOnASlope) {
  const auto run = [](double degrees) {
    const double angle = -degrees * std::numbers::pi / 180;
    return completed(parse_model(fmt::format(R"toml(
format = 1
[simulate]
duration = "0.3 s"
tolerance = 1e-4
[ground.markers]
guide = [0, 0, "{0} deg"]
[body.slider]
mass = 1
inertia = 1e-3
position = [{1:.17g}, {2:.17g}]
angle = 0
velocity = [0, 0]
spin = 0
markers.s = [0, 0, "{0} deg"]
[joint.guide]
type = "prismatic"
between = ["ground.guide", "slider.s"]
law = "clearance"
clearance = "0.1 mm"
guide_length = "50 mm"
contact_model = "linear"
contact_stiffness = 1e7
contact_damping = 2e3
contact_exponent = 1
friction_coefficient = 0.2
static_friction = 0.3
)toml",
                                             -degrees, 1e-4 * std::sin(angle), -1e-4 * std::cos(angle)),
                                 "slider.toml"));
  };
  const Trajectory held = run(6), slid = run(20);
  for (const char* end : {"joint.guide.stuck_front", "joint.guide.stuck_rear"}) {
    EXPECT_EQ(at_end(held, end), 1);
    EXPECT_EQ(at_end(slid, end), 0);
  }
  EXPECT_NEAR(at_end(held, "joint.guide.slide_rate"), 0, 1e-9);
  EXPECT_NEAR(at_end(held, "joint.guide.friction"), -kStandardGravity * std::sin(6 * std::numbers::pi / 180), 1e-3);
  EXPECT_EQ(at_end(held, "joint.guide.stuck"), 1);
  EXPECT_EQ(at_end(slid, "joint.guide.stuck"), 0);
  const auto jammed = [](const Trajectory& of) {
    return std::any_of(of.notes.begin(), of.notes.end(), [](const std::string& note) { return note.find("joint guide") != std::string::npos && note.find("friction") != std::string::npos; });
  };
  EXPECT_TRUE(jammed(held));
  EXPECT_FALSE(jammed(slid));
  const double angle = 20 * std::numbers::pi / 180, accel = kStandardGravity * (std::sin(angle) - 0.2 * std::cos(angle));
  EXPECT_NEAR(at_end(slid, "joint.guide.slide_rate"), 0.3 * accel, 0.02 * accel);
}

TEST(ContactStiction, RefusesAStaticCoefficientBelowTheKineticOne) {
  EXPECT_THROW(on_slope(0.1, 0.05, "friction_coefficient = 0.4\nstatic_friction = 0.3"), InputError);
  EXPECT_THROW(on_slope(0.1, 0.05, "static_friction = 0.3"), InputError);  // there would be no kinetic friction
}

// Surfaces that overlap without pressing on each other, because their damping holds them back, do not rub, whichever way they slip.
TEST(ContactStiction, NothingSticksWhereNothingPresses) {
  const Trajectory run = completed(reference::test_model("foot_on_a_shaking_plate"));
  int unpressed = 0;
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    const double normal = value(run, row, "joint.floor.contact_force"), friction = std::abs(value(run, row, "joint.floor.on_f.f1[joint]"));
    EXPECT_LE(friction, 0.6 * normal + 1e-9) << "row " << row;
    unpressed += normal == 0 && value(run, row, "joint.floor.penetration") > 0 ? 1 : 0;
    EXPECT_FALSE(normal == 0 && value(run, row, "joint.floor.stuck") != 0) << "row " << row;
  }
  EXPECT_GT(unpressed, 50);
  for (const JointEvent& event : run.events.at(0).events) EXPECT_GE(event.values.back(), 0) << event.what << ' ' << event.t;  // heat
}

// Contacts with a restitution of 0.2 follow a load that rises in 1.5 s so slowly that at its end they do not share it as springs do; with the damping of faster
// impacts they do.
TEST(ContactStiction, ContactsThatDampingHoldsBackAreNoted) {
  const auto notes = [](const Trajectory& run) {
    std::string all;
    for (const std::string& note : run.notes) all += note + "\n";
    return all;
  };
  const std::string slow = notes(completed(reference::test_model("girder_on_four_supports")));
  EXPECT_NE(slow.find("contacts that are still settling under their load at the end (a, b, c, d): up to 0.5 of their force is damping"), std::string::npos) << slow;
  const Trajectory run = completed(reference::test_model("girder_on_four_supports", {"defaults.joint.least_approach_speed=0.1"}));
  EXPECT_EQ(notes(run).find("still settling under their load"), std::string::npos);
  EXPECT_NEAR(reference::at_end(run, "joint.c.contact_force"), 209725, 20);  // from two equations of statics and four springs
}

// A block that is pressed ever harder on a stop, then held there: the stop's spring of 1e6 N/m carries less than the load of 610 N.
TEST(ContactStiction, StopsThatDampingHoldsBackAreNoted) {
  constexpr const char* lowered = R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "1 s"
[ground.markers]
g = [0, 0]
[body.b]
mass = 1
inertia = 1
markers.c = [0, 0]
[joint.g]
type = "prismatic"
between = ["ground.g", "b.c"]
stops = "hard"
upper_stop = 0
stop_stiffness = 1e6
stop_restitution = 0.3
[force.p]
on = "b.c"
force = ["10 N + 600 N*smoothstep(0, 0.5 s, t)", 0]
)toml";
  const auto notes = [](const Trajectory& run) { return fmt::format("{}", fmt::join(run.notes, "\n")); };
  const Trajectory slow = completed(parse_model(lowered, "lowered.toml"));
  const double depth = reference::at_end(slow, "joint.g.stop_depth");
  EXPECT_LT(depth, 0.7 * 610e-6);
  const std::string share = fmt::format("stops that are still settling under their load at the end (g): up to {:.2g} of their force is damping", 1 - depth / 610e-6);
  EXPECT_NE(notes(slow).find(share), std::string::npos) << notes(slow) << share;
  EXPECT_NE(notes(slow).find("in an impact at stop_least_speed;"), std::string::npos) << notes(slow);
  std::string faster = lowered;
  faster.insert(faster.find("stop_restitution"), "stop_least_speed = 0.1\n");
  const Trajectory fast = completed(parse_model(faster, "lowered.toml"));
  EXPECT_EQ(notes(fast).find("still settling"), std::string::npos) << notes(fast);
  EXPECT_NEAR(reference::at_end(fast, "joint.g.stop_depth"), 610e-6, 1e-6);
}

}  // namespace
}  // namespace pintle

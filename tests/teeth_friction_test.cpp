// Friction of teeth: moments transmitted by a mesh, a rack and a planetary gear, against the balance of moments.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::value;

constexpr double kMu = 0.1, kSliding = 2.4e-3, kAlpha = 20 * std::numbers::pi / 180;
const double kLever = kMu * kSliding / std::cos(kAlpha);  // moment of friction per force on the pitch circles [m]

// A driven gear of 60 mm that turns another, of 120 mm, against a constant moment, at constant speed.
Model gear_pair(const std::string& mesh, double load) {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "0.3 s"
output_step = "1 ms"
tolerance = 1e-6
[ground.markers]
A = [0, 0]
B = ["180 mm", 0]
[body.a]
mass = 1
inertia = 2e-3
position = [0, 0]
angle = 0
spin = 50
hold = ["angle"]
markers.O = [0, 0]
[body.b]
mass = 2
inertia = 8e-3
position = ["180 mm", 0]
angle = 0
spin = -25
markers.O = [0, 0]
[joint.A]
type = "revolute"
between = ["ground.A", "a.O"]
[joint.B]
type = "revolute"
between = ["ground.B", "b.O"]
[joint.mesh]
type = "gear"
between = ["a.O", "b.O"]
radii = ["60 mm", "120 mm"]
pressure_angle = "20 deg"
sliding_distance = {:.17g}
{}
[motor.drive]
joint = "A"
speed = 50
[force.load]
on = "b.O"
torque = {:.17g}
)toml",
                                 kSliding, mesh, load),
                     "gears.toml");
}

constexpr const char* kLaws[] = {"Coulomb", "LuGre", "Stribeck", "CoulombAndBacklash"};
class TeethFriction : public testing::TestWithParam<const char*> {};

// The motor carries the load over the ratio, plus friction: T1 = F (r1 + l'), T2 = F (r2 - l').
TEST_P(TeethFriction, TakesItsShareOfThePower) {
  const Trajectory run = completed(gear_pair(std::string(GetParam()) + "friction_coefficient = 0.1\nstatic_friction = 0.1\n", 30));
  const double force = 30 / (0.12 - kLever), moment = force * (0.06 + kLever);
  EXPECT_NEAR(at_end(run, "motor.drive.effort"), moment, 1e-4 * moment);
  EXPECT_NEAR(at_end(run, "joint.mesh.friction_power"), kLever * force * 75, 1e-3);
  EXPECT_NEAR(at_end(run, "joint.mesh.radial_force"), force * std::tan(kAlpha), 1e-3 * force);
  // Power in less friction power is power out: the efficiency of the mesh.
  const double passes = 30 * 25 / (at_end(run, "motor.drive.effort") * 50);
  EXPECT_NEAR(1 - passes, kMu * kSliding * (1 / 0.06 + 1 / 0.12) / std::cos(kAlpha), 2e-4);
}
INSTANTIATE_TEST_SUITE_P(Laws, TeethFriction, testing::Values("friction = \"coulomb\"\n", "friction = \"lugre\"\n", "friction = \"stribeck\"\n", "friction = \"coulomb\"\nlaw = \"backlash\"\nbacklash = \"0.1 mm\"\ncontact_stiffness = 1e8\nrestitution = 0.5\n"),
                         [](const auto& of) { return std::string(kLaws[of.index]); });

// A fixed ring, a driving carrier, a driven sun: the planet turns relative to both, and its two meshes lose mu l w (Fs/cos a) each, with w the spin relative to
// the sun and to the ring.
TEST(PlanetaryFriction, IsThatOfTheRelativeTurns) {
  constexpr double kSun = 0.03, kPlanet = 0.02, kRing = kSun + 2 * kPlanet, kSpeed = 20;
  const double sun = kSpeed * (1 + kRing / kSun), planet = kSpeed * (1 - kRing / kPlanet);
  const auto mesh = [](const char* name, const char* between, double first, double second, const char* kind) {
    return fmt::format("[joint.{}]\ntype = \"gear\"\nbetween = {}\nradii = [{:.17g}, {:.17g}]\nmesh = \"{}\"\nfriction = \"coulomb\"\nfriction_coefficient = 0.1\nstatic_friction = 0.1\nsliding_distance = 2.4e-3\n", name, between, first, second, kind);
  };
  const std::string text = fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "0.3 s"
output_step = "1 ms"
tolerance = 1e-6
[ground.markers]
O = [0, 0]
[body.carrier]
mass = 1
inertia = 1e-3
position = [0, 0]
angle = 0
spin = {0:.17g}
hold = ["angle"]
markers.O = [0, 0]
markers.P = ["50 mm", 0]
[body.planet]
mass = 0.2
inertia = 4e-5
position = ["50 mm", 0]
angle = 0
spin = {1:.17g}
markers.O = [0, 0]
[body.sun]
mass = 0.5
inertia = 2e-4
position = [0, 0]
angle = 0
spin = {2:.17g}
markers.O = [0, 0]
[joint.frame]
type = "revolute"
between = ["ground.O", "carrier.O"]
[joint.arm]
type = "revolute"
between = ["carrier.P", "planet.O"]
[joint.shaft]
type = "revolute"
between = ["ground.O", "sun.O"]
{3}{4}
[motor.drive]
joint = "frame"
speed = {0:.17g}
[force.load]
on = "sun.O"
torque = -5
)toml",
                                       kSpeed, planet, sun, mesh("outer", "[\"ground.O\", \"planet.O\"]", kRing, kPlanet, "internal"), mesh("inner", "[\"sun.O\", \"planet.O\"]", kSun, kPlanet, "external"));
  const Trajectory run = completed(parse_model(text, "planet.toml"));
  // Moments about the planet's and the sun's axes, with l = mu l: Fs r_s = T + l Fs;  Fr r_p = Fs r_p + l (Fs + Fr).
  const double l = kMu * kSliding, inner = 5 / (kSun - l), outer = inner * (kPlanet + l) / (kPlanet - l);
  EXPECT_NEAR(at_end(run, "joint.inner.friction_power"), l * inner * std::abs(planet - sun), 2e-3);
  EXPECT_NEAR(at_end(run, "joint.outer.friction_power"), l * outer * std::abs(planet), 2e-3);
  const double lost = at_end(run, "joint.inner.friction_power") + at_end(run, "joint.outer.friction_power");
  EXPECT_NEAR(at_end(run, "motor.drive.effort") * kSpeed, 5 * sun + lost, 2e-3 * 5 * sun);
}

TEST(TeethFrictionKeys, SayWhereTeethSlide) {
  try {
    Model model = parse_model("format = 1\n[body.a]\nmass = 1\ninertia = 1\nmarkers.O = [0, 0]\n[body.b]\nmass = 1\ninertia = 1\nmarkers.O = [0, 0]\n[joint.m]\ntype = \"gear\"\nbetween = [\"a.O\", \"b.O\"]\nradii = [1, 2]\nfriction = \"coulomb\"\n", "m.toml");
    FAIL() << "it was read";
  } catch (const InputError& error) {
    ASSERT_EQ(error.complaints().size(), 1U);
    EXPECT_EQ(error.complaints()[0].path, "joint.m.sliding_distance");
    EXPECT_NE(error.complaints()[0].suggestion.find("1.2 modules"), std::string::npos);
  }
}

}  // namespace
}  // namespace pintle

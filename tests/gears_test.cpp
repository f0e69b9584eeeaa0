// The effect of the pressure angle of teeth in gears and racks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;
using reference::mechanism;
using reference::value;

constexpr double kAngle = 20 * std::numbers::pi / 180;

// The line of centres is the world's x axis, and the rack stands to the left of its pinion.
void expect_teeth_push_apart(const Trajectory& run, std::size_t row, double accuracy) {
  for (const auto& [joint, body, side] : {std::tuple("mesh", "gear2", 1.0), std::tuple("rack", "carriage", -1.0)}) {
    const std::string p = std::string("joint.") + joint + ".", on = p + "on_" + body;
    const double tangential = std::abs(value(run, row, on + ".fy[world]")), radial = value(run, row, on + ".fx[world]");
    EXPECT_NEAR(radial, side * tangential * std::tan(kAngle), accuracy * tangential) << joint << " " << row;
    EXPECT_NEAR(value(run, row, p + "radial_force"), tangential * std::tan(kAngle), accuracy * tangential);
    EXPECT_NEAR(value(run, row, p + "normal_force"), std::hypot(tangential, radial), accuracy * tangential);
  }
}

// The bearings of the shafts carry the weights and the push of the teeth.
void expect_bearings_carry_it(const Trajectory& run, std::size_t row, double accuracy) {
  const auto on = [&](const char* joint, const char* body, const char* axis) { return value(run, row, std::string("joint.") + joint + ".on_" + body + ".f" + axis + "[world]"); };
  const double size = std::abs(on("rack", "gear2", "y"));
  for (const char* axis : {"x", "y"}) {
    const double g = axis[0] == 'y' ? 9.81 : 0;
    EXPECT_NEAR(on("O1", "gear1", axis) + on("mesh", "gear1", axis), 0.8 * g, accuracy * size) << row;
    EXPECT_NEAR(on("O2", "gear2", axis) + on("mesh", "gear2", axis) + on("rack", "gear2", axis), 1.9 * g, accuracy * size) << row;
  }
  EXPECT_NEAR(on("ways", "carriage", "x") + on("rack", "carriage", "x"), 0, accuracy * size) << row;
}

TEST(Gears, TeethPushApartByTheirPressureAngle) {
  const Model model = mechanism("gear_train");
  const Trajectory run = completed(model);
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    expect_teeth_push_apart(run, i, 1e-4);  // the rack tilts by some 1e-5 rad
    expect_bearings_carry_it(run, i, 2e-3);
  }
  Model plain = model;
  for (Joint& joint : plain.joints) joint.geometry.erase("pressure_angle");
  const Trajectory without = completed(plain);
  EXPECT_LT(without.column("joint.mesh.radial_force"), 0);
  EXPECT_NEAR(value(without, 200, "body.gear2.spin"), value(run, 200, "body.gear2.spin"), 1e-4);
  EXPECT_NEAR(value(without, 200, "joint.O1.on_gear1.fx[world]"), 0, 1e-3 * value(run, 200, "joint.mesh.radial_force"));
}

// The same forces from all equations and methods with compliant joints, and from those with ideal ones.
TEST(Gears, TeethPushApartInEveryFormulation) {
  for (const std::vector<std::string>& keys : {std::vector<std::string>{"equations=\"relative\""}, {"method=\"dopri5\""}, {"method=\"ode15s\""}, {"method=\"generalised_alpha\""}, {"equations=\"ideal\""},
                                               {"equations=\"penalty\""}, {"equations=\"augmented_lagrangian\""}}) {
    std::vector<std::string> overrides{"simulate.duration=\"40 ms\""};
    for (const std::string& key : keys) overrides.push_back("simulate." + key);
    const Trajectory run = completed(mechanism("gear_train", overrides));
    for (std::size_t i = 5; i < run.n_rows(); i += 5) {
      expect_teeth_push_apart(run, i, 1e-4);
      expect_bearings_carry_it(run, i, 5e-3);
    }
    if (testing::Test::HasFailure()) FAIL() << keys.front();
  }
}

// A sun of 40 mm turns a planet of 20 mm that rolls in a fixed ring of 80 mm, on a carrier of 60 mm. The sun pushes the planet outwards and the ring pushes it
// inwards; the carrier's pin carries the difference and the force that keeps the planet on its circle.
constexpr const char* kPlanetary = R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "0.2 s"
equations = "{}"
[defaults.joint]
stiffness = 1e9
damping = 1e4
[ground.markers]
O = [0, 0]
[body.sun]
mass = 1
inertia = 1e-3
position = [0, 0]
angle = 0
spin = 0
hold = ["angle"]
markers.O = [0, 0]
[body.planet]
mass = 0.5
inertia = 1e-4
position = [0.06, 0]
angle = 0
markers.P = [0, 0]
[body.carrier]
mass = 1
inertia = 5e-3
position = [0, 0]
angle = 0
markers.O = [0, 0]
markers.P = [0.06, 0]
[joint.S]
type = "revolute"
between = ["ground.O", "sun.O"]
[joint.C]
type = "revolute"
between = ["ground.O", "carrier.O"]
[joint.P]
type = "revolute"
between = ["carrier.P", "planet.P"]
[joint.sun]
type = "gear"
between = ["sun.O", "planet.P"]
radii = [0.04, 0.02]
pressure_angle = "{} deg"
[joint.ring]
type = "gear"
between = ["ground.O", "planet.P"]
radii = [0.08, 0.02]
mesh = "internal"
pressure_angle = "{} deg"
[motor.drive]
joint = "S"
torque = 4
[motor.load]
joint = "C"
torque = "-8 - 0.4*rate"
)toml";

TEST(Gears, ARingPushesItsPlanetInwards) {
  for (const char* equations : {"newtonian", "ideal"})
    for (const double degrees : {20.0, 40.0}) {
      const Trajectory run = completed(parse_model(fmt::format(fmt::runtime(kPlanetary), equations, degrees, degrees), "planetary.toml"));
      const double tangent = std::tan(degrees * std::numbers::pi / 180);
      for (const std::size_t row : {run.n_rows() / 2, run.n_rows() - 1}) {
        const double x = value(run, row, "body.planet.x"), y = value(run, row, "body.planet.y"), r = std::hypot(x, y), w = value(run, row, "body.carrier.spin");
        const auto along = [&](const std::string& joint, bool radial) {
          const double fx = value(run, row, "joint." + joint + ".on_planet.fx[world]"), fy = value(run, row, "joint." + joint + ".on_planet.fy[world]");
          return radial ? (fx * x + fy * y) / r : (fy * x - fx * y) / r;
        };
        const double sun = std::abs(along("sun", false)), ring = std::abs(along("ring", false)), size = 1e-3 * std::max(sun, ring);
        EXPECT_NEAR(along("sun", true), sun * tangent, size) << equations << " " << degrees;
        EXPECT_NEAR(along("ring", true), -ring * tangent, size) << equations << " " << degrees;
        EXPECT_NEAR(along("P", true), ring * tangent - sun * tangent - 0.5 * w * w * r, 3 * size) << equations << " " << degrees;
      }
    }
}

// A gear that floats between two others at a right angle: the push of the teeth changes the load that they carry, whatever the pressure angle.
TEST(Gears, AFloatingGearIsCarriedByItsTeeth) {
  const auto carried = [](const char* equations, double degrees) {
    const Trajectory run = completed(parse_model(fmt::format(fmt::runtime(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "20 ms"
equations = "{}"
[defaults.joint]
stiffness = 1e9
damping = 1e4
[ground.markers]
O = [0, 0]
Q = [0.06, 0.06]
[body.a]
mass = 1
inertia = 1e-3
position = [0, 0]
angle = 0
spin = 0
hold = ["angle"]
markers.O = [0, 0]
[body.c]
mass = 1
inertia = 1e-3
position = [0.06, 0.06]
angle = 0
spin = 0
markers.O = [0, 0]
[body.b]
mass = 1
inertia = 1e-3
position = [0.06, 0]
angle = 0
markers.O = [0, 0]
[joint.A]
type = "revolute"
between = ["ground.O", "a.O"]
[joint.C]
type = "revolute"
between = ["ground.Q", "c.O"]
[joint.ab]
type = "gear"
between = ["a.O", "b.O"]
radii = [0.03, 0.03]
pressure_angle = "{} deg"
[joint.bc]
type = "gear"
between = ["b.O", "c.O"]
radii = [0.03, 0.03]
pressure_angle = "{} deg"
[spring.hold]
between = ["ground.O", "b.O"]
stiffness = 1e5
[spring.hold2]
between = ["ground.Q", "b.O"]
stiffness = 1e5
[motor.drive]
joint = "A"
torque = 4
)toml"),
                                                                 equations, degrees, degrees),
                                                     "floating.toml"));
    return value(run, run.n_rows() / 2, "joint.ab.normal_force");  // the ringing of the start is over
  };
  for (const double degrees : {20.0, 40.0, 44.0}) EXPECT_NEAR(carried("ideal", degrees), carried("newtonian", degrees), 3e-4 * carried("ideal", degrees)) << degrees;
}

TEST(Gears, TeethWithPlayPushApartToo) {
  const Trajectory run = completed(mechanism("gear_train", {"--law joint.mesh=backlash,backlash=0.1 mm,contact_stiffness=2.8e8,restitution=0.5", "simulate.duration=\"0.1 s\""}));
  double largest = 0;
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const double tangential = std::abs(value(run, i, "joint.mesh.on_gear2.fy[world]")), radial = value(run, i, "joint.mesh.on_gear2.fx[world]");
    EXPECT_NEAR(radial, tangential * std::tan(kAngle), 1e-4 * tangential + 1e-9) << i;
    largest = std::max(largest, radial);
  }
  EXPECT_GT(largest, 30);
}

TEST(Gears, RefuseAPressureAngleOfMoreThan45Degrees) {
  try {
    mechanism("gear_train", {"joint.mesh.pressure_angle=\"50 deg\""});
    ADD_FAILURE() << "it was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("0.8727 rad is more than 45 deg"), std::string::npos) << error.what();
  }
}

TEST(Gears, ANoteSaysWhenTheyDoNotTouch) {
  const auto notes = [](const std::vector<std::string>& changes) {
    Model model = reference::mechanism("gear_train", changes);
    model.simulate.duration = 1e-4;
    std::string all;
    for (const std::string& note : simulate(model).notes) all += note + '\n';
    return all;
  };
  EXPECT_EQ(notes({}).find("pitch circles"), std::string::npos);
  EXPECT_NE(notes({"joint.mesh.radii=[\"15 mm\", \"r2\"]"}).find("joint mesh: its pitch circles do not touch, they are apart by 0.005 m"), std::string::npos);
  EXPECT_NE(notes({"joint.mesh.radii=[\"25 mm\", \"r2\"]"}).find("they overlap by 0.005 m"), std::string::npos);
}

}  // namespace
}  // namespace pintle

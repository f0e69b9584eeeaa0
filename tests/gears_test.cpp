// What the pressure angle of teeth does in gears and racks.
#include <gtest/gtest.h>

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

// What the bearings of the shafts add to the weights is what the teeth push with.
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

// The same forces from all equations and methods that have the joints as they are, and from those that have ideal ones.
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

TEST(Gears, RefuseAPressureAngleOfMoreThan45Degrees) {
  try {
    mechanism("gear_train", {"joint.mesh.pressure_angle=\"50 deg\""});
    ADD_FAILURE() << "it was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("0.8727 rad is more than 45 deg"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pintle

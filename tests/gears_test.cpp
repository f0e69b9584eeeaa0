// What the pressure angle of teeth adds to the results of gears and racks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;
using reference::mechanism;
using reference::value;

// The tooth force lies along the common tangent; that on the flank is at 20 deg to it.
TEST(Gears, TeethPushApartByTheirPressureAngle) {
  const Trajectory run = completed(mechanism("gear_train"));
  const double angle = 20 * std::numbers::pi / 180;
  for (const auto& [joint, body] : {std::pair("mesh", "gear2"), std::pair("rack", "carriage")})
    for (std::size_t i = 0; i < run.n_rows(); ++i) {
      const std::string p = std::string("joint.") + joint + ".", on = p + "on_" + body;
      const double tangential = std::hypot(value(run, i, on + ".fx[world]"), value(run, i, on + ".fy[world]"));
      EXPECT_NEAR(value(run, i, p + "radial_force"), tangential * std::tan(angle), 1e-9 * tangential);
      EXPECT_NEAR(value(run, i, p + "normal_force"), std::hypot(tangential, value(run, i, p + "radial_force")), 1e-9 * tangential);
    }
  Model plain = mechanism("gear_train");
  for (Joint& joint : plain.joints) joint.geometry.erase("pressure_angle");
  const Trajectory without = completed(plain);
  EXPECT_LT(without.column("joint.mesh.radial_force"), 0);
  EXPECT_EQ(value(without, 200, "body.gear2.spin"), value(run, 200, "body.gear2.spin"));  // it acts on nothing
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

// A published strut on its tyre, as three models of one mechanism: with a slider, with a pin in a slot in its place, with a rod in place of the arm.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::Table;
using reference::value;

constexpr const char* kArm = R"toml(
[body.arm]
mass = 2
inertia = 0.5
position = [{}, {}]
angle = {}
velocity = [0, 0]
spin = 0
markers.A = [0.225, 0]
markers.Q = [-0.225, 0]
[joint.A]
type = "revolute"
between = ["arm.A", "wheel.A"]
[joint.Q]
type = "revolute"
between = ["ground.Q", "arm.Q"]
)toml";

constexpr const char* kUpper = R"toml(
[body.upper]
mass = 0.5
inertia = 0.2
position = [{}, {}]
angle = {}
velocity = [0, 0]
spin = 0
markers.O = [-0.15, 0]
markers.axis = {{ x = 0, y = 0, axis = 0 }}
[joint.O]
type = "revolute"
between = ["ground.O", "upper.O"]
[joint.strut]
type = "prismatic"
between = ["upper.axis", "wheel.strut"]
)toml";

constexpr const char* kSlot = R"toml(
[joint.strut]
type = "slot"
between = ["wheel.strut", "ground.O"]
)toml";

constexpr const char* kRod = R"toml(
[joint.rod]
type = "rod"
between = ["ground.Q", "wheel.A"]
length = 0.45
)toml";

// The tyre's force begins where the wheel's centre is below 0.3 m, with the jump of its damper. The strut's axis is (0.47, -0.88) in the wheel's axes.
constexpr const char* kWheel = R"toml(
format = 1
gravity = [0, -9.81]
name = "MacPherson strut"
[simulate]
duration = "0.6 s"
output_step = "20 ms"
[ground.markers]
Q = [0.12, 0.29]
O = [0.41, 0.83]
[body.wheel]
mass = 20
inertia = 2.5
position = [{}, {}]
angle = {}
velocity = [0, 0]
spin = 0
markers.A = [0, -0.07]
markers.B = [-0.17, 0.25]
markers.C = [0.11, -0.02]
markers.strut = {{ x = -0.17, y = 0.25, axis = {} }}
[spring.s]
between = ["ground.O", "wheel.B"]
stiffness = 20000
damping = 1100
free_length = 0.34
[force.tyre]
on = "wheel.C"
force = [0, "if(wheel.y < 0.3 m, -1e5 N/m*(wheel.y - 0.3 m) - 1e3 N*s/m*wheel.vy, 0)"]
)toml";

// Model MP_A, MP_B or MP_C.
Model strut(char which) {
  const Table table = reference::read_table(fmt::format("macpherson_{}", which));
  const auto start = [&table](const char* column) { return table.at(0, column); };
  std::string text = fmt::format(kWheel, start("x1"), start("y1"), start("angle1"), std::atan2(-0.88, 0.47));
  text += which == 'c' ? kRod : fmt::format(kArm, start("x2"), start("y2"), start("angle2"));
  text += which == 'a' ? fmt::format(kUpper, start("x3"), start("y3"), start("angle3")) : kSlot;
  return parse_model(text, "strut.toml");
}

struct Column {
  std::string run, table;
};
using Columns = std::vector<Column>;

Columns bodies_of(char which, bool velocities) {
  const std::array<const char*, 3> names{"wheel", "arm", "upper"}, places{"x", "y", "angle"}, speeds{"vx", "vy", "spin"};
  Columns all;
  for (int body = 0; body < 3 - (which - 'a'); ++body)
    for (const char* column : velocities ? speeds : places) all.push_back({fmt::format("body.{}.{}", names[body], column), fmt::format("{}{}", column, body + 1)});
  return all;
}

Columns forces_of(char which) {
  Columns all;
  const auto append = [&all](const std::string& joint, const std::string& force) {
    for (const char axis : {'x', 'y'}) all.push_back({fmt::format("joint.{}.f{}[world]", joint, axis), force + axis});
  };
  append("A.on_wheel", "F12");
  append("Q.on_arm", "F02");
  if (which == 'b') append("strut.on_ground", "F10");
  if (which == 'b') return all;
  append("O.on_upper", "F03");
  append("strut.on_wheel", "F31");
  all.push_back({"joint.strut.on_wheel.m[world]", "M31"});
  return all;
}

// Largest difference of the columns from the table's, over all its rows.
double largest_error(const Trajectory& run, const Table& table, const Columns& columns) {
  double largest = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const auto& [of_run, of_table] : columns)
      largest = std::max(largest, std::abs(value(run, reference::row_at(run, table.at(i, "t")), of_run) - table.at(i, of_table)));
  return largest;
}

// The tables have 10 digits: their two computations agree to 1e-11 m and rad and to 5e-10 m/s and rad/s; forces reach 1050 N.
TEST(ReferenceMacPherson, IdealJointsMoveAndPullAsTheTablesSay) {
  for (const char which : {'a', 'b', 'c'}) {
    Model model = strut(which);
    model.simulate.equations = Equations::kIdeal;
    model.simulate.tolerance = 1e-10;
    const Trajectory run = reference::completed(model);
    const Table table = reference::read_table(fmt::format("macpherson_{}", which));
    ASSERT_EQ(run.n_rows(), table.rows.size());
    EXPECT_LT(largest_error(run, table, bodies_of(which, false)), 5e-11) << which;
    EXPECT_LT(largest_error(run, table, bodies_of(which, true)), 2e-9) << which;
    if (which != 'c') { EXPECT_LT(largest_error(run, table, forces_of(which)), 2e-7) << which; }
  }
}

using Vector = Eigen::Vector2d;
Vector turned(const Vector& v) { return {-v[1], v[0]}; }

// Model MP_C, of one body, whose forces are not in the published table: the force of the rod on the wheel, at A, and of the ground's pin, at O, from a row of
// the table and the Newton-Euler equations with the accelerations of both constraints.
struct RodAndPin {
  Vector rod, pin;

  RodAndPin(const Table& table, std::size_t row) {
    const double angle = table.at(row, "angle1"), spin = table.at(row, "spin1"), c = std::cos(angle), s = std::sin(angle);
    const Vector centre(table.at(row, "x1"), table.at(row, "y1")), velocity(table.at(row, "vx1"), table.at(row, "vy1")), Q(0.12, 0.29), O(0.41, 0.83);
    const auto arm = [c, s](double x, double y) { return Vector(c * x - s * y, s * x + c * y); };
    const auto speed = [&](const Vector& r) -> Vector { return velocity + spin * turned(r); };
    const auto moment = [](const Vector& r, const Vector& f) { return r[0] * f[1] - r[1] * f[0]; };
    const Vector rA = arm(0, -0.07), rB = arm(-0.17, 0.25), rC = arm(0.11, -0.02), rO = O - centre;
    const Vector along = (centre + rA - Q).normalized(), across = turned(arm(0.47, -0.88)).normalized(), stretched = centre + rB - O;
    const double tension = 20000 * (stretched.norm() - 0.34) + 1100 * stretched.normalized().dot(speed(rB));
    const Vector spring = -tension * stretched.normalized(), tyre(0, centre[1] < 0.3 ? -1e5 * (centre[1] - 0.3) - 1e3 * velocity[1] : 0);
    // Unknown: the wheel's acceleration and angular acceleration, the thrust of the rod, the force of the pin.
    Eigen::Matrix<double, 5, 5> matrix = Eigen::Matrix<double, 5, 5>::Zero();
    Eigen::Matrix<double, 5, 1> right;
    matrix.diagonal().head<3>() << 20, 20, 2.5;
    matrix.block<2, 1>(0, 3) = -along;
    matrix.block<2, 1>(0, 4) = -across;
    matrix(2, 3) = -moment(rA, along);
    matrix(2, 4) = -moment(rO, across);
    matrix.block<2, 3>(3, 0) = -matrix.block<3, 2>(0, 3).transpose();
    const Vector vA = speed(rA);
    right << spring + tyre + Vector(0, -20 * 9.81), moment(rB, spring) + moment(rC, tyre), spin * spin * along.dot(rA) - std::pow(turned(along).dot(vA), 2) / 0.45,
        spin * spin * across.dot(rO) + 2 * spin * across.dot(turned(speed(rO)));
    const Eigen::Matrix<double, 5, 1> solution = matrix.partialPivLu().solve(right);
    rod = solution[3] * along;
    pin = solution[4] * across;
  }
};

// The last digit of the table's speeds, 5e-10 m/s, gives a force of 1e-6 N in the dampers of spring and tyre.
TEST(ReferenceMacPherson, AMasslessArmPullsAsTheAccelerationsSay) {
  Model model = strut('c');
  model.simulate.equations = Equations::kIdeal;
  model.simulate.tolerance = 1e-10;
  const Trajectory run = reference::completed(model);
  const Table table = reference::read_table("macpherson_c");
  double peak = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const RodAndPin expected(table, i);
    peak = std::max(peak, expected.rod.norm());
    EXPECT_LT(reference::force_error(run, i, "rod.on_wheel", expected.rod[0], expected.rod[1]), 1e-6) << i;
    EXPECT_LT(reference::force_error(run, i, "strut.on_ground", -expected.pin[0], -expected.pin[1]), 1e-6) << i;
  }
  EXPECT_GT(peak, 500);
}

// Compliant joints are off by the load over their stiffness, and a tenth of the compliance leaves a tenth: positions, speeds and forces, also after the tyre's
// jump, as soon as its ringing is over (the first row after it is 18 ms later).
TEST(ReferenceMacPherson, StiffJointsTendToIdealOnesAsTheirCompliance) {
  for (const char which : {'a', 'b', 'c'}) {
    const Table table = reference::read_table(fmt::format("macpherson_{}", which));
    double place = 0, speed = 0, force = 0;
    for (const double stiffness : {1e9, 1e10}) {
      Model model = strut(which);
      model.simulate.tolerance = 1e-6;
      const double damping = 3e5 * std::sqrt(stiffness / 1e10);
      reference::set_joints(model, stiffness, damping);
      for (Joint& joint : model.joints)
        if (joint.type == "prismatic") {
          joint.law.values["angular_stiffness"] = {0.1 * stiffness};
          joint.law.values["angular_damping"] = {0.1 * damping};
        }
      const Trajectory run = reference::completed(model);
      const double of_place = largest_error(run, table, bodies_of(which, false)), of_speed = largest_error(run, table, bodies_of(which, true));
      EXPECT_LT(of_place, 5e3 / stiffness) << which;
      EXPECT_LT(of_speed, 2.5e5 / stiffness) << which;
      if (stiffness > 1e9) {
        EXPECT_NEAR(place / of_place, 10, 0.3) << which;
        EXPECT_NEAR(speed / of_speed, 10, 0.3) << which;
      }
      place = of_place;
      speed = of_speed;
      if (which == 'c') continue;
      const double of_force = largest_error(run, table, forces_of(which));
      EXPECT_LT(of_force, 1.5e8 / stiffness) << which;
      if (stiffness > 1e9) { EXPECT_NEAR(force / of_force, 10, 1) << which; }
      force = of_force;
    }
  }
}

}  // namespace
}  // namespace pintle

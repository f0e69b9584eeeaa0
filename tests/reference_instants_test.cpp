// Joint forces at one instant, from textbooks: a motor's moment and the resulting forces of the pins.
#include <gtest/gtest.h>

#include "base/constants.h"
#include "base/expression/expression_parser.h"
#include "system/sample_systems_for_tests.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

struct AtStart {
  const Assembly start;
  std::vector<Planar::Motion> m;

  explicit AtStart(const Model& model) : start(start_of_run(model)) { start.system.motions(start.state.q, start.state.v, m); }
  /// Force on the second body, world axes.
  Planar::Point force(int j) const { return start.system.pose(start.system.joints[j].at, m).world_force(start.state.force[j]); }
};

void expect_force(const AtStart& at, int j, double x, double y, double tolerance) {
  EXPECT_LT((at.force(j) - Planar::Point(x, y)).norm(), tolerance) << at.start.system.joints[j].name << ": " << at.force(j).transpose();
}

Motor torque(const std::string& joint, double moment) {
  return sample::motor("drive", joint, MotorKind::kEffort, Expression::constant(moment));
}

// R. L. Norton, Design of Machinery, example 11-3, in SI units: crank at 60 deg with 25 rad/s and -40 rad/s^2. Figures from the nine Newton-Euler equations of
// the ideal linkage; the moment gives the acceleration.
TEST(ReferenceInstants, NortonFourBar) {
  const double inch = 0.0254, k = 1e11, c = 1e5, theta2 = 60 * kDegree, omega = 25, a = 5 * inch, b = 15 * inch;
  const double theta3 = 20.917224866506565 * kDegree, theta4 = 104.40972127476181 * kDegree;
  const auto polar = [](double r, double degrees) { return Vec2{r * std::cos(degrees * kDegree), r * std::sin(degrees * kDegree)}; };
  Model model;
  model.gravity = {0, 0};
  model.simulate.duration = 0.1;
  model.ground = {{"O2", {0, 0}, 0}, {"O4", {19 * inch, 0}, 0}};
  const Vec2 g2 = polar(3 * inch, 30), g3 = polar(9 * inch, 45), push = polar(3 * inch, 100);
  model.bodies = {
      sample::body("crank", 0.7005073409859055, 0.04519393161104668, {{"O2", {-g2[0], -g2[1]}, 0}, {"A", {a - g2[0], -g2[1]}, 0}}),
      sample::body("coupler", 3.5025367049295273, 0.16947724354142502, {{"A", {-g3[0], -g3[1]}, 0}, {"B", {b - g3[0], -g3[1]}, 0}, {"P", push, 0}}),
      sample::body("rocker", 2.6269025286971455, 0.09038786322209336, {{"O4", {-5 * inch, 0}, 0}, {"B", {5 * inch, 0}, 0}})};
  const auto place = [](Body& body, double x, double y, const Vec2& centre, double angle) {
    const double cos = std::cos(angle), sin = std::sin(angle);
    sample::put_at(body, x + cos * centre[0] - sin * centre[1], y + sin * centre[0] + cos * centre[1], angle);
  };
  place(model.bodies[0], 0, 0, g2, theta2);
  place(model.bodies[1], a * std::cos(theta2), a * std::sin(theta2), g3, theta3);
  place(model.bodies[2], 19 * inch, 0, {5 * inch, 0}, theta4);
  model.bodies[0].spin = omega;
  model.joints = {sample::joint("O2", "revolute", {"ground", "O2"}, {"crank", "O2"}, k, c),
                  sample::joint("A", "revolute", {"crank", "A"}, {"coupler", "A"}, k, c),
                  sample::joint("B", "revolute", {"coupler", "B"}, {"rocker", "B"}, k, c),
                  sample::joint("O4", "revolute", {"ground", "O4"}, {"rocker", "O4"}, k, c)};
  AppliedForce force, moment;
  force.name = "P";
  force.on = {"coupler", "P"};
  const Vec2 p = polar(355.85772922084, 330);
  force.force = {Expression::constant(p[0]), Expression::constant(p[1])};
  moment.name = "T4";
  moment.on = {"rocker", "O4"};
  moment.torque = Expression::constant(13.558179483314001);
  model.forces = {force, moment};
  model.motors = {torque("O2", 27.48101259725779)};
  const AtStart at(model);
  EXPECT_NEAR(at.start.state.v[0][2], omega, 1e-5);
  EXPECT_NEAR(at.start.state.v[1][2], -5.869354068454683, 1e-5);
  EXPECT_NEAR(at.start.state.v[2][2], 7.931634292031013, 1e-5);
  EXPECT_NEAR(at.start.state.a[0][2], -40, 1e-2);
  EXPECT_NEAR(at.start.state.a[1][2], 120.8968454372914, 1e-2);
  EXPECT_NEAR(at.start.state.a[2][2], 276.28909907606584, 1e-2);
  expect_force(at, 0, -523.3317925899651, -479.69445218665345, 5e-3);
  expect_force(at, 1, -525.4669389652903, -446.3327900721997, 5e-3);  // of the crank on the coupler
  expect_force(at, 2, 5.942015427557443, -388.9158665153362, 5e-3);   // of the coupler on the rocker
  expect_force(at, 3, -89.99394856829947, 345.6499887799212, 5e-3);
}

// D. B. Marghitu, Mechanisms and Robots Analysis with MATLAB, chapter 4: slider-crank at 45 deg, 1 rad/s, 100 N on the slider, whose moment of inertia is
// negligible. Closed-form Newton-Euler.
TEST(ReferenceInstants, MarghituSliderCrank) {
  const double k = 1e11, c = 1e5, half = std::numbers::sqrt2 / 4;
  Model model;
  model.gravity = {0, -10};
  model.simulate.duration = 1;
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {sample::body("crank", 1, 0.0833416666666667, {{"A", {-0.5, 0}, 0}, {"B", {0.5, 0}, 0}}),
                  sample::body("rod", 1, 0.0833416666666667, {{"B", {-0.5, 0}, 0}, {"C", {0.5, 0}, 0}}),
                  sample::body("slider", 1, 1.66666666666667e-05, {{"C", {0, 0}, 0}})};
  sample::put_at(model.bodies[0], half, half, 45 * kDegree);
  sample::put_at(model.bodies[1], 3 * half, half, -45 * kDegree);
  sample::put_at(model.bodies[2], 4 * half, 0, 0);
  model.bodies[0].spin = 1;
  model.joints = {sample::joint("A", "revolute", {"ground", "O"}, {"crank", "A"}, k, c),
                  sample::joint("B", "revolute", {"crank", "B"}, {"rod", "B"}, k, c),
                  sample::joint("C", "revolute", {"rod", "C"}, {"slider", "C"}, k, c),
                  sample::joint("guide", "prismatic", {"ground", "O"}, {"slider", "C"}, k, c)};
  AppliedForce load;
  load.name = "load";
  load.on = {"slider", "C"};
  load.force = {Expression::constant(100), Expression::constant(0)};
  model.forces = {load};
  model.motors = {torque("A", 151.49242404917499)};
  const AtStart at(model);
  EXPECT_NEAR(at.start.state.a[0][2], 0, 1e-2);
  expect_force(at, 0, -102.82842712474618, 116.41421356237309, 2e-3);
  expect_force(at, 1, -102.47487373415292, 106.76776695296637, 2e-3);
  expect_force(at, 2, -101.41421356237309, 97.12132034355965, 2e-3);
  expect_force(at, 3, 0, -87.12132034355965, 2e-3);
}

}  // namespace
}  // namespace pintle

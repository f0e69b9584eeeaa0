// Small mechanisms, defined in code, for the tests of the checks.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/constants.h"
#include "pintle/model.h"

namespace pintle::checked {

inline Body bar(const std::string& name, double mass, double inertia, Vec2 centre, double angle,
                std::vector<Marker> markers) {
  Body body;
  body.name = name;
  body.mass = mass;
  body.inertia = inertia;
  body.position = centre;
  body.angle = angle;
  body.markers = std::move(markers);
  return body;
}

inline Joint joint(const std::string& name, const std::string& type, MarkerRef first, MarkerRef second, double k = 1e8,
                   double c = 3000) {
  Joint j;
  j.name = name;
  j.type = type;
  j.first = std::move(first);
  j.second = std::move(second);
  j.law.values["stiffness"] = {k};
  j.law.values["damping"] = {c};
  return j;
}

/// A uniform bar of 1 kg and 1 m on a pin, stretched out along y; gravity along x.
inline Model pendulum() {
  Model model;
  model.gravity = {9.81, 0};
  model.ground = {{"pin", {0, 0}, 0}};
  model.bodies = {bar("rod", 1, 1.0 / 12, {0, 0.5}, 90 * kDegree, {{"pin", {-0.5, 0}, 0}})};
  model.joints = {joint("pin", "revolute", {"ground", "pin"}, {"rod", "pin"}, 2e8, 3500)};
  return model;
}

/// Bars in a chain from O2 to O4 on the ground: crank at `angle`, coupler, follower.
inline Model four_bar(double crank, double coupler, double follower, double ground, double angle) {
  const double ax = crank * std::cos(angle), ay = crank * std::sin(angle);
  const double dx = ground - ax, dy = -ay, d = std::hypot(dx, dy);
  const double along = std::min(coupler, (d * d + coupler * coupler - follower * follower) / (2 * d));
  const double off = std::sqrt(std::max(0.0, coupler * coupler - along * along));
  const double bx = ax + (along * dx - off * dy) / d, by = ay + (along * dy + off * dx) / d;
  Model model;
  model.gravity = {0, 0};
  model.ground = {{"O2", {0, 0}, 0}, {"O4", {ground, 0}, 0}};
  model.bodies = {bar("crank", 1, 1e5, {ax / 2, ay / 2}, angle, {{"O2", {-crank / 2, 0}, 0}, {"A", {crank / 2, 0}, 0}}),
                  bar("coupler", 4, 5.333, {(ax + bx) / 2, (ay + by) / 2}, std::atan2(by - ay, bx - ax),
                      {{"A", {-coupler / 2, 0}, 0}, {"B", {coupler / 2, 0}, 0}}),
                  bar("follower", 4, 5.333, {(ground + bx) / 2, by / 2}, std::atan2(by, bx - ground),
                      {{"O4", {-follower / 2, 0}, 0}, {"B", {follower / 2, 0}, 0}})};
  model.joints = {joint("O2", "revolute", {"ground", "O2"}, {"crank", "O2"}),
                  joint("A", "revolute", {"crank", "A"}, {"coupler", "A"}),
                  joint("B", "revolute", {"coupler", "B"}, {"follower", "B"}),
                  joint("O4", "revolute", {"ground", "O4"}, {"follower", "O4"})};
  return model;
}

/// A coupler on three equal parallel cranks of 0.2 m, 0.4 m apart, at 60 deg; the middle one is `error` too long.
inline Model five_bar_parallelogram(double error) {
  const double r = 0.2, pitch = 0.4, x = r * std::cos(60 * kDegree), y = r * std::sin(60 * kDegree);
  Model model;
  model.gravity = {0, 0};
  model.bodies = {
      bar("coupler", 6, 0.32, {x, y}, 0, {{"A1", {-pitch, 0}, 0}, {"A2", {0, 0}, 0}, {"A3", {pitch, 0}, 0}})};
  for (int i = 1; i <= 3; ++i) {
    const std::string n = std::to_string(i);
    const double at = (i - 2) * pitch;
    model.ground.push_back({"O" + n, {at, 0}, 0});
    model.bodies.push_back(bar("crank" + n, 2, 2 * r * r / 12, {at + x / 2, y / 2}, 60 * kDegree,
                               {{"O", {-r / 2, 0}, 0}, {"A", {r / 2 + (i == 2 ? error : 0), 0}, 0}}));
    model.joints.push_back(joint("O" + n, "revolute", {"ground", "O" + n}, {"crank" + n, "O"}, 5e7));
    model.joints.push_back(joint("A" + n, "revolute", {"crank" + n, "A"}, {"coupler", "A" + n}, 5e7));
  }
  Motor drive;
  drive.name = "drive";
  drive.joint = "O1";
  drive.kind = MotorKind::kSpeed;
  drive.law = Expression::constant(6);
  model.motors = {drive};
  return model;
}

/// Two gears of 20 and 60 mm; a pinion of 25 mm on the second lifts a vertical rack on its left.
inline Model gear_train() {
  const double centre = 0.08, ways = centre - 0.025;
  Model model;
  model.ground = {{"O1", {0, 0}, 0}, {"O2", {centre, 0}, 0}, {"ways", {ways, 0}, 90 * kDegree}};
  model.bodies = {bar("gear1", 0.8, 2.4e-4, {0, 0}, 0, {{"O", {0, 0}, 0}}),
                  bar("gear2", 1.9, 3.25e-3, {centre, 0}, 0, {{"O", {0, 0}, 0}}),
                  bar("carriage", 20, 0.5, {ways, 0}, 0, {{"rack", {0, 0}, 90 * kDegree}})};
  Joint mesh = joint("mesh", "gear", {"gear1", "O"}, {"gear2", "O"}, 2.8e8, 1000);
  mesh.geometry = {{"radius_first", 0.02}, {"radius_second", 0.06}, {"internal", 0}};
  Joint rack = joint("rack", "rack", {"gear2", "O"}, {"carriage", "rack"}, 2.8e8, 1000);
  rack.geometry = {{"radius", 0.025}};
  model.joints = {joint("O1", "revolute", {"ground", "O1"}, {"gear1", "O"}),
                  joint("O2", "revolute", {"ground", "O2"}, {"gear2", "O"}),
                  joint("ways", "prismatic", {"ground", "ways"}, {"carriage", "rack"}), mesh, rack};
  return model;
}

}  // namespace pintle::checked

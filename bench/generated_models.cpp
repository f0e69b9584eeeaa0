#include "bench/generated_models.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace pintle::bench {
namespace {

constexpr double kStiffness = 1e8, kDamping = 3e3;  // of every pin [N/m, N*s/m]

// A uniform slender bar of 1 m and 1 kg with a marker at each end.
Body bar(std::string name, Vec2 position, double angle, Vec2 velocity, double spin, std::pair<const char*, const char*> ends) {
  Body body;
  body.name = std::move(name);
  body.mass = 1;
  body.inertia = 1.0 / 12;
  body.position = position;
  body.angle = angle;
  body.velocity = velocity;
  body.spin = spin;
  body.markers = {{ends.first, {-0.5, 0}, 0}, {ends.second, {0.5, 0}, 0}};
  return body;
}

Joint pin(std::string name, MarkerRef first, MarkerRef second) {
  Joint joint;
  joint.name = std::move(name);
  joint.type = "revolute";
  joint.first = std::move(first);
  joint.second = std::move(second);
  joint.law.values = {{"stiffness", {kStiffness}}, {"damping", {kDamping}}};
  return joint;
}

}  // namespace

Model chain(int n) {
  Model model;
  model.simulate.duration = 10;
  model.ground = {{"P", {0, 0}, 0}};
  for (int i = 0; i < n; ++i) {
    const MarkerRef before = i == 0 ? MarkerRef{"ground", "P"} : MarkerRef{model.bodies.back().name, "right"};
    model.bodies.push_back(bar(fmt::format("link{}", i), {i + 0.5, 0}, 0, {0, 0}, 0, {"left", "right"}));
    model.joints.push_back(pin(fmt::format("pin{}", i), before, {model.bodies.back().name, "left"}));
  }
  return model;
}

Model n_four_bar(int n) {
  Model model;
  model.name = fmt::format("N-four-bar, N = {}", n);
  model.gravity = {0, -9.81};
  model.simulate.duration = 10;
  for (int i = 0; i <= n; ++i) {
    model.ground.push_back({fmt::format("A{}", i), {static_cast<double>(i), 0}, 0});
    model.bodies.push_back(bar(fmt::format("crank{}", i), {static_cast<double>(i), 0.5}, std::numbers::pi / 2, {0.5, 0}, -1, {"A", "B"}));
    model.joints.push_back(pin(fmt::format("A{}", i), {"ground", fmt::format("A{}", i)}, {fmt::format("crank{}", i), "A"}));
  }
  for (int i = 0; i < n; ++i) {
    const std::string coupler = fmt::format("coupler{}", i);
    model.bodies.push_back(bar(coupler, {i + 0.5, 1}, 0, {1, 0}, 0, {"left", "right"}));
    model.joints.push_back(pin(fmt::format("B{}right", i), {fmt::format("crank{}", i), "B"}, {coupler, "left"}));
    model.joints.push_back(pin(fmt::format("B{}left", i + 1), {fmt::format("crank{}", i + 1), "B"}, {coupler, "right"}));
  }
  return model;
}

// Bars a lean to the right, bars b to the left, at the angle to the axis that falls with the rate `turning`.
Model scissor_chain(int n) {
  constexpr double kAngle = 75 * std::numbers::pi / 180, kTurning = -1.5;  // [rad, rad/s]
  const double c = std::cos(kAngle), s = std::sin(kAngle);
  Model model;
  model.name = fmt::format("Scissor chain of {} bars", 2 * n);
  model.gravity = {0, 0};
  model.simulate.duration = 0.7;
  model.ground = {{"O", {0, 0}, 0}, {"rail", {0, 0}, std::numbers::pi / 2}};
  Body foot = bar("foot", {0, s}, 0, {0, c * kTurning}, 0, {"left", "right"});
  foot.markers = {{"pin", {0, 0}, 0}, {"rail", {0, 0}, std::numbers::pi / 2}};
  model.bodies.push_back(foot);
  Joint rail = pin("rail", {"ground", "rail"}, {"foot", "rail"});
  rail.type = "prismatic";
  rail.law.values["angular_stiffness"] = {1e6};
  rail.law.values["angular_damping"] = {100};
  model.joints = {rail, pin("O", {"ground", "O"}, {"a0", "left"}), pin("foot", {"foot", "pin"}, {"b0", "left"})};
  for (int i = 0; i < n; ++i) {
    const Vec2 centre{(i + 0.5) * c, s / 2}, velocity{-(i + 0.5) * s * kTurning, c / 2 * kTurning};
    for (const double side : {1.0, -1.0}) {
      Body crossed = bar(fmt::format("{}{}", side > 0 ? 'a' : 'b', i), centre, side * kAngle, velocity, side * kTurning, {"left", "right"});
      crossed.markers.push_back({"middle", {0, 0}, 0});
      model.bodies.push_back(crossed);
    }
    model.joints.push_back(pin(fmt::format("middle{}", i), {fmt::format("a{}", i), "middle"}, {fmt::format("b{}", i), "middle"}));
    if (i == 0) continue;
    model.joints.push_back(pin(fmt::format("low{}", i), {fmt::format("b{}", i - 1), "right"}, {fmt::format("a{}", i), "left"}));
    model.joints.push_back(pin(fmt::format("high{}", i), {fmt::format("a{}", i - 1), "right"}, {fmt::format("b{}", i), "left"}));
  }
  return model;
}

}  // namespace pintle::bench

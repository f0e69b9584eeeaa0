#include "bench/generated_models.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "tests/large_models.h"

namespace pintle::bench {

// Bars a lean to the right, bars b to the left, at the same angle to the axis, which decreases at the rate `turning`.
Model scissor_chain(int n) {
  constexpr double kAngle = 75 * std::numbers::pi / 180, kTurning = -1.5;  // [rad, rad/s]
  const double c = std::cos(kAngle), s = std::sin(kAngle);
  sample::LargeModel out(fmt::format("Scissor chain of {} bars", 2 * n));
  const auto name = [](char what, int i) { return fmt::format("{}{}", what, i); };
  out.add_ground("O", 0, 0);
  out.add_ground("rail", 0, 0, std::numbers::pi / 2);
  Body& foot = out.add_bar("foot", 0, s, 0);
  foot.velocity = Vec2{0, c * kTurning};
  foot.spin = 0;
  foot.markers = {{"pin", {0, 0}, 0}, {"rail", {0, 0}, std::numbers::pi / 2}};
  Joint& rail = out.add_pin("rail", {"ground", "rail"}, {"foot", "rail"});
  rail.type = "prismatic";
  rail.law.values["angular_stiffness"] = {1e6};
  rail.law.values["angular_damping"] = {100};
  out.add_pin("O", {"ground", "O"}, {"a0", "A"});
  out.add_pin("foot", {"foot", "pin"}, {"b0", "A"});
  for (int i = 0; i < n; ++i) {
    for (const double side : {1.0, -1.0}) {
      Body& crossed = out.add_bar(name(side > 0 ? 'a' : 'b', i), (i + 0.5) * c, s / 2, side * kAngle);
      crossed.velocity = Vec2{-(i + 0.5) * s * kTurning, c / 2 * kTurning};
      crossed.spin = side * kTurning;
      crossed.markers.push_back({"middle", {0, 0}, 0});
    }
    out.add_pin(fmt::format("middle{}", i), {name('a', i), "middle"}, {name('b', i), "middle"});
    if (i == 0) continue;
    out.add_pin(fmt::format("low{}", i), {name('b', i - 1), "B"}, {name('a', i), "A"});
    out.add_pin(fmt::format("high{}", i), {name('a', i - 1), "B"}, {name('b', i), "A"});
  }
  Model model = std::move(out).model();
  model.gravity = {0, 0};
  model.simulate.duration = 0.7;
  model.simulate.output_step = 0;
  return model;
}

}  // namespace pintle::bench

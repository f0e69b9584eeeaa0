// Where what drives a component jumps, or its rate does: a motor that is switched to another speed, a position on straight lines.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "system/switching_function.h"
#include "system/system.h"

namespace pintle {

/// Calls see(joint, position, rate) for every driven joint whose target jumps between two times next to each other: by how much it, and its rate, change beyond
/// what rate and acceleration explain [m or rad, m/s or rad/s].
template <class S, class See>
void for_each_target_jump(const BasicSystem<S>& system, double t0, double t1, See see) {
  constexpr double kJump = 1e-6;  // of the values on both sides: what is less is their rounding
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[j];
    if (joint.driven < 0 || joint.target.n_switches() == 0) continue;
    const double dt = t1 - t0;
    const std::array<double, 3> before = target_of(joint, t0), after = target_of(joint, t1);
    const auto jump = [&](std::size_t i) {
      const double smooth = 0.5 * dt * (before[i + 1] + after[i + 1]), change = after[i] - before[i] - smooth;
      return std::abs(change) > kJump * (std::abs(before[i]) + std::abs(after[i])) + std::abs(dt) * (std::abs(before[i + 1]) + std::abs(after[i + 1])) ? change : 0.0;
    };
    const double position = jump(0), rate = jump(1);
    if (position != 0 || rate != 0) see(j, position, rate);
  }
}

/// The same for a step from t0 to t1, with the time [s] of the first jump of each joint: see(joint, t, position, rate); the last time that is still before it.
template <class S, class See>
void for_each_target_jump_within(const BasicSystem<S>& system, double t0, double t1, See see) {
  constexpr int kHalvings = 60;     // of the step, until two neighbouring numbers are left on either side of the jump
  constexpr double kNextTo = 1e-9;  // of the step, from a jump to where the values on its sides are taken
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[j];
    const auto n = static_cast<std::size_t>(joint.driven < 0 ? 0 : joint.target.n_switches());
    if (n == 0) continue;
    const auto values_at = [&](double t) {
      std::vector<double> value(n);
      const std::array<double, 1> time{t};
      joint.target.find_switching(std::span(time).first(joint.target.variables().size()), value.data(), nullptr);
      return value;
    };
    const std::vector<double> begin = values_at(t0);
    double low = t0, high = t1;
    if (same_sides(begin, values_at(high))) continue;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = low + 0.5 * (high - low);
      (same_sides(begin, values_at(middle)) ? low : high) = middle;
    }
    const double aside = kNextTo * (t1 - t0);
    for_each_target_jump(system, low - aside, high + aside, [&](int jumping, double position, double rate) {
      if (jumping == j) see(j, low, position, rate);
    });
  }
}

}  // namespace pintle

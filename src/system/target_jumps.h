// Jumps of the target of a driven component, or of its rate: a motor switched to another speed, a piecewise linear position.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "system/system.h"

namespace pintle {

/// An instantaneous change of a target.
struct TargetJump {
  int joint;
  double t;               // the last time before the jump [s]
  double position, rate;  // [m or rad], [m/s or rad/s]; one of them may be 0
};

/// Why ideal joints cannot follow a target that jumps.
template <class S>
std::string infinite_force_message(const TargetJump& jump, const BasicJointData<S>& joint);

/// The change of a driven joint's target between two adjacent times beyond what its rate and acceleration explain; none if that is zero.
template <class S>
std::optional<TargetJump> target_jump(const BasicSystem<S>& system, int j, double t0, double t1) {
  constexpr double kJump = 1e-6;  // of the values on both sides: smaller changes are their rounding
  const BasicJointData<S>& joint = system.joints[static_cast<std::size_t>(j)];
  if (joint.driven < 0 || joint.target.n_switches() == 0) return std::nullopt;
  const double dt = t1 - t0;
  const std::array<double, 3> before = target_of(joint, t0), after = target_of(joint, t1);
  const auto jump = [&](std::size_t i) {
    const double smooth = 0.5 * dt * (before[i + 1] + after[i + 1]), change = after[i] - before[i] - smooth;
    return std::abs(change) > kJump * (std::abs(before[i]) + std::abs(after[i])) + std::abs(dt) * (std::abs(before[i + 1]) + std::abs(after[i + 1])) ? change : 0.0;
  };
  const TargetJump found{j, t0, jump(0), jump(1)};
  if (found.position == 0 && found.rate == 0) return std::nullopt;
  return found;
}

/// The first jump of all targets within a step. For a joint whose target has several jumps there, only one of them is found.
template <class S>
std::optional<TargetJump> first_target_jump(const BasicSystem<S>& system, double t0, double t1) {
  std::optional<TargetJump> first;
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[static_cast<std::size_t>(j)];
    if (joint.driven < 0 || joint.target.n_switches() == 0) continue;
    std::vector<double> begin(static_cast<std::size_t>(joint.target.n_switches())), value(begin.size());
    const auto evaluate_switching_functions = [&joint](double t, std::vector<double>& to) {
      const std::array<double, 1> time{t};
      joint.target.evaluate_switching_functions(std::span(time).first(joint.target.variables().size()), to.data(), nullptr);
    };
    const auto is_beyond = [&](double t) {  // on the kink itself, expressions have the derivatives of the far side
      evaluate_switching_functions(t, value);
      return !std::equal(begin.begin(), begin.end(), value.begin(), [](double a, double b) { return (a > 0) == (b > 0) && (a == 0 || b != 0); });
    };
    evaluate_switching_functions(t0, begin);
    if (!is_beyond(t1)) continue;
    double low = t0, high = t1;
    for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high)) (is_beyond(middle) ? high : low) = middle;
    if (first && first->t <= low) continue;
    if (const auto jump = target_jump(system, j, low, std::nextafter(high, t1))) first = jump;  // at the switch itself an expression may still have the value before it
  }
  return first;
}

}  // namespace pintle

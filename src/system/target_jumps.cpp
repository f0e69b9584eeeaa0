#include "system/target_jumps.h"

#include <fmt/format.h>

namespace pintle {

template <class S>
std::string infinite_force_message(const TargetJump& jump, const BasicJointData<S>& joint) {
  const bool turns = joint.driven == S::kTurn;
  const std::string change = jump.position != 0 ? fmt::format("jump by {:.4g} {}", jump.position, turns ? "rad" : "m") : fmt::format("change its speed by {:.4g} {} instantly", jump.rate, turns ? "rad/s" : "m/s");
  return fmt::format("{} {} is to {} at t = {:.9g} s, which would take an infinite force with ideal joints; spread the change over some time (smoothstep), or use equations = \"newtonian\", whose joints and motors are compliant",
                     joint.servo >= 0 ? "motor" : "joint", joint.name, change, jump.t);
}

template std::string infinite_force_message(const TargetJump& jump, const JointData& joint);
PINTLE_IN_SPACE(template std::string infinite_force_message(const TargetJump& jump, const BasicJointData<Spatial>& joint);)

}  // namespace pintle

// Expressions from text, for models that are made in a program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pintle/expression.h"

namespace pintle {

/// Parses an expression as model files have them, such as "5 N*m - 0.1*rate" for a motor's torque or "20*sin(3*t)" for a force. `variables`: the names that it
/// may use. Those of a motor are t, and the coordinate of its own joint as angle, slide or rate; forces and motors may also read other joints, bodies and markers
/// ("pin.angle", "rod.x", "rod.tip.vy"), as in model files. Units are converted to SI; whether their dimensions fit is not checked. Throws std::invalid_argument, with the
/// position in the text and the reason.
Expression parse(std::string_view text, const std::vector<std::string>& variables = {"t"});

}  // namespace pintle

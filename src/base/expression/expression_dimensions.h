// Which dimensions may be combined in an expression, and the dimension of the result.
//
// A bare number fits everything. As a factor, "2" in "2*crank" is just a number if the other side is a constant with
// units; with a variable, as in "0.1*rate", it is a coefficient in whatever units are needed.
#pragma once

#include <cstddef>
#include <string>

#include "base/expression/expression_ops.h"
#include "pintle/expression.h"

namespace pintle {

/// What is known about a part of an expression while it is parsed.
struct Operand {
  Dimension dimension;
  bool is_number = false;  // bare by nature: a literal, or the result of a function of numbers
  bool varies = false;     // depends on a variable
  double constant = 0;     // its value, if it does not vary
  std::size_t offset = 0;  // where it starts in the text
};

/// Why two operands cannot be combined; the caller decides at which of them to report it. Empty: they can.
struct DimensionProblem {
  std::string found;
  std::string because;
  std::string suggestion;
};

/// Operand or problem: `problem.because` is empty if all is well.
struct CombinedOperand {
  Operand operand;
  DimensionProblem problem;
};

/// Requires a number or an angle, as the argument of `name`; "" if it is one.
DimensionProblem check_pure(const Operand& operand, const std::string& name);

/// a + b, and everything else that requires two operands of one kind: `between` joins their names in the message.
CombinedOperand alike(const Operand& a, const Operand& b, const std::string& between);
CombinedOperand product_of(const Operand& a, const Operand& b);
CombinedOperand quotient_of(const Operand& a, const Operand& b);
CombinedOperand power_of(const Operand& a, const Operand& exponent);
CombinedOperand square_root_of(const Operand& a);

}  // namespace pintle

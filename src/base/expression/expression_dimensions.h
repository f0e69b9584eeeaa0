// Which dimensions may meet in an expression, and what comes out.
//
// A bare number fits everything. As a factor, "2" in "2*crank" is just a number when the other side is a constant with
// units; beside a variable, as in "0.1*rate", it is a coefficient in whatever units are needed.
#pragma once

#include <cstddef>
#include <string>

#include "base/expression/expression_ops.h"
#include "pintle/expression.h"

namespace pintle {

/// What is known of a part of an expression while it is parsed.
struct Operand {
  Dimension dimension;
  bool is_number = false;  // bare by nature: a literal, or what functions of numbers give
  bool varies = false;     // depends on a variable
  double constant = 0;     // its value, if it does not vary
  std::size_t offset = 0;  // where it starts in the text
};

/// Why two operands do not go together; at which of them is for the caller to say. Empty: they do.
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

/// A number or an angle is wanted, as the argument of `name`; "" if it is one.
DimensionProblem check_pure(const Operand& operand, const std::string& name);

/// a + b, and everything else that wants two of a kind: `between` joins their names in the message.
CombinedOperand alike(const Operand& a, const Operand& b, const std::string& between);
CombinedOperand product_of(const Operand& a, const Operand& b);
CombinedOperand quotient_of(const Operand& a, const Operand& b);
CombinedOperand power_of(const Operand& a, const Operand& exponent);
CombinedOperand square_root_of(const Operand& a);

}  // namespace pintle

// What an expression is compiled to: postfix instructions for a small stack.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/expression/expression_ops.h"
#include "pintle/expression.h"

namespace pintle {

/// The most operands that may wait at one time; the parser refuses more.
inline constexpr std::size_t kStackSize = 128;

struct Instruction {
  Op op = Op::kConstant;
  std::uint32_t variable = 0;  // kVariable: its index
  double constant = 0;         // kConstant: its value
};

struct Expression::Program {
  std::vector<Instruction> code;  // leaves one value; never more than kStackSize of them on the way
};

}  // namespace pintle

// What an expression is compiled to: postfix instructions for a small stack.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/expression/expression_ops.h"
#include "base/tables/table_function.h"
#include "pintle/expression.h"

namespace pintle {

/// Limit on operands on the stack at one time; the parser refuses more.
inline constexpr std::size_t kStackSize = 128;

struct Instruction {
  Op op = Op::kConstant;
  std::uint32_t index = 0;  // kVariable: of the variable; kTable: of the table
  double constant = 0;         // kConstant: its value
};

struct Expression::Program {
  std::vector<Instruction> code;  // leaves one value; never more than kStackSize of them in between
  std::vector<std::shared_ptr<const TableFunction>> tables{};

  /// Number of kinks and jumps of an instruction within its range.
  int n_switches(const Instruction& step) const { return step.op == Op::kTable ? tables[step.index]->has_kinks() : pintle::n_switches(step.op); }
};

}  // namespace pintle

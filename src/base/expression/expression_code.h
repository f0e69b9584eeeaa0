// Builds an expression's program; constant parts are evaluated at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/expression/expression_program.h"

namespace pintle {

class ExpressionCode {
 public:
  void push_constant(double value);
  void push_variable(std::size_t index);
  /// Applies `op` to the topmost operands; if none of them varies, they are replaced by one constant.
  void apply_op(Op op, bool varies);
  /// The same with a table applied to the topmost operand.
  void apply_table(std::shared_ptr<const TableFunction> table, bool varies);

  /// The constant on top of the stack; 0 if the top is a variable expression.
  double top_constant() const;
  /// Whether apply_op has made something infinite or undefined out of finite constants.
  bool went_out_of_range() const { return went_out_of_range_; }
  bool overflows_stack() const { return deepest_ > kStackSize; }
  Expression::Program program() const { return {code_, tables_}; }

 private:
  void push(const Instruction& instruction);
  double folded(Op op) const;

  std::vector<Instruction> code_;
  std::vector<std::shared_ptr<const TableFunction>> tables_;
  std::size_t depth_ = 0;
  std::size_t deepest_ = 0;
  bool went_out_of_range_ = false;
};

}  // namespace pintle

#include "base/expression/expression_code.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pintle {

void ExpressionCode::push(const Instruction& instruction) {
  code_.push_back(instruction);
  depth_ += 1;
  deepest_ = std::max(deepest_, depth_);
}

void ExpressionCode::push_constant(double value) {
  push({Op::kConstant, 0, value});
}

void ExpressionCode::push_variable(std::size_t index) {
  push({Op::kVariable, static_cast<std::uint32_t>(index), 0});
}

double ExpressionCode::folded(Op op) const {
  const std::size_t end = code_.size();
  const auto operand = [&](std::size_t from_end) { return code_[end - from_end].constant; };
  switch (arity(op)) {
    case 1:
      return apply(op, operand(1));
    case 2:
      return apply(op, operand(2), operand(1));
    default:
      return apply(op, operand(3), operand(2), operand(1));
  }
}

void ExpressionCode::apply_op(Op op, bool varies) {
  const auto n = static_cast<std::size_t>(arity(op));
  depth_ -= n - 1;
  if (varies) {
    code_.push_back({op, 0, 0});
    return;
  }
  const double result = folded(op);
  const bool all_finite = std::all_of(code_.end() - static_cast<std::ptrdiff_t>(n), code_.end(),
                                      [](const Instruction& operand) { return std::isfinite(operand.constant); });
  if (all_finite && !std::isfinite(result)) went_out_of_range_ = true;
  code_.resize(code_.size() - n);
  code_.push_back({Op::kConstant, 0, result});
}

void ExpressionCode::apply_table(std::shared_ptr<const TableFunction> table, bool varies) {
  if (!varies) {
    code_.back().constant = table->value(code_.back().constant);
    return;
  }
  const auto place = std::find(tables_.begin(), tables_.end(), table);
  code_.push_back({Op::kTable, static_cast<std::uint32_t>(place - tables_.begin()), 0});
  if (place == tables_.end()) tables_.push_back(std::move(table));
}

double ExpressionCode::top_constant() const {
  return code_.empty() || code_.back().op != Op::kConstant ? 0 : code_.back().constant;
}

}  // namespace pintle

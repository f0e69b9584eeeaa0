#include "pintle/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "base/expression_program.h"
#include "base/jet.h"

namespace pintle {
namespace {

// Runs `program` on numbers or jets. `constant` and `variable` make a T of a value and of a variable's index.
template <class T, class MakeConstant, class MakeVariable>
T run(const Expression::Program& program, const MakeConstant& constant, const MakeVariable& variable) {
  std::array<T, kStackSize> stack;
  std::size_t top = 0;
  for (const Instruction& step : program.code) {
    switch (arity(step.op)) {
      case 0:
        stack[top++] = step.op == Op::kConstant ? constant(step.constant) : variable(step.variable);
        break;
      case 1:
        stack[top - 1] = apply(step.op, stack[top - 1]);
        break;
      case 2:
        stack[top - 2] = apply(step.op, stack[top - 2], stack[top - 1]);
        top -= 1;
        break;
      default:
        stack[top - 3] = apply(step.op, stack[top - 3], stack[top - 2], stack[top - 1]);
        top -= 2;
    }
  }
  return stack[0];
}

// Along variable `index`, the others held.
Jet run_along(const Expression::Program& program, std::span<const double> values, std::size_t index) {
  return run<Jet>(
      program,
      [](double c) {
        return Jet{c, 0, 0};
      },
      [&](std::uint32_t i) {
        return Jet{values[i], i == index ? 1.0 : 0.0, 0};
      });
}

}  // namespace

Expression::Expression() = default;

Expression Expression::constant(double si) {
  Expression result;
  result.text_ = fmt::format("{}", si);
  result.program_ = std::make_shared<const Program>(Program{{Instruction{Op::kConstant, 0, si}}});
  return result;
}

bool Expression::is_constant() const {
  return variables_.empty();
}

double Expression::value(std::span<const double> values) const {
  if (!program_) return 0;
  assert(values.size() >= variables_.size());
  return run<double>(
      *program_, [](double c) { return c; }, [&](std::uint32_t i) { return values[i]; });
}

double Expression::gradient(std::span<const double> values, std::span<double> gradient) const {
  assert(gradient.size() >= variables_.size());
  if (variables_.empty()) return value(values);
  double result = 0;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const Jet jet = run_along(*program_, values, i);
    result = jet.value;
    gradient[i] = jet.first;
  }
  return result;
}

bool Expression::has_branches() const {
  if (!program_) return false;
  const auto& code = program_->code;
  return std::any_of(code.begin(), code.end(), [](const Instruction& step) { return pintle::has_branches(step.op); });
}

std::uint64_t Expression::branches(std::span<const double> values) const {
  if (!program_) return 0;
  std::uint64_t sides = 0;
  std::array<double, kStackSize> stack;
  std::size_t top = 0;
  for (const Instruction& step : program_->code) {
    const std::size_t n = static_cast<std::size_t>(arity(step.op));
    if (n == 0) {
      stack[top++] = step.op == Op::kConstant ? step.constant : values[step.variable];
      continue;
    }
    top -= n;
    const double a = stack[top], b = n > 1 ? stack[top + 1] : 0, c = n > 2 ? stack[top + 2] : 0;
    if (pintle::has_branches(step.op)) sides = sides * 0x9E3779B97F4A7C15U + 1 + branch(step.op, a, b, c);
    stack[top++] = n == 1 ? apply(step.op, a) : n == 2 ? apply(step.op, a, b) : apply(step.op, a, b, c);
  }
  return sides;
}

std::array<double, 3> Expression::second_order(std::span<const double> values, std::size_t index) const {
  if (variables_.empty()) return {value(values), 0, 0};
  const Jet jet = run_along(*program_, values, index);
  return {jet.value, jet.first, jet.second};
}

}  // namespace pintle

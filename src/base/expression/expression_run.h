// Runs expression programs on numbers or jets.
#pragma once

#include <array>
#include <span>

#include "base/expression/expression_program.h"
#include "base/expression/jet.h"

namespace pintle {

/// Runs `program`. `constant` and `variable` make a T from a value and from a variable's index; `after(index, operands,
/// result)` is called after each operation and may change its result.
template <class T, class MakeConstant, class MakeVariable, class After>
T run(const Expression::Program& program, const MakeConstant& constant, const MakeVariable& variable, const After& after) {
  std::array<T, kStackSize> stack;
  std::size_t top = 0;
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& step = program.code[i];
    const auto n = static_cast<std::size_t>(arity(step.op));
    if (n == 0) {
      stack[top++] = step.op == Op::kConstant ? constant(step.constant) : variable(step.index);
      continue;
    }
    top -= n;
    const T* x = stack.data() + top;
    T result = step.op == Op::kTable ? apply(*program.tables[step.index], x[0]) : n == 1 ? apply(step.op, x[0]) : n == 2 ? apply(step.op, x[0], x[1]) : apply(step.op, x[0], x[1], x[2]);
    after(i, std::span<const T>(x, n), result);
    stack[top++] = result;
  }
  return stack[0];
}

/// Evaluates with numbers, at `values`.
template <class After>
double run_at(const Expression::Program& program, std::span<const double> values, const After& after) {
  return run<double>(
      program, [](double c) { return c; }, [&](std::uint32_t i) { return values[i]; }, after);
}

/// Evaluates with derivatives along variable `index`, the others held.
template <class After>
Jet run_along(const Expression::Program& program, std::span<const double> values, std::size_t index, const After& after) {
  return run<Jet>(
      program,
      [](double c) {
        return Jet{c, 0, 0};
      },
      [&](std::uint32_t i) {
        return Jet{values[i], i == index ? 1.0 : 0.0, 0};
      },
      after);
}

}  // namespace pintle

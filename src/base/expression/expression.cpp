#include "pintle/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "base/expression/expression_run.h"

namespace pintle {
namespace {

constexpr auto kAsIs = [](std::size_t, auto, auto&) {};

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

Expression Expression::substitute(std::string_view variable, double si) const {
  Expression fixed = *this;
  if (!program_) return fixed;
  Program program = *program_;
  for (Instruction& step : program.code)
    if (step.op == Op::kVariable && variables_[step.index] == variable) step = {Op::kConstant, 0, si};
  fixed.program_ = std::make_shared<const Program>(std::move(program));
  return fixed;
}

double Expression::value(std::span<const double> values) const {
  if (!program_) return 0;
  assert(values.size() >= variables_.size());
  return run_at(*program_, values, kAsIs);
}

double Expression::gradient(std::span<const double> values, std::span<double> gradient) const {
  assert(gradient.size() >= variables_.size());
  if (variables_.empty()) return value(values);
  double result = 0;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const Jet jet = run_along(*program_, values, i, kAsIs);
    result = jet.value;
    gradient[i] = jet.first;
  }
  return result;
}

int Expression::n_switches() const {
  int n = 0;
  if (program_)
    for (const Instruction& step : program_->code) n += program_->n_switches(step);
  return n;
}

std::array<double, 3> Expression::second_order(std::span<const double> values, std::size_t index) const {
  if (variables_.empty()) return {value(values), 0, 0};
  const Jet jet = run_along(*program_, values, index, kAsIs);
  return {jet.value, jet.first, jet.second};
}

}  // namespace pintle

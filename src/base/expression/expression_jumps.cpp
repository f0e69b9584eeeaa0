// Expressions with one of their jumps replaced by a ramp.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

#include "base/expression/expression_run.h"

namespace pintle {
namespace {

bool jumps(Op op) { return op == Op::kSign || op == Op::kStep || (op >= Op::kLess && op <= Op::kGreaterEqual); }

template <class T>
T margin_of(std::span<const T> operands) {
  return operands.size() > 1 ? apply(Op::kSubtract, operands[0], operands[1]) : operands[0];
}

double result_at(Op op, double margin) { return arity(op) == 1 ? apply(op, margin) : apply(op, margin, 0.0); }

// The result of operation `op` on the low side of its jump (0) or on the high one (1).
double on_side(Op op, int side) { return result_at(op, side == 0 ? -1 : 1); }

// The argument of the table at instruction `call`.
double argument_at(const Expression::Program& program, std::size_t call, double x) {
  double argument = 0;
  run_at(program, std::array{x}, [&](std::size_t i, std::span<const double> operands, double&) {
    if (i == call) argument = operands[0];
  });
  return argument;
}

}  // namespace

std::optional<std::vector<double>> Expression::kinks_of_table(std::size_t k, double low, double high, std::size_t most) const {
  if (!program_ || variables_.size() != 1) return {};
  constexpr double kStraight = 1e-12;  // as a fraction of the arguments: deviation from linearity due to rounding
  std::size_t call = 0;
  for (std::size_t before = 0; call < program_->code.size(); before += static_cast<std::size_t>(program_->n_switches(program_->code[call++])))
    if (before == k && program_->n_switches(program_->code[call]) > 0) break;
  if (call == program_->code.size() || program_->code[call].op != Op::kTable) return {};
  const double at_low = argument_at(*program_, call, low), at_high = argument_at(*program_, call, high), slope = (at_high - at_low) / (high - low);
  for (const double part : {0.3, 0.7}) {
    const double off = argument_at(*program_, call, low + part * (high - low)) - (at_low + part * (at_high - at_low));
    if (!(std::abs(off) <= kStraight * std::max(std::abs(at_low), std::abs(at_high)))) return {};
  }
  if (slope == 0) return std::vector<double>{};
  auto places = program_->tables[program_->code[call].index]->kinks_between(std::min(at_low, at_high), std::max(at_low, at_high), most);
  if (!places) return {};
  for (double& place : *places) place = low + (place - at_low) / slope;
  if (slope < 0) std::reverse(places->begin(), places->end());
  return places;
}

double Expression::margin(std::size_t jump, std::span<const double> values) const {
  double margin = 0;
  run_at(*program_, values, [&](std::size_t i, std::span<const double> operands, double&) {
    if (i == jump) margin = margin_of(operands);
  });
  return margin;
}

std::optional<std::size_t> Expression::jump_between(std::span<const double> from, std::span<const double> to) const {
  if (!program_) return {};
  const auto& code = program_->code;
  for (std::size_t i = 0; i < code.size(); ++i)
    if (jumps(code[i].op) && result_at(code[i].op, margin(i, from)) != result_at(code[i].op, margin(i, to))) return i;  // exactly on the jump the operation decides the side
  return {};
}

double Expression::gradient(std::span<const double> values, std::span<double> gradient, const Ramp& ramp) const {
  assert(gradient.size() >= variables_.size());
  const Op op = program_->code[ramp.jump].op;
  double result = 0;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    Jet of_side[2], margin{0, 0, 0};
    for (const int side : {0, 1})
      of_side[side] = run_along(*program_, values, i, [&](std::size_t at, std::span<const Jet> operands, Jet& value) {
        if (at != ramp.jump) return;
        margin = margin_of(operands);
        value = {on_side(op, side), 0, 0};
      });
    const double share = ramp.share_at(margin.value), rise = of_side[1].value - of_side[0].value;
    result = of_side[0].value + share * rise;
    gradient[i] = of_side[0].first + share * (of_side[1].first - of_side[0].first) + ramp.slope * margin.first * rise;
  }
  return result;
}

void Expression::evaluate_switching_functions(std::span<const double> values, double* value, const Ramp* ramp) const {
  if (!program_) return;
  run_at(*program_, values, [&](std::size_t i, std::span<const double> x, double& result) {
    const Instruction& step = program_->code[i];
    const Op op = step.op;
    if (op == Op::kTable && program_->tables[step.index]->has_kinks()) value[0] = program_->tables[step.index]->switching(x[0]);
    else pintle::evaluate_switching_functions(op, x, value);
    if (ramp && i == ramp->jump) {
      const double share = ramp->share_at(margin_of(x));
      value[0] = std::max(-share, share - 1);
      result = on_side(op, 1);
    }
    value += program_->n_switches(step);
  });
}

}  // namespace pintle

// The operations of expression programs, and their values. Derivatives: jet.h.
//
// At kinks: abs, min and max have the derivatives of the side beyond the kink, where the variable is larger; step is 1 at 0;
// smoothstep is flat at both ends; comparisons, step and sign have slope 0 everywhere. NaN propagates through everything.
#pragma once

#include <span>
#include <string_view>

#include "base/tables/table_function.h"

namespace pintle {

enum class Op : unsigned char {
  // nothing on the stack
  kConstant,
  kVariable,
  // one operand
  kNegate,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan,
  kSinh,
  kCosh,
  kTanh,
  kExp,
  kLog,
  kSqrt,
  kAbs,
  kSign,
  kStep,
  kTable,  // values, derivatives and kinks are those of the program's table: expression_program.h
  // two operands
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kPower,
  kAtan2,
  kMin,
  kMax,
  kLess,
  kGreater,
  kLessEqual,
  kGreaterEqual,
  // three operands
  kSmoothstep,
  kIf,
};

/// Number of operands.
constexpr int arity(Op op) {
  if (op <= Op::kVariable) return 0;
  if (op <= Op::kTable) return 1;
  return op <= Op::kGreaterEqual ? 2 : 3;
}

/// How a function treats dimensions.
enum class FunctionRule {
  kPureToPure,    // sin, exp: numbers or angles in, a number out
  kPureToAngle,   // asin
  kSignToPure,    // sign, step: only the sign of the argument matters
  kKeep,          // abs
  kSquareRoot,    // sqrt
  kAlikeKeep,     // min, max
  kAlikeToAngle,  // atan2
  kAlikeToPure,   // smoothstep
  kPower,         // pow
  kChoose,        // if
};

struct FunctionInfo {
  std::string_view name;
  Op op;
  FunctionRule rule;
  std::string_view usage;  // "atan2(y, x)"
};

/// Every function, in the manual's order.
std::span<const FunctionInfo> function_catalog();
const FunctionInfo* find_function(std::string_view name);

/// Number of kinks, jumps and poles of an operation within its range. The jump of atan2 is where y changes its sign; where x is positive then, nothing jumps.
constexpr int n_switches(Op op) {
  if (op == Op::kSmoothstep) return 2;
  return op == Op::kTan || op == Op::kAbs || op == Op::kSign || op == Op::kStep || (op >= Op::kAtan2 && op <= Op::kGreaterEqual) ? 1 : 0;  // `if` follows its condition
}
/// One value for each of them that is positive on one side only: not at the kink itself if the kink belongs to the other side.
void evaluate_switching_functions(Op op, std::span<const double> operands, double* value);

inline double apply(const TableFunction& table, double a) { return table.value(a); }
double apply(Op op, double a);
double apply(Op op, double a, double b);
double apply(Op op, double a, double b, double c);

}  // namespace pintle

#include "base/expression/expression_ops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/cubic_hermite.h"

namespace pintle {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<FunctionInfo, 21> kFunctions{{
    {"sin", Op::kSin, FunctionRule::kPureToPure, "sin(x)"},
    {"cos", Op::kCos, FunctionRule::kPureToPure, "cos(x)"},
    {"tan", Op::kTan, FunctionRule::kPureToPure, "tan(x)"},
    {"asin", Op::kAsin, FunctionRule::kPureToAngle, "asin(x)"},
    {"acos", Op::kAcos, FunctionRule::kPureToAngle, "acos(x)"},
    {"atan", Op::kAtan, FunctionRule::kPureToAngle, "atan(x)"},
    {"atan2", Op::kAtan2, FunctionRule::kAlikeToAngle, "atan2(y, x)"},
    {"sinh", Op::kSinh, FunctionRule::kPureToPure, "sinh(x)"},
    {"cosh", Op::kCosh, FunctionRule::kPureToPure, "cosh(x)"},
    {"tanh", Op::kTanh, FunctionRule::kPureToPure, "tanh(x)"},
    {"exp", Op::kExp, FunctionRule::kPureToPure, "exp(x)"},
    {"log", Op::kLog, FunctionRule::kPureToPure, "log(x)"},
    {"sqrt", Op::kSqrt, FunctionRule::kSquareRoot, "sqrt(x)"},
    {"abs", Op::kAbs, FunctionRule::kKeep, "abs(x)"},
    {"sign", Op::kSign, FunctionRule::kSignToPure, "sign(x)"},
    {"min", Op::kMin, FunctionRule::kAlikeKeep, "min(a, b)"},
    {"max", Op::kMax, FunctionRule::kAlikeKeep, "max(a, b)"},
    {"pow", Op::kPower, FunctionRule::kPower, "pow(base, exponent)"},
    {"step", Op::kStep, FunctionRule::kSignToPure, "step(x)"},
    {"smoothstep", Op::kSmoothstep, FunctionRule::kAlikeToPure, "smoothstep(a, b, x)"},
    {"if", Op::kIf, FunctionRule::kChoose, "if(condition, then, otherwise)"},
}};

double sign(double a) {
  if (a > 0) return 1;
  return a < 0 ? -1 : a;  // zero and NaN are their own sign
}

double smoothstep(double a, double b, double x) {
  if (std::isnan(a) || std::isnan(b) || std::isnan(x)) return kNan;
  if (a == b) return x >= a ? 1 : 0;
  return cubic_blend(std::clamp((x - a) / (b - a), 0.0, 1.0));
}

double truth(bool holds, double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return kNan;
  return holds ? 1 : 0;
}

}  // namespace

std::span<const FunctionInfo> function_catalog() {
  return kFunctions;
}

const FunctionInfo* find_function(std::string_view name) {
  const std::span<const FunctionInfo> all = function_catalog();
  const auto it = std::find_if(all.begin(), all.end(), [&](const FunctionInfo& info) { return info.name == name; });
  return it == all.end() ? nullptr : &*it;
}

void evaluate_switching_functions(Op op, std::span<const double> x, double* value) {
  switch (op) {
    case Op::kAbs:
    case Op::kSign:
    case Op::kStep:
    case Op::kAtan2:  // jumps where y changes its sign at a negative x
      value[0] = -x[0];
      break;
    case Op::kTan:
      value[0] = std::cos(x[0]);
      break;
    case Op::kMin:
    case Op::kMax:
    case Op::kLess:
    case Op::kGreaterEqual:
      value[0] = x[1] - x[0];
      break;
    case Op::kGreater:
    case Op::kLessEqual:
      value[0] = x[0] - x[1];
      break;
    case Op::kSmoothstep:
      value[0] = x[0] - x[2];
      value[1] = x[1] - x[2];
      break;
    default:
      break;
  }
}

double apply(Op op, double a) {
  switch (op) {
    case Op::kNegate:
      return -a;
    case Op::kSin:
      return std::sin(a);
    case Op::kCos:
      return std::cos(a);
    case Op::kTan:
      return std::tan(a);
    case Op::kAsin:
      return std::asin(a);
    case Op::kAcos:
      return std::acos(a);
    case Op::kAtan:
      return std::atan(a);
    case Op::kSinh:
      return std::sinh(a);
    case Op::kCosh:
      return std::cosh(a);
    case Op::kTanh:
      return std::tanh(a);
    case Op::kExp:
      return std::exp(a);
    case Op::kLog:
      return std::log(a);
    case Op::kSqrt:
      return std::sqrt(a);
    case Op::kAbs:
      return std::abs(a);
    case Op::kSign:
      return sign(a);
    case Op::kStep:
      return truth(a >= 0, a, a);
    default:
      return kNan;
  }
}

double apply(Op op, double a, double b) {
  switch (op) {
    case Op::kAdd:
      return a + b;
    case Op::kSubtract:
      return a - b;
    case Op::kMultiply:
      return a * b;
    case Op::kDivide:
      return a / b;
    case Op::kPower:
      return std::pow(a, b);
    case Op::kAtan2:
      return std::atan2(a, b);
    case Op::kMin:
      return b < a || std::isnan(b) ? b : a;
    case Op::kMax:
      return b > a || std::isnan(b) ? b : a;
    case Op::kLess:
      return truth(a < b, a, b);
    case Op::kGreater:
      return truth(a > b, a, b);
    case Op::kLessEqual:
      return truth(a <= b, a, b);
    case Op::kGreaterEqual:
      return truth(a >= b, a, b);
    default:
      return kNan;
  }
}

double apply(Op op, double a, double b, double c) {
  switch (op) {
    case Op::kSmoothstep:
      return smoothstep(a, b, c);
    case Op::kIf:
      if (std::isnan(a)) return kNan;
      return a != 0 ? b : c;
    default:
      return kNan;
  }
}

}  // namespace pintle

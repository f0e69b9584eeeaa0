// A value with its first and second derivative along one variable, and exact arithmetic on it.
//
// A zero derivative stays zero whatever it is multiplied by, so that a function's infinite slope does not spoil constant
// operands. At a kink the derivatives are those of the side of increasing variable; see expression_ops.h.
#pragma once

#include "base/expression/expression_ops.h"

namespace pintle {

struct Jet {
  double value;
  double first;
  double second;
};

Jet apply(const TableFunction& table, const Jet& a);
Jet apply(Op op, const Jet& a);
Jet apply(Op op, const Jet& a, const Jet& b);
Jet apply(Op op, const Jet& a, const Jet& b, const Jet& c);

}  // namespace pintle

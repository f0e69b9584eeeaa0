#include "laws/flexures/cross_spring.h"

#include <algorithm>
#include <cmath>

namespace pintle {

CrossSpringLaw::CrossSpringLaw(const BladeSize& blade, double half_angle, double crossing)
    : blade_(blade), cos_(std::cos(half_angle)), sin_(std::sin(half_angle)), arm_((1 - crossing) * blade.length) {
  LawInput<FewDual<3>> in{};
  for (int k = 0; k < 3; ++k) in.gap[k] = FewDual<3>::variable(0, k);
  LawOutput<FewDual<3>> out;
  out.clear();
  evaluate(in, out);
  for (int k = 0; k < 3; ++k) straight_[k] = -out.force[k].d[k];
}

void CrossSpringLaw::borders(const LawInput<double>& in, double* value) const {
  value[0] = 1;
  for (const double side : {1.0, -1.0})
    if (!stress(side, in.gap).found) value[0] = -1;
}

void CrossSpringLaw::observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
  value[0] = 0;
  value[1] = 1;
  for (const double side : {1.0, -1.0}) {
    const LeafSpringLaw::Stress blade = stress(side, in.gap);
    if (!blade.found) value[1] = 0;
    value[0] = blade.found ? std::max(value[0], blade.largest) : blade.largest;
  }
}

}  // namespace pintle

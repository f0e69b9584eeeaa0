// A rope: it pulls when longer than its length and exerts no force when shorter.
//
//   f = min(0, -(k e + c e'))  for e > 0, else 0      theory/joints Eq. (3.4)
//   V = 1/2 k max(0, e)^2                             Eq. (3.5)
//
// A rope never pushes: while it is stretched but shortening so fast that the damper would push, the force is 0 and the loss is the released
// elastic power, -k e e' >= 0. The formula changes at e = 0, in this state too, and where the force vanishes.
#pragma once

#include <algorithm>
#include <string_view>

#include "laws/law_math.h"
#include "laws/law_numbers.h"
#include "space/planar.h"

namespace pintle {

struct TensionLaw {
  static constexpr std::string_view kWord = "tension";
  static constexpr bool kStartsFree = true, kReportsCrossings = true;
  double k = 0;  // > 0 [N/m]
  double c = 0;  // >= 0 [N*s/m]

  static TensionLaw typical() { return {1e6, 200}; }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const T none(0.0), e = where_positive(in.gap[0], in.gap[0], none), rate = in.rate[0], pull = k * e + c * rate;
    out.force[0] = where_positive(e, where_positive(pull, -pull, none), none);           // (3.4)
    out.energy = 0.5 * k * (e * e);                                                      // (3.5)
    out.loss = where_positive(e, where_positive(pull, c * (rate * rate), -k * (e * rate)), none);
  }
  int n_borders() const { return c > 0 ? 2 : 1; }
  /// Positive where it pulls, and where it is stretched but does not pull: there it loses power until it is slack.
  void borders(const LawInput<double>& in, double* value) const {
    const double pull = in.gap[0] + c / k * in.rate[0];
    value[0] = std::min(in.gap[0], pull);
    if (c > 0) value[1] = std::min(in.gap[0], -pull);
  }
  static constexpr std::string_view border_name(int border, bool rising) { return border > 0 ? "" : rising ? "taut" : "slack"; }
  Planar::Vec engaged_stiffness() const { return {k, 0, 0}; }
  Planar::Vec misfit(const Planar::Vec& gap) const { return {std::max(gap[0], 0.0), gap[1], gap[2]}; }
};

}  // namespace pintle

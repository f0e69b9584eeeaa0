// A rope: it pulls when longer than its length and does nothing when shorter.
//
//   f = min(0, -(k e + c e'))  for e > 0, else 0      theory/joints Eq. (3.4)
//   V = 1/2 k max(0, e)^2                             Eq. (3.5)
//
// A rope never pushes: while it is stretched but closing so fast that the damper would push, the force is 0 and
// the loss is what is left of the elastic power, -k e e' >= 0. The force has kinks at e = 0 and where it vanishes.
#pragma once

#include <algorithm>
#include <string_view>

#include "laws/response.h"

namespace pintle {

struct TensionLaw {
  static constexpr std::string_view kWord = "tension";
  double k = 0;  // > 0 [N/m]
  double c = 0;  // >= 0 [N*s/m]

  static TensionLaw typical() { return {1e6, 200}; }

  bool pulls(const Planar::Vec& gap, const Planar::Vec& rate) const { return gap[0] > 0 && k * gap[0] + c * rate[0] > 0; }
  Planar::Vec force(const Planar::Vec& gap, const Planar::Vec& rate) const {
    return {pulls(gap, rate) ? -(k * gap[0] + c * rate[0]) : 0.0, 0, 0};                 // (3.4)
  }
  static constexpr bool kHasBranches = true;
  /// Which side of its kinks the law is on.
  unsigned branch(const Planar::Vec& gap, const Planar::Vec& rate) const { return pulls(gap, rate) ? 1 : 0; }
  double loss(const Planar::Vec& gap, const Planar::Vec& rate) const {
    return pulls(gap, rate) ? c * rate[0] * rate[0] : -k * std::max(0.0, gap[0]) * rate[0];
  }
  Response respond(const Planar::Vec& gap, const Planar::Vec& rate) const {
    Response r;
    const double e = std::max(0.0, gap[0]);
    r.energy = 0.5 * k * e * e;                                                          // (3.5)
    r.force = force(gap, rate);
    if (pulls(gap, rate)) {
      r.stiffness(0, 0) = k;
      r.damping(0, 0) = c;
    }
    r.loss = loss(gap, rate);
    return r;
  }
};

}  // namespace pintle

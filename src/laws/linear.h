// A spring and a damper in every forbidden displacement: the paper's axioms, Eqs. (1)-(2), (7)-(8), (14)-(20).
//
//   f = -(k e + c e')     force on the second body     theory/joints Eq. (3.1)
//   V = 1/2 k e^2         loss = c e'^2                Eqs. (3.2), (3.3)
//
// At e = 0, e' = 0: f = 0, df/de = -k, df/de' = -c.
#pragma once

#include <string_view>

#include "laws/law_numbers.h"
#include "laws/response.h"

namespace pintle {

struct LinearLaw {
  static constexpr std::string_view kWord = "linear";
  Planar::Vec k = Planar::Vec::Zero();  // >= 0 [N/m, N/m, N*m/rad]
  Planar::Vec c = Planar::Vec::Zero();  // >= 0 [N*s/m, N*s/m, N*m*s/rad]

  static LinearLaw typical() { return {{1e8, 2e8, 1e6}, {3e3, 2e3, 30}}; }

  Planar::Vec force(const Planar::Vec& gap, const Planar::Vec& rate) const {
    return -(k.cwiseProduct(gap) + c.cwiseProduct(rate));                                // (3.1)
  }
  double loss(const Planar::Vec& rate) const { return rate.dot(c.cwiseProduct(rate)); }  // (3.3)
  Response respond(const Planar::Vec& gap, const Planar::Vec& rate) const {
    Response r;
    r.force = force(gap, rate);
    r.stiffness = k.asDiagonal();
    r.damping = c.asDiagonal();
    r.energy = 0.5 * gap.dot(k.cwiseProduct(gap));                                       // (3.2)
    r.loss = loss(rate);
    return r;
  }
  /// The same over any number type, added to `out`.
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    for (int i = 0; i < 3; ++i) {
      out.force[i] -= k[i] * in.gap[i] + c[i] * in.rate[i];
      out.energy += 0.5 * k[i] * (in.gap[i] * in.gap[i]);
      out.loss += c[i] * (in.rate[i] * in.rate[i]);
    }
  }
  Planar::Vec engaged_stiffness() const { return k; }
};

}  // namespace pintle

// A spring and a damper in every forbidden component: the paper's axioms, Eqs. (1)-(2), (7)-(8), (14)-(20).
//
//   f = -(k e + c e')     force on the second body     theory/joints Eq. (3.1)
//   V = 1/2 k e^2         loss = c e'^2                Eqs. (3.2), (3.3)
//
// At e = 0, e' = 0: f = 0, df/de = -k, df/de' = -c.
#pragma once

#include <string_view>

#include "laws/law_math.h"
#include "laws/law_numbers.h"
#include "laws/response.h"

namespace pintle {

template <class S>
struct BasicLinearLaw {
  using Vec = typename S::Vec;
  static constexpr std::string_view kWord = "linear";
  Vec k = Vec::Zero();  // >= 0 [N/m, N/m, N*m/rad]
  Vec c = Vec::Zero();  // >= 0 [N*s/m, N*s/m, N*m*s/rad]

  static BasicLinearLaw typical() {
    BasicLinearLaw law;
    for (int i = 0; i < S::kDof; ++i) {
      law.k[i] = i < S::kDim ? (1 + i) * 1e8 : (1 + i - S::kDim) * 1e6;
      law.c[i] = i < S::kDim ? 3e3 - i * 1e3 : 30;
    }
    return law;
  }

  Vec force(const Vec& gap, const Vec& rate) const {
    return -(k.cwiseProduct(gap) + c.cwiseProduct(rate));                                // (3.1)
  }
  double loss(const Vec& rate) const { return rate.dot(c.cwiseProduct(rate)); }  // (3.3)
  BasicResponse<S> respond(const Vec& gap, const Vec& rate) const {
    BasicResponse<S> r;
    r.force = force(gap, rate);
    r.stiffness = k.asDiagonal();
    r.damping = c.asDiagonal();
    r.energy = 0.5 * gap.dot(k.cwiseProduct(gap));                                       // (3.2)
    r.loss = loss(rate);
    return r;
  }
  /// The same over any number type, added to `out`.
  template <class T>
  void evaluate(const LawInput<T, S::kDof>& in, LawOutput<T, S::kDof>& out) const {
    for (int i = 0; i < S::kDof; ++i) {
      law_math::add(-k[i], in.gap[i], out.force[i]);
      law_math::add(-c[i], in.rate[i], out.force[i]);
      law_math::add_square(0.5 * k[i], in.gap[i], out.energy);
      law_math::add_square(c[i], in.rate[i], out.loss);
    }
  }
  Vec engaged_stiffness() const { return k; }
};
using LinearLaw = BasicLinearLaw<Planar>;

}  // namespace pintle

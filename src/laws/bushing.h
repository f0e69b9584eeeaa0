// A bushing: full matrices of stiffness and damping, a preload in the undeformed state, and a rest position of its own.
//
//   f = f_0 - K (e - e_0) - C e'            theory/joints Eq. (3.10)
//   V = 1/2 (e - e_0)' K (e - e_0) - f_0' (e - e_0)
//   P = e'' C e'  >= 0
//
// K and C are symmetric and positive semi-definite; the reader checks this.
#pragma once

#include <string_view>

#include "laws/law_numbers.h"
#include "space/planar.h"

namespace pintle {

struct BushingLaw {
  static constexpr std::string_view kWord = "bushing";
  Planar::Mat K = Planar::Mat::Zero();        // [N/m, N/rad, N*m/rad]
  Planar::Mat C = Planar::Mat::Zero();        // the same times seconds
  Planar::Vec preload = Planar::Vec::Zero();  // on the second body at the rest position [N, N, N*m]
  Planar::Vec offset = Planar::Vec::Zero();   // the rest position [m, m, rad]

  static BushingLaw typical() {
    BushingLaw law;
    law.K << 2e6, 3e5, -4e3, 3e5, 1e6, 2e3, -4e3, 2e3, 500;
    law.C << 900, 50, 2, 50, 700, -3, 2, -3, 4;
    law.preload << 12, -30, 0.4;
    law.offset << 1e-4, -2e-4, 1e-2;
    return law;
  }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    T e[3];
    for (int i = 0; i < 3; ++i) e[i] = in.gap[i] - T(offset[i]);
    for (int i = 0; i < 3; ++i) {
      T elastic(0.0), lost(0.0);
      for (int j = 0; j < 3; ++j) {
        elastic += K(i, j) * e[j];
        lost += C(i, j) * in.rate[j];
      }
      out.force[i] = T(preload[i]) - elastic - lost;
      out.energy += e[i] * (0.5 * elastic - T(preload[i]));
      out.loss += in.rate[i] * lost;
    }
  }
  Planar::Vec engaged_stiffness() const { return K.diagonal(); }
  Planar::Vec misfit(const Planar::Vec& gap) const { return gap - offset; }
};

}  // namespace pintle

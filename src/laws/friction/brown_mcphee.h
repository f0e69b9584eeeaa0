// Friction as a smooth function of the slip speed whose parameters can be measured: P. Brown, J. McPhee, A continuous velocity-based
// friction model for dynamics and control with physically meaningful parameters, J. Computational and Nonlinear Dynamics 11 (2016) 054502.
//
//   F = N (mu_k tanh(4 v/v_t) + (mu_s - mu_k) (v/v_t) / ((v/v_t)^2/4 + 3/4)^2 + mu_v v)          theory/joints Eq. (3.17)
//
// It is largest at v = v_t, where it is N mu_s (to 7e-4 of mu_k). It carries no load at rest: below v_t the joint creeps, by design.
// The paper's viscous term does not grow with the load; here it does, as in the other laws.
#pragma once

#include "laws/friction/friction.h"

namespace pintle {

struct BrownMcPheeLaw : Friction {
  static constexpr std::string_view kWord = "brown-mcphee";
  double transition = 1e-3;  // v_t [m/s]

  static BrownMcPheeLaw typical() { return {}; }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const T v = slip(in), s = (1 / transition) * v, width = 0.25 * (s * s) + T(0.75);
    rub(load(in) * (kinetic * tanh(4.0 * s) + (static_coefficient - kinetic) * divide(s, width * width) + viscous * v), v, out);  // (3.17)
  }
};

}  // namespace pintle

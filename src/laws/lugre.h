// Dry friction of what a joint leaves free, by the LuGre model, pressed by the joint's own reaction. C. Canudas de Wit, H. Olsson, K. J.
// Astrom, P. Lischinsky, A new model for control of systems with friction, IEEE Trans. Automatic Control 40 (1995) 419-425.
//
//   v = r w (pins) or the rate of the slide;      N = |reaction| + N_0
//   z' = v - s_0 |v| / mu(v) z,                   mu(v) = mu_k + (mu_s - mu_k) exp(-(v / v_s)^2)     theory/joints Eq. (3.12)
//   F = N (s_0 z + s_1 z' + s_2 v)                against the slip, on the second body               Eq. (3.13)
//
// z is the deflection of the bristles [m], s_0 their stiffness per unit of load [1/m]: with the stiffness in N/m, z would grow beyond
// bounds where the load vanishes. Steady slip gives F = N mu(v), a load that does not slip is carried by s_0 N z. The work of the
// bristles is counted as lost, and as regained where they spring back, because their energy changes with the load.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "laws/law_math.h"
#include "laws/law_part.h"

namespace pintle {

struct LuGreLaw {
  static constexpr std::string_view kWord = "lugre";
  static constexpr bool kHolds = false;
  int free = 2;                                      // component that slips: 2 of a pin, 0 of a slide
  std::array<double, 3> pressing{1, 1, 0};           // components whose force presses the surfaces together
  double radius = 0.01;                              // of the pin [m]; 1 for slides
  double kinetic = 0.1, stuck = 0.15;                // coefficients [-]
  double stribeck = 1e-3;                            // v_s [m/s]
  double bristle_stiffness = 1e5;                    // s_0 [1/m]
  double bristle_damping = 300, viscous = 0;         // s_1, s_2 [s/m]
  double preload = 0;                                // N_0 [N]

  static LuGreLaw typical() { return {}; }

  int n_states() const { return 1; }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const T v = radius * in.rate[free], z = in.state[0];
    out.state_rate[0] = v - bristle_stiffness * divide(abs(v), coefficient(v)) * z;                     // (3.12)
    const T friction = load(in) * (bristle_stiffness * z + bristle_damping * out.state_rate[0] + viscous * v);
    out.force[free] = -radius * friction;                                                              // (3.13)
    out.loss = friction * v;
  }
  /// Slipping bristles are bent all the way; those of a joint at rest carry nothing. Below the Stribeck speed it is a share of both:
  /// a start has speeds of no meaning that are not quite zero.
  void rest(const LawInput<double>& in, double* state) const {
    const double v = radius * in.rate[free];
    state[0] = v / std::max(std::abs(v), stribeck) * coefficient(v) / bristle_stiffness;
  }
  double lever() const { return free == 2 ? radius : 0; }
  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 2> pin{{{"friction", "N*m", "moment of friction on the second body"}, {"friction_power", "W", "power that friction turns into heat"}}};
    static const std::array<LawColumn, 2> slide{{{"friction", "N", "force of friction on the second body, along the slide"}, {"friction_power", "W", "power that friction turns into heat"}}};
    return free == 2 ? pin : slide;
  }
  /// Nothing else acts in the direction that is left free.
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const {
    value[0] = force[free];
    value[1] = -force[free] * in.rate[free];
  }

 private:
  template <class T>
  T coefficient(const T& v) const {
    using namespace law_math;
    const T relative = (1 / stribeck) * v;
    return T(kinetic) + (stuck - kinetic) * exp(-(relative * relative));
  }
  template <class T>
  T load(const LawInput<T>& in) const {
    T square(0.0);
    for (int k = 0; k < 3; ++k) square += pressing[k] * (in.before[k] * in.before[k]);
    return T(preload) + law_math::sqrt(square);
  }
};

}  // namespace pintle

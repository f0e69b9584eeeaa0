// Dry friction in the free directions of a joint, by the LuGre model, with the joint's own reaction as the normal load. C. Canudas de Wit,
// H. Olsson, K. J. Astrom, P. Lischinsky, A new model for control of systems with friction, IEEE Trans. Automatic Control 40 (1995) 419-425.
//
//   z' = v - s_0 |v| / mu(v) z,                   mu(v) = mu_k + (mu_s - mu_k) exp(-(v / v_s)^2)     theory/joints Eq. (3.12)
//   F = N (s_0 z + s_1 z' + s_2 v)                against the slip, on the second body               Eq. (3.13)
//
// z is the deflection of the bristles [m], s_0 their stiffness per unit of load [1/m]: with the stiffness in N/m, z would grow
// without bound where the load vanishes. Steady slip gives F = N mu(v); at rest a load is carried by s_0 N z. The work of the
// bristles counts as lost, and as regained where they spring back, because their energy changes with the load.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "laws/friction/friction.h"
#include "laws/friction/stick_slip.h"

namespace pintle {

struct LuGreLaw : Friction {
  static constexpr std::string_view kWord = "lugre";
  double stribeck = 1e-3;         // v_s [m/s]
  double bristle_stiffness = 1e5;  // s_0 [1/m]
  double bristle_damping = 300;    // s_1 [s/m]; `viscous` is s_2

  static LuGreLaw typical() { return {}; }

  int n_states() const { return 1; }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const T v = slip(in), z = in.state[0];
    out.state_rate[0] = v - bristle_stiffness * divide(abs(v), coefficient(v)) * z;                               // (3.12)
    rub(load(in) * (bristle_stiffness * z + bristle_damping * out.state_rate[0] + viscous * v), v, out);          // (3.13)
  }
  /// The deflection in steady slip, below the Stribeck speed in proportion to the speed: at a start, speeds that should be zero are not quite zero. The bristles
  /// of a joint at rest carry nothing until set_stuck.
  void rest(const LawInput<double>& in, double* state) const {
    const double v = slip(in);
    state[0] = v / std::max(std::abs(v), stribeck) * coefficient(v) / bristle_stiffness;
  }
  /// For pins and slides at rest, as in CoulombLaw. Bristles that cannot hold their joint stay as set by rest().
  std::optional<Stiction> stiction(const double* state) const {
    if (normal > 0 || bristle_stiffness * std::abs(state[0]) >= kStill * static_coefficient) return {};
    return Stiction{free, radius * radius * StickSlip{}.stiffness};  // this stiffness serves to find the load; the bristles then receive the load, not the stretch
  }
  bool set_stuck(const LawInput<double>& in, double force, double* state) const {
    const double friction = -force / radius, N = load(in);
    if (!(std::abs(friction) < static_coefficient * N)) return false;
    state[0] = friction / (bristle_stiffness * N);
    return true;
  }

  std::span<const LawColumn> columns() const { return columns_with_mode(); }
  /// Bristles that could bend farther at this speed count as sticking.
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const {
    Friction::observe(in, force, value);
    value[2] = bristle_stiffness * std::abs(in.state[0]) < kBent * coefficient(slip(in)) ? 1 : 0;
  }

 private:
  static constexpr double kBent = 0.999;  // as a fraction of the deflection in steady slip: bristles bent this far slip
  static constexpr double kStill = 1e-3;  // as a fraction of the largest deflection: bristles bent no farther are those of a joint at rest

  template <class T>
  T coefficient(const T& v) const { return stribeck_coefficient(v, stribeck); }
};

}  // namespace pintle

// Coulomb's dry friction with stiction: a joint sticks, held by a spring and a damper in the direction that it leaves free, until friction cannot
// carry its load, and then slips against the kinetic friction. Where it changes over is a border, on which steps end.
//
//   sticking:  F = k_t z + c_t v,   z' = v     until |F| > mu_s N                         theory/joints Eq. (3.18)
//   slipping:  F = s mu_k N + mu_v N v         until s v < 0, s = +1 or -1                Eq. (3.19)
//
// The states are the stretch z of the spring [m] and the mode s, 0 while it sticks, which changes at borders only. z is integrated: as a difference of
// places of the size of a metre its rounding, times k_t, is a noise in the force that steps are refused for. Slip goes the way of the friction that
// broke; sticking begins where friction is continuous,
//   z = (F - c_t v) / k_t.                                                                Eq. (3.20)
// As everywhere here a stuck joint is no constraint but a direction held by a force law, which makes the forces of several of them unique.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "laws/friction/friction.h"

namespace pintle {

struct CoulombLaw : Friction {
  static constexpr std::string_view kWord = "coulomb";
  double stiffness = 1e8, damping = 3e3;  // k_t [N/m], c_t [N*s/m]

  static CoulombLaw typical() { return {}; }

  int n_states() const { return 2; }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const T v = slip(in), N = load(in), mode = in.state[1];
    const T sticks = T(0.5) - abs(mode);
    out.state_rate[0] = where_positive(sticks, v, T(0.0));                                                        // (3.18)
    rub(where_positive(sticks, held(in), mode * (kinetic * N) + viscous * (N * v)), v, out);                      // (3.19)
  }
  /// Slipping, or stuck with nothing on the spring. Slow speeds of a start have no meaning.
  void rest(const LawInput<double>& in, double* state) const {
    const double v = slip(in);
    state[0] = 0;
    state[1] = std::abs(v) < kStill ? 0 : v > 0 ? 1 : -1;
  }

  int n_borders() const { return 3; }
  /// What still holds; how far slip is from its end; how far from a slip the wrong way, which a break under a falling load may begin with.
  void borders(const LawInput<double>& in, double* value) const {
    const double mode = in.state[1], forward = mode * slip(in);
    value[0] = mode == 0 ? stuck * load(in) - std::abs(held(in)) + kUnloaded : 1;
    value[1] = mode == 0 ? 1 : forward + kCrossed;
    value[2] = mode == 0 ? 1 : forward + kStill;
  }
  std::array<int, 3> border_directions() const { return {-1, -1, -1}; }
  std::string_view border_name(int border, bool) const { return border == 0 ? "slips" : "sticks"; }
  void cross(int border, const LawInput<double>& in, double* state) const {
    if (border == 0) {
      state[1] = held(in) > 0 ? 1 : -1;
      return;
    }
    const double v = slip(in), N = load(in);
    state[0] = (state[1] * kinetic * N + viscous * N * v - damping * v) / stiffness;  // (3.20)
    state[1] = 0;
  }

  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 3> pin = with_mode(Friction{}), slide = with_mode(Friction{.free = 0});
    return free == 2 ? pin : slide;
  }
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const {
    Friction::observe(in, force, value);
    value[2] = in.state[1] == 0 ? 1 : 0;
  }

 private:
  static constexpr double kStill = 1e-6;     // [m/s]
  static constexpr double kCrossed = 1e-12;  // a speed that is not the rounding of zero [m/s]
  static constexpr double kUnloaded = 1e-12;  // a friction that breaks a joint on which nothing presses [N]

  template <class T>
  T held(const LawInput<T>& in) const { return stiffness * in.state[0] + damping * slip(in); }  // (3.18)

  static std::array<LawColumn, 3> with_mode(const Friction& friction) {
    const auto all = friction.columns();
    return {all[0], all[1], {"stuck", "", "1 while the joint sticks, 0 while it slips"}};
  }
};

}  // namespace pintle

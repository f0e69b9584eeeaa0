// Coulomb's dry friction with stiction along one line: surfaces stick, held by a spring and a damper, until friction cannot carry their load, and then
// slip against the kinetic friction. Where they change over is a border, on which steps end.
//
//   sticking:  F = k_t z + c_t v,   z' = v     until |F| > mu_s N                         theory/joints Eq. (3.18)
//   slipping:  F = s mu_k N + mu_v N v         until s v < 0, s = +1 or -1                Eq. (3.19)
//
// v is the slip, N what presses, F acts against the slip. The states are the stretch z of the spring [m] and the mode s, 0 while they stick, which
// changes at borders only. z is integrated: as a difference of places of the size of a metre its rounding, times k_t, is a noise in the force that steps
// are refused for. Slip goes the way of the friction that broke; sticking begins where friction is continuous,
//   z = (F - c_t v) / k_t.                                                                Eq. (3.20)
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "laws/law_math.h"

namespace pintle {

/// The friction, against the slip; what the spring stores, and what is lost beside it.
template <class T>
struct StickSlipForce {
  T friction, stretch_rate, energy, loss;  // [N], [m/s], [J], [W]
};

struct StickSlip {
  static constexpr int kStates = 2, kBorders = 3;
  static constexpr double kStill = 1e-6;  // a slip that counts as none [m/s]
  double kinetic = 0.1, static_coefficient = 0.15;     // mu_k, mu_s [-]
  double viscous = 0;                     // mu_v [s/m]
  double stiffness = 1e8, damping = 1e5;  // k_t [N/m], c_t [N*s/m]

  /// What the spring has stored is lost where they slip again, and given where they stick.
  template <class T>
  StickSlipForce<T> force(const T& v, const T& N, const T* state) const {
    using namespace law_math;
    const T mode = state[1], sticks = T(0.5) - abs(mode), none(0.0), slips = mode * (kinetic * N) + viscous * (N * v);
    StickSlipForce<T> f;
    f.stretch_rate = where_positive(sticks, v, none);                                                     // (3.18)
    f.friction = where_positive(sticks, held(v, state), slips);                                           // (3.19)
    f.energy = where_positive(sticks, (0.5 * stiffness) * (state[0] * state[0]), none);
    f.loss = where_positive(sticks, damping * (v * v), slips * v);
    return f;
  }
  static bool sticks(const double* state) { return state[1] == 0; }
  /// Slipping, or at rest in the mode given. Slow speeds of a start have no meaning: what sticks begins without friction, which surfaces on which nothing
  /// presses could not carry.
  void rest(double v, int mode_at_rest, double* state) const {
    state[1] = std::abs(v) < kStill ? mode_at_rest : v > 0 ? 1 : -1;
    state[0] = state[1] == 0 ? -damping * v / stiffness : 0;
  }
  /// Stuck under a friction; false where they cannot carry it.
  bool set_stuck(double friction, double N, double* state) const {
    if (!(std::abs(friction) < static_coefficient * N)) return false;
    state[0] = friction / stiffness;
    state[1] = 0;
    return true;
  }

  /// What still holds; how far slip is from its end; how far from a slip the wrong way, which a break under a falling load may begin with.
  void borders(double v, double N, const double* state, double* value) const {
    const double mode = state[1], forward = mode * v;
    value[0] = mode == 0 ? static_coefficient * N - std::abs(held(v, state)) + kUnloaded : 1;
    value[1] = mode == 0 ? 1 : forward + kCrossed;
    value[2] = mode == 0 ? 1 : forward + kStill;
  }
  static constexpr std::array<int, kBorders> kDirections{-1, -1, -1};
  static constexpr std::string_view border_name(int border) { return border == 0 ? "slips" : "sticks"; }
  /// Both ends of a slip may lie in one interval of time; the second one finds surfaces that stick.
  void cross(int border, double v, double N, double* state) const {
    if (border == 0) {
      state[1] = held(v, state) > 0 ? 1 : -1;
      return;
    }
    if (sticks(state)) return;
    state[0] = (state[1] * kinetic * N + viscous * N * v - damping * v) / stiffness;  // (3.20)
    state[1] = 0;
  }

 private:
  static constexpr double kCrossed = 1e-12;   // a speed that is not the rounding of zero [m/s]
  static constexpr double kUnloaded = 1e-12;  // a friction that breaks surfaces on which nothing presses [N]

  template <class T>
  T held(const T& v, const T* state) const { return stiffness * state[0] + damping * v; }  // (3.18)
};

}  // namespace pintle

// Coulomb's dry friction with stiction along one line: surfaces stick, held by a spring and a damper, until friction cannot carry their load, and then
// slip against the kinetic friction. Each transition is a border, at which steps end.
//
//   sticking:  F = k_t z + c_t v,   z' = v     until |F| > mu_s N                         theory/joints Eq. (3.18)
//   slipping:  F = s mu_k N + mu_v N v         until s v < 0, s = +1 or -1                Eq. (3.19)
//   rebounding: F = s mu_k N + mu_v N v, z' = v   until s F_sticking < mu_k N, or s v > 0      Eq. (3.23)
//
// When N falls, friction may break while the spring drives the bodies back, s v < 0. The surfaces then slip by the spring's loss of stretch beyond the
// bodies' return, and stick again when the spring force has fallen to the friction.
//
// v is the slip, N the normal load; F opposes the slip. The states are the stretch z of the spring [m] and the mode s, 0 while the surfaces stick and 2 s while they
// rebound, which changes at borders only. z is integrated: as a difference of positions of the order of a metre it would have rounding that, times k_t, is noise in the
// force for which steps are rejected. Slip goes in the direction of the friction that broke; sticking begins where friction is continuous,
//   z = (F - c_t v) / k_t.                                                                Eq. (3.20)
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "laws/law_math.h"

namespace pintle {

/// The friction, opposing the slip; the energy stored by the spring, and the remaining power, which is lost.
template <class T>
struct StickSlipForce {
  T friction, stretch_rate, energy, loss;  // [N], [m/s], [J], [W]
};

struct StickSlip {
  static constexpr int kStates = 2, kBorders = 3;
  static constexpr double kStill = 1e-6;  // a slip speed below which surfaces count as at rest [m/s]
  double kinetic = 0.1, static_coefficient = 0.15;     // mu_k, mu_s [-]
  double viscous = 0;                     // mu_v [s/m]
  double stiffness = 1e8, damping = 1e5;  // k_t [N/m], c_t [N*s/m]

  /// The stored energy of the spring is lost when the surfaces slip again, and supplied when they stick.
  template <class T>
  StickSlipForce<T> force(const T& v, const T& N, const T* state) const {
    using namespace law_math;
    const T size = abs(state[1]), sticks = T(0.5) - size, rebounds = size - T(1.5), none(0.0);
    const T slips = where_positive(state[1], T(1.0), T(-1.0)) * (kinetic * N) + viscous * (N * v), stored = (0.5 * stiffness) * (state[0] * state[0]);
    StickSlipForce<T> f;
    f.stretch_rate = where_positive(sticks, v, where_positive(rebounds, v, none));                        // (3.18), (3.23)
    f.friction = where_positive(sticks, held(v, state), slips);                                           // (3.19)
    f.energy = where_positive(sticks, stored, where_positive(rebounds, stored, none));
    f.loss = where_positive(sticks, damping * (v * v), where_positive(rebounds, (slips - stiffness * state[0]) * v, slips * v));
    return f;
  }
  static bool sticks(const double* state) { return state[1] == 0; }
  /// Slipping, or at rest in the given mode. Slow speeds at a start have no meaning: surfaces that stick begin without friction, which could not be
  /// carried without a normal load.
  void rest(double v, int mode_at_rest, double* state) const {
    state[1] = std::abs(v) < kStill ? mode_at_rest : v > 0 ? 1 : -1;
    state[0] = state[1] == 0 ? -damping * v / stiffness : 0;
  }
  /// Sets them stuck under a friction; false if they cannot carry it.
  bool set_stuck(double friction, double N, double* state) const {
    if (!(std::abs(friction) < static_coefficient * N)) return false;
    state[0] = friction / stiffness;
    state[1] = 0;
    return true;
  }

  /// Friction still in reserve; how far slip is from its end, or the spring of rebounding surfaces from the friction; how far these are from slipping forward.
  void borders(double v, double N, const double* state, double* value) const {
    const double way = direction(state), forward = way * v;
    value[0] = value[1] = value[2] = 1;
    if (sticks(state)) value[0] = static_coefficient * N - std::abs(held(v, state)) + friction_rounding_at_rest();
    else if (!rebounds(state)) value[1] = N > 0 ? forward + kCrossed : 1;  // without a normal load nothing would hold them
    else {
      value[1] = way * held(v, state) - kinetic * N;
      value[2] = kCrossed - forward;
    }
  }
  static constexpr std::array<int, kBorders> kDirections{-1, -1, -1};
  static constexpr std::string_view border_name(int border) { return border == 1 ? "sticks" : "slips"; }
  /// Both ends of a slip may lie in one time interval; the second then finds surfaces that stick.
  void cross(int border, double v, double N, double* state) const {
    if (border == 0) {
      const double way = held(v, state) > 0 ? 1 : -1;
      state[1] = way * v < -kCrossed ? 2 * way : way;
      return;
    }
    if (sticks(state)) return;
    if (border == 2) {
      state[1] = direction(state);
      return;
    }
    if (!rebounds(state)) state[0] = (state[1] * kinetic * N + viscous * N * v - damping * v) / stiffness;  // (3.20)
    state[1] = 0;
    if (breaks_away(v, N, state)) state[1] = v > 0 ? 1 : -1;  // the normal load vanished before they stuck
  }

 private:
  // Rounding of a friction that rest() has set to zero [N]: surfaces without a normal load stick until something pulls.
  double friction_rounding_at_rest() const { return std::numeric_limits<double>::min() + 4 * std::numeric_limits<double>::epsilon() * kStill * damping; }
  // Whether the friction exceeds what they carry by more than rounding.
  bool breaks_away(double v, double N, const double* state) const {
    const double carried = static_coefficient * N;
    return std::abs(held(v, state)) > carried + 4 * std::numeric_limits<double>::epsilon() * carried + friction_rounding_at_rest();
  }
  static bool rebounds(const double* state) { return std::abs(state[1]) > 1.5; }
  static double direction(const double* state) { return state[1] > 0 ? 1 : -1; }
  static constexpr double kCrossed = 1e-12;   // below this a speed is the rounding of zero [m/s]

  template <class T>
  T held(const T& v, const T* state) const { return stiffness * state[0] + damping * v; }  // (3.18)
};

}  // namespace pintle

// The trapezoidal rule, HHT-alpha and the generalised-alpha method: the weights of a step. theory/solvers section 3.
#pragma once

#include <array>

namespace pintle {

/// Weights of the old end of a step: of the accelerations and of the forces. theory/solvers Eqs. (3.1)-(3.3).
struct AlphaWeights {
  double accelerations = 0, forces = 0;

  static AlphaWeights trapezoidal() { return {}; }
  /// Hilber, Hughes and Taylor, -1/3 <= alpha <= 0.
  static AlphaWeights hht(double alpha) { return {0, -alpha}; }
  /// Chung and Hulbert, with the factor that very fast vibrations retain per step.
  static AlphaWeights generalised(double radius) { return {(2 * radius - 1) / (radius + 1), radius / (radius + 1)}; }

  double gamma() const { return 0.5 - accelerations + forces; }
  double beta() const { return 0.25 * (0.5 + gamma()) * (0.5 + gamma()); }
  /// Offset of the time of the accelerations from the end of the step, as a fraction of it: earlier if negative.
  double lag() const { return accelerations - forces; }
  /// Error constants: a step adds this times h^3 q''' to the error of positions, and this times h^3 v''' to that of velocities.
  double position_error() const { return beta() + 0.5 * lag() - 1.0 / 6; }
  double velocity_error() const;

  /// The end of a step of h with accelerations a0 and a1 at its ends. Eq. (3.2).
  template <class X>
  X position(double h, const X& q, const X& v, const X& a0, const X& a1) const { return q + h * v + h * h * ((0.5 - beta()) * a0 + beta() * a1); }
  template <class X>
  X velocity(double h, const X& v, const X& a0, const X& a1) const { return v + h * ((1 - gamma()) * a0 + gamma() * a1); }
  /// The old acceleration for a step that is `share` times the previous one; `law` is that of the forces there. Eq. (3.7).
  template <class X>
  X lagged(double share, const X& a, const X& law) const { return share == 1 ? a : X(law + share * (a - law)); }

  /// A velocity and its acceleration at the last three times; `before` is earlier than `begin` by h_before, which is 0 if not known.
  struct Ends {
    double v_before, a_before, v_begin, a_begin, v_end, a_end;
  };
  /// The errors that a step of h adds to a position and to its velocity. Eqs. (3.5), (3.6).
  std::array<double, 2> local_errors(double h, double h_before, const Ends& x) const;
};

}  // namespace pintle

// A rolling bearing by the approximate formulas of A. Palmgren, Ball and Roller Bearing Engineering, Burbank 1959, as given by T. A. Harris,
// Rolling Bearing Analysis, Wiley (chapter on deflection): force proportional to a power n of the deflection, 3/2 for balls and 10/9 for rollers.
//
//   f = K d^n  against the deflection,   d = max(0, |e| - P/2)       of the bearing as a whole     theory/bearings Eq. (2.3)
//   f = -sum over j of K_1 d_j^n n_j,    d_j = max(0, n_j.e + d_0 - P/2)   of each rolling element   Eq. (2.4)
//   V = K d^(n+1) / (n+1)                                                                          Eq. (2.5)
//
// Damping acts where there is contact, along the deflection, and grows smoothly over the first `damping_depth` of it; a contact never
// pulls. Without play, the bearing as a whole is damped equally in all directions. Where surfaces part so fast that damping would pull,
// the remaining elastic power is lost.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "laws/law_math.h"
#include "laws/law_part.h"

namespace pintle {

struct RollingBearingLaw {
  static constexpr std::string_view kWord = "rolling-bearing";
  double stiffness = 2e8;       // K of the bearing as a whole, or K_1 of one element, > 0 [N/m^n]
  double exponent = 1;          // n >= 1 [-]
  double damping = 3500;        // of the bearing as a whole, or of one element, >= 0 [N*s/m]
  double play = 0;              // P, diametral, >= 0 [m]
  double interference = 0;      // d_0, deflection of each element in a centred bearing, >= 0 [m]
  double damping_depth = 1e-6;  // > 0 [m]
  double element_share = 0;     // load of the most loaded element over that of the bearing; 0: not known [-]
  std::vector<std::array<double, 2>> elements{};  // directions n_j, unit vectors in F's axes; none: the bearing as a whole

  static RollingBearingLaw typical() {
    RollingBearingLaw law{5e9, 1.5, 300, 2e-5, 0, 1e-6, 0, {}};
    for (int j = 0; j < 5; ++j) law.elements.push_back({std::cos(0.4 * j * M_PI), std::sin(0.4 * j * M_PI)});
    return law;
  }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    if (!elements.empty()) {
      for (const auto& n : elements) {
        const Contact<T> at = contact(n[0] * in.gap[0] + n[1] * in.gap[1] + T(interference - 0.5 * play), n[0] * in.rate[0] + n[1] * in.rate[1]);
        for (int k = 0; k < 2; ++k) out.force[k] -= n[k] * at.force;                                       // (2.4)
        out.energy += at.energy;
        out.loss += at.loss;
      }
      return;
    }
    const T r = sqrt(in.gap[0] * in.gap[0] + in.gap[1] * in.gap[1]);
    if (play == 0) {
      const T secant = where_positive(r, divide(stiffness * pow(r, exponent), r), T(exponent == 1 ? stiffness : 0));
      for (int k = 0; k < 2; ++k) {
        out.force[k] = -(secant * in.gap[k] + damping * in.rate[k]);                                       // (2.3)
        out.loss += damping * (in.rate[k] * in.rate[k]);
      }
      out.energy = stiffness / (exponent + 1) * pow(r, exponent + 1);                                      // (2.5)
      return;
    }
    const T n[2] = {unit(in.gap[0], r), unit(in.gap[1], r)};
    const Contact<T> at = contact(r - T(0.5 * play), n[0] * in.rate[0] + n[1] * in.rate[1]);
    for (int k = 0; k < 2; ++k) out.force[k] = -(at.force * n[k]);                                         // (2.3)
    out.energy = at.energy;
    out.loss = at.loss;
  }

  int n_borders() const { return elements.empty() ? (play > 0 ? 1 : 0) : static_cast<int>(elements.size()); }
  /// Positive where a contact presses.
  void borders(const LawInput<double>& in, double* value) const {
    if (elements.empty() && play > 0) {
      const double r = std::hypot(in.gap[0], in.gap[1]);
      value[0] = pressing(r - 0.5 * play, r > 0 ? (in.gap[0] * in.rate[0] + in.gap[1] * in.rate[1]) / r : 0);
    }
    for (std::size_t j = 0; j < elements.size(); ++j) {
      const auto& n = elements[j];
      value[j] = pressing(n[0] * in.gap[0] + n[1] * in.gap[1] + interference - 0.5 * play, n[0] * in.rate[0] + n[1] * in.rate[1]);
    }
  }
  /// The tangent at a deflection of 10 micrometres.
  Planar::Vec engaged_stiffness() const {
    const double k = exponent * stiffness * std::pow(1e-5, exponent - 1) * (elements.empty() ? 1.0 : 0.5 * static_cast<double>(elements.size()));
    return {k, k, 0};
  }
  std::span<const LawColumn> columns() const {
    static const std::array<LawColumn, 1> load{{{"element_load", "N", "force on the most loaded ball or roller"}}};
    return element_share > 0 ? std::span<const LawColumn>(load) : std::span<const LawColumn>{};
  }
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const {
    if (element_share == 0) return;
    value[0] = elements.empty() ? element_share * std::hypot(force[0], force[1]) : 0;
    for (const auto& n : elements) {
      const Contact<double> at = contact(n[0] * in.gap[0] + n[1] * in.gap[1] + interference - 0.5 * play, n[0] * in.rate[0] + n[1] * in.rate[1]);
      value[0] = std::max(value[0], element_share * at.force);
    }
  }

 private:
  template <class T>
  struct Contact {
    T force, energy, loss;
  };

  // One contact deflected by d, if that is positive, at the rate d'.
  template <class T>
  Contact<T> contact(const T& d, const T& rate) const {
    using namespace law_math;
    const T none(0.0), depth = where_positive(d, d, none), spring = stiffness * pow(depth, exponent), damper = damping * grown(depth) * rate;
    const T force = spring + damper;
    return {where_positive(d, where_positive(force, force, none), none), stiffness / (exponent + 1) * pow(depth, exponent + 1),
            where_positive(d, where_positive(force, damper * rate, -(spring * rate)), none)};
  }
  // Share of the damping: 0 at touch, 1 from damping_depth on. theory/bearings Eq. (2.6)
  template <class T>
  T grown(const T& depth) const {
    const T s = (1 / damping_depth) * depth;
    return law_math::where_positive(T(1.0) - s, s * s * (T(3.0) - 2 * s), T(1.0));
  }
  // Same sign as a contact's force, or as the deflection where there is no contact; its magnitude is that of a deflection.
  double pressing(double d, double rate) const {
    if (d <= 0) return d;
    return std::min(d, d + damping * grown(d) * rate / (stiffness * std::pow(d, exponent - 1)));
  }
  template <class T>
  static T unit(const T& x, const T& r) { return law_math::where_positive(r, law_math::divide(x, r), T(0.0)); }
};

}  // namespace pintle

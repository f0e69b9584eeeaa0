// The two chambers of a hydraulic or pneumatic cylinder: the areas of its piston, the pressures on them, and the resulting forces.
//
//   A_c = pi/4 D^2,   A_r = pi/4 (D^2 - d^2)                        theory/cylinders Eq. (1.2)
//   F = (p_c - p_0) A_c - (p_r - p_0) A_r                           Eq. (1.3)
//
// The pressures are functions of time, of the stroke x (gap component 0) and of its rate. The ambient pressure p_0 acts on all other surfaces.
#pragma once

#include <array>
#include <numbers>
#include <string_view>
#include <vector>

#include "laws/law_math.h"
#include "laws/law_numbers.h"
#include "pintle/expression.h"

namespace pintle {

/// The pressure in a chamber [Pa]: an expression of t, stroke and stroke_rate.
class ChamberPressure {
 public:
  static constexpr std::array<std::string_view, 3> kVariables{"t", "stroke", "stroke_rate"};
  /// Throws std::invalid_argument if it reads anything else.
  explicit ChamberPressure(Expression expression);

  template <class T>
  T at(const LawInput<T>& in) const {
    const T x[3] = {in.t, in.gap[0], in.rate[0]};
    T p[1];
    law_math::through(x, [this](const double (&plain)[3], bool) { return slopes(plain); }, p);
    return p[0];
  }
  int n_switches() const { return expression_.n_switches(); }
  void evaluate_switching_functions(const LawInput<double>& in, double* value) const;

 private:
  law_math::Slopes<3, 1> slopes(const double (&x)[3]) const;
  /// The values of its variables, in their order.
  std::array<double, 3> values(const double (&x)[3]) const;

  Expression expression_;
  std::vector<int> reads_;  // which entry of x each variable is
};

class Chambers {
 public:
  Chambers(double bore, double rod_diameter, double ambient, ChamberPressure cap, ChamberPressure rod);

  double cap_area() const { return std::numbers::pi / 4 * bore_ * bore_; }                                     // (1.2)
  double rod_area() const { return std::numbers::pi / 4 * (bore_ - rod_diameter_) * (bore_ + rod_diameter_); }  // (1.2)
  const ChamberPressure& cap() const { return cap_; }
  const ChamberPressure& rod() const { return rod_; }

  /// Forces on the piston due to the pressures above ambient, each pushing the piston away from its chamber [N].
  template <class T>
  T cap_force(const LawInput<T>& in) const { return cap_area() * over_ambient(cap_, in); }
  template <class T>
  T rod_force(const LawInput<T>& in) const { return rod_area() * over_ambient(rod_, in); }
  /// F, which pushes the ends of the cylinder apart.
  template <class T>
  T force(const LawInput<T>& in) const { return cap_force(in) - rod_force(in); }  // (1.3)
  /// What presses the seals against bore and rod, per unit area: |p_c - p_0| + |p_r - p_0|. Eq. (3.1)
  template <class T>
  T on_seals(const LawInput<T>& in) const { return law_math::abs(over_ambient(cap_, in)) + law_math::abs(over_ambient(rod_, in)); }

 private:
  template <class T>
  T over_ambient(const ChamberPressure& chamber, const LawInput<T>& in) const { return chamber.at(in) - T(ambient_); }

  double bore_, rod_diameter_;  // D, d [m]
  double ambient_;              // p_0 [Pa]
  ChamberPressure cap_, rod_;
};

}  // namespace pintle

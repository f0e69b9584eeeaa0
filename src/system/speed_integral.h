// The integral of a speed over time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pintle/expression.h"

namespace pintle {

/// Distance covered at a given speed, theory/joints Eq. (4.7): by Chebyshev polynomials on panels as short as the curve of the speed requires,
/// accurate to rounding.
class SpeedIntegral {
 public:
  /// `speed`: of t alone [rad/s or m/s]. Values beyond `duration` [s], above 0, are computed anew at every call.
  SpeedIntegral(Expression speed, double duration);

  /// Distance from time 0 to t, not below 0 [rad or m]. NaN where the speed is NaN.
  double integral_to(double t) const;
  std::size_t n_panels() const { return panels_.size(); }

 private:
  static constexpr int kPolynomialDegree = 16;  // on a panel: with 8 a sine takes 16 times as many panels, with 32 a ramp takes twice the time
  using Coefficients = std::array<double, kPolynomialDegree + 1>;
  struct Panel {
    double begin, end, before;                                // [s], and the integral up to the panel
    std::array<double, kPolynomialDegree + 2> coefficients;  // of the integral in it, 0 at its beginning
    double integral_to(double t) const;
  };

  Coefficients chebyshev_coefficients(double begin, double end) const;
  void append_panels(double begin, double end, std::vector<Panel>& panels) const;
  static Panel integrate_panel(double begin, double end, double before, const Coefficients& of_speed);

  Expression speed_;
  double duration_, largest_ = 0;  // [s]; a bound on the speed within it
  std::vector<Panel> panels_;
};

}  // namespace pintle

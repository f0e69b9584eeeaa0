// The way that a speed goes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pintle/expression.h"

namespace pintle {

/// The integral of a speed over time, theory/joints Eq. (4.7): from Chebyshev polynomials on stretches that are as short as the speed's curve asks for: to rounding.
class Travel {
 public:
  /// `speed`: of t alone [rad/s or m/s]. What lies beyond `duration` [s], above 0, is found anew whenever it is asked for.
  Travel(Expression speed, double duration);

  /// From time 0 to t, not below 0 [rad or m]. Not a number where the speed is none.
  double at(double t) const;
  std::size_t n_stretches() const { return stretches_.size(); }

 private:
  static constexpr int kDegree = 16;  // of the polynomial on a stretch
  using Values = std::array<double, kDegree + 1>;
  struct Stretch {
    double begin, end, before;                     // [s], and the way up to it
    std::array<double, kDegree + 2> coefficients;  // of the way in it, 0 at its begin
    double at(double t) const;
  };

  Values sample(double begin, double end) const;
  void add(double begin, double end, double rest_before, std::vector<Stretch>& to) const;
  static Stretch integrate(double begin, double end, double before, const Values& of_speed);

  Expression speed_;
  double duration_, largest_ = 0;  // [s]; a bound of the speed in it
  std::vector<Stretch> stretches_;
};

}  // namespace pintle

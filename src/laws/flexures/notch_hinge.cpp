#include "laws/flexures/notch_hinge.h"

#include <algorithm>
#include <cmath>

#include "laws/flexures/blade_basis.h"

namespace pintle {

// The integrands are steep within about the root of thickness times radius from the middle: panels are short there and double in length outwards.
NotchCompliance compliance_of(const NotchSize& size) {
  constexpr int kPoints = 16;
  constexpr double kShear = 1.2;  // for a rectangle
  static const GaussLegendre gauss(kPoints);
  const double a = size.semi_axis_x, b = size.semi_axis_y, half_pi = 2 * std::atan(1.0);
  double stretch = 0, bend = 0, bend_by_force = 0;  // integrals of 1/h, 1/h^3, x^2/h^3
  const double steep = std::min(half_pi, std::sqrt(size.thickness / b));
  for (double from = 0, to = steep; from < half_pi; from = to, to = std::min(half_pi, 2 * to)) {
    for (int q = 0; q < kPoints; ++q) {
      const double angle = from + 0.5 * (to - from) * (1 + gauss.x[q]), half_sine = std::sin(0.5 * angle);
      const double x = a * std::sin(angle), h = size.thickness + 4 * b * half_sine * half_sine;  // (3.4)
      const double dx = 2 * 0.5 * (to - from) * gauss.w[q] * a * std::cos(angle);                // both halves of the notch
      stretch += dx / h;
      bend += dx / (h * h * h);
      bend_by_force += dx * x * x / (h * h * h);
    }
  }
  return {stretch / (size.modulus * size.width), 12 * bend_by_force / (size.modulus * size.width) + kShear * stretch / (size.shear_modulus * size.width),
          12 * bend / (size.modulus * size.width)};                                              // (3.5), (3.6)
}

NotchHingeLaw NotchHingeLaw::of(const NotchSize& size, double damping_time) {
  const NotchCompliance compliance = compliance_of(size);
  const double radius = size.semi_axis_x * size.semi_axis_x / size.semi_axis_y;                  // of curvature, at the bottom of the notch
  const double concentration = std::pow(1 + size.thickness / (2 * radius), 0.45);                // (3.7)
  NotchHingeLaw law;
  law.k << 1 / compliance.axial, 1 / compliance.transverse, 1 / compliance.bending;
  law.damping_time = damping_time;
  law.stress_by_moment = concentration * 6 / (size.width * size.thickness * size.thickness);
  law.stress_by_force = 1 / (size.width * size.thickness);
  return law;
}

std::span<const LawColumn> NotchHingeLaw::columns() const {
  static const std::array<LawColumn, 1> kColumns{{{"bending_stress", "Pa", "largest elastic stress in the neck, of bending with the notch's concentration and of axial force"}}};
  return kColumns;
}

// Eq. (3.8).
void NotchHingeLaw::observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
  const double c = std::cos(0.5 * in.gap[2]), s = std::sin(0.5 * in.gap[2]);
  value[0] = stress_by_moment * k[2] * std::abs(in.gap[2]) + stress_by_force * k[0] * std::abs(c * in.gap[0] + s * in.gap[1]);
}

}  // namespace pintle

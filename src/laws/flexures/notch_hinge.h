// A notch hinge: two bodies joined by a neck between two circular or elliptic cut-outs. Both markers are at the middle of the neck, along its axis.
// Compliances after J. M. Paros and L. Weisbord, Machine Design 37 (1965) 151-156, without their approximations.
//
//   p = K (d + damping_time d'), d in axes that turn by half the angle      theory/flexures Eqs. (3.1), (3.2)
//   f = -(R p, ...), V = 1/2 d' K d + 1/2 k angle^2                         Eq. (3.3)
//
// The axes half-way between both bodies make the first and second body interchangeable.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "laws/law_math.h"
#include "laws/law_part.h"

namespace pintle {

struct NotchSize {
  double thickness = 0;                // least thickness of the neck [m]
  double semi_axis_x = 0, semi_axis_y = 0;  // of the cut-outs, along the neck and across it [m]
  double width = 0;                    // out of the plane [m]
  double modulus = 0, shear_modulus = 0;  // for bending and stretching; G [Pa]
};

/// Displacement per force along x and y and rotation per moment, all at the middle of the neck. Eqs. (3.4)-(3.6).
struct NotchCompliance {
  double axial = 0, transverse = 0;  // [m/N]
  double bending = 0;                // [rad/(N*m)]
};
NotchCompliance compliance_of(const NotchSize& size);

struct NotchHingeLaw {
  static constexpr std::string_view kWord = "notch-hinge";
  Planar::Vec k = Planar::Vec::Zero();  // along, across, turning [N/m, N/m, N*m/rad]
  double damping_time = 0;              // [s]
  double stress_by_moment = 0;          // with the notch's concentration [Pa/(N*m)]
  double stress_by_force = 0;           // [Pa/N]

  static NotchHingeLaw typical() { return {{4e6, 1e6, 40}, 1e-4, 1e7, 1e5}; }
  static NotchHingeLaw of(const NotchSize& size, double damping_time);

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const T c = cos(0.5 * in.gap[2]), s = sin(0.5 * in.gap[2]);
    const T x = c * in.gap[0] + s * in.gap[1], y = c * in.gap[1] - s * in.gap[0];                               // (3.1)
    const T half_spin = 0.5 * in.rate[2];
    const T vx = c * in.rate[0] + s * in.rate[1] + half_spin * y, vy = c * in.rate[1] - s * in.rate[0] - half_spin * x;
    const T px = k[0] * (x + damping_time * vx), py = k[1] * (y + damping_time * vy);                           // (3.2)
    out.force[0] = -(c * px - s * py);                                                                          // (3.3)
    out.force[1] = -(s * px + c * py);
    out.force[2] = 0.5 * (py * x - px * y) - k[2] * (in.gap[2] + damping_time * in.rate[2]);
    out.energy = 0.5 * (k[0] * (x * x) + k[1] * (y * y) + k[2] * (in.gap[2] * in.gap[2]));
    out.loss = damping_time * (k[0] * (vx * vx) + k[1] * (vy * vy) + k[2] * (in.rate[2] * in.rate[2]));
  }
  Planar::Vec engaged_stiffness() const { return k; }

  std::span<const LawColumn> columns() const;
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const;
};

}  // namespace pintle

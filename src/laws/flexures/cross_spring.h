// A cross-spring pivot: two equal leaf springs that cross. Both markers are where they cross, unloaded, and along the bisector of the two blades,
// which run from the first body to the second. theory/flexures Eqs. (4.1), (4.2).
#pragma once

#include <span>
#include <string_view>

#include "laws/flexures/leaf_spring.h"

namespace pintle {

struct CrossSpringLaw {
  static constexpr std::string_view kWord = "cross-spring";

  /// half_angle: of a blade against the bisector [rad]; crossing: the part of a blade between the first body and the crossing [-].
  CrossSpringLaw(const BladeSize& blade, double half_angle, double crossing);
  static CrossSpringLaw typical() { return {LeafSpringLaw::typical().size(), 0.7, 0.4}; }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    const T half = sin(0.5 * in.gap[2]), sine = sin(in.gap[2]), cosine = cos(in.gap[2]), less = 2.0 * (half * half);  // 1 - cosine
    for (const double side : {1.0, -1.0}) {
      const double ux = cos_, uy = side * sin_, qx = arm_ * ux, qy = arm_ * uy;  // along the blade; its end on the second body
      const T armx = qx * cosine - qy * sine, army = qx * sine + qy * cosine;
      const T dx = in.gap[0] - qx * less - qy * sine, dy = in.gap[1] + qx * sine - qy * less;                        // (4.1)
      const T vx = in.rate[0] - in.rate[2] * army, vy = in.rate[1] + in.rate[2] * armx;
      LawInput<T> end = in;
      end.gap[0] = ux * dx + uy * dy;
      end.gap[1] = ux * dy - uy * dx;
      end.rate[0] = ux * vx + uy * vy;
      end.rate[1] = ux * vy - uy * vx;
      LawOutput<T> blade;
      blade.clear();
      blade_.evaluate(end, blade);
      const T fx = ux * blade.force[0] - uy * blade.force[1], fy = uy * blade.force[0] + ux * blade.force[1];        // (4.2)
      out.force[0] += fx;
      out.force[1] += fy;
      out.force[2] += blade.force[2] + armx * fy - army * fx;
      out.energy += blade.energy;
      out.loss += blade.loss;
    }
  }
  Planar::Vec engaged_stiffness() const { return straight_; }

  int n_borders() const { return 1; }
  void borders(const LawInput<double>& in, double* value) const;
  static std::string_view border_name(int border, bool rising) { return LeafSpringLaw::border_name(border, rising); }
  std::span<const LawColumn> columns() const { return blade_.columns(); }
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const;

 private:
  /// The displacement of the end of the blade on this side, in its own axes.
  std::array<double, 3> end_of(double side, const double* gap) const;

  LeafSpringLaw blade_;
  double cos_, sin_, arm_;  // of the half angle; from the crossing to the ends on the second body [m]
  Planar::Vec straight_;
};

}  // namespace pintle

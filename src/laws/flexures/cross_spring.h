// A cross-spring pivot: two equal leaf springs that cross. In the unloaded state both markers are at the crossing, along the bisector of the two
// blades, which run from the first body to the second. theory/flexures Eqs. (4.1), (4.2).
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "laws/flexures/leaf_spring.h"

namespace pintle {

struct CrossSpringLaw {
  static constexpr std::string_view kWord = "cross-spring";

  /// half_angle: between a blade and the bisector [rad]; crossing: the fraction of a blade between the first body and the crossing [-].
  CrossSpringLaw(const BladeSize& blade, double half_angle, double crossing);
  static CrossSpringLaw typical() { return {LeafSpringLaw::typical().size(), 0.7, 0.4}; }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    for (const double side : {1.0, -1.0}) {
      const End<T> at = end_of(side, in.gap);
      const double ux = cos_, uy = side * sin_;  // along the blade
      const T vx = in.rate[0] - in.rate[2] * at.arm_y, vy = in.rate[1] + in.rate[2] * at.arm_x;
      LawInput<T> end = in;
      std::copy_n(at.gap, 3, end.gap);
      end.rate[0] = ux * vx + uy * vy;
      end.rate[1] = ux * vy - uy * vx;
      LawOutput<T> blade;
      blade.clear();
      blade_.evaluate(end, blade);
      const T fx = ux * blade.force[0] - uy * blade.force[1], fy = uy * blade.force[0] + ux * blade.force[1];        // (4.2)
      out.force[0] += fx;
      out.force[1] += fy;
      out.force[2] += blade.force[2] + at.arm_x * fy - at.arm_y * fx;
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
  /// The end of a blade on the second body: its displacement, in the axes of the blade, and its position relative to the second marker.
  template <class T>
  struct End {
    T gap[3];
    T arm_x, arm_y;  // [m]
  };
  template <class T>
  End<T> end_of(double side, const T* gap) const {
    using namespace law_math;
    const double ux = cos_, uy = side * sin_, qx = arm_ * ux, qy = arm_ * uy;
    const T half = sin(0.5 * gap[2]), sine = sin(gap[2]), cosine = cos(gap[2]), less = 2.0 * (half * half);  // 1 - cosine
    const T dx = gap[0] - qx * less - qy * sine, dy = gap[1] + qx * sine - qy * less;                                // (4.1)
    return {{ux * dx + uy * dy, ux * dy - uy * dx, gap[2]}, qx * cosine - qy * sine, qx * sine + qy * cosine};
  }
  LeafSpringLaw::Stress stress(double side, const double* gap) const { return blade_.stress(end_of(side, gap).gap); }

  LeafSpringLaw blade_;
  double cos_, sin_, arm_;  // of the half angle; from the crossing to the ends on the second body [m]
  Planar::Vec straight_;
};

}  // namespace pintle

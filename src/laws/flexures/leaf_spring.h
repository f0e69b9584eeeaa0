// A leaf spring: a uniform blade between the two markers, both along its axis, bent and stretched by any amount. Its own mass is neglected.
//
//   f = -dV/de - d(P/2)/de'                      theory/flexures Eqs. (2.8), (2.10)
//   V = least energy of the blade                Eq. (2.3)
//   P = damping_time times the square of the strain rates, weighted with their stiffness, >= 0       Eq. (2.11)
//
// e is counted from the unloaded position, where the second marker is at (length, 0) of the first. If no equilibrium is found that is
// connected with the straight blade (Eq. (2.9)), the law is that of small deflections, Eq. (2.13), and the column `equilibrium` is 0.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "laws/flexures/blade.h"
#include "laws/law_math.h"
#include "laws/law_part.h"

namespace pintle {

struct BladeSize {
  double length = 0, width = 0, thickness = 0;  // [m]
  double modulus = 0;                           // of a fibre [Pa]
  double shear_stiffness = 0;                   // GA of the section, 0: no shear deformation [N]
  double damping_time = 0;                      // stress per strain rate, over the modulus [s]

  double bending_stiffness() const;  // EI [N*m^2]
};

struct LeafSpringLaw {
  static constexpr std::string_view kWord = "leaf-spring";

  explicit LeafSpringLaw(const BladeSize& size);
  static LeafSpringLaw typical() { return LeafSpringLaw({1, 0.05, 0.1, 2e9, 3e6, 1e-2}); }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    T x[6], y[5];
    for (int k = 0; k < 3; ++k) {
      x[k] = in.gap[k];
      x[3 + k] = in.rate[k];
    }
    law_math::through(x, [this](const double* at, bool with_slopes) { return respond(at, with_slopes); }, y);
    for (int k = 0; k < 3; ++k) out.force[k] = y[k];
    out.energy = y[3];
    out.loss = y[4];
  }
  Planar::Vec engaged_stiffness() const { return straight_.diagonal(); }

  /// Positive where the blade has an equilibrium.
  int n_borders() const { return 1; }
  void borders(const LawInput<double>& in, double* value) const;
  static std::string_view border_name(int, bool rising) { return rising ? "equilibrium" : "no equilibrium"; }

  std::span<const LawColumn> columns() const;
  void observe(const LawInput<double>& in, const Planar::Vec& force, double* value) const;
  /// The largest stress from bending and stretching along the blade [Pa], and whether there is an equilibrium.
  struct Stress {
    double largest = 0;
    bool found = false;
  };
  Stress stress(const double* gap) const;
  const BladeSize& size() const { return size_; }

 private:
  /// Force on the second body, energy and loss as functions of gap and rate.
  law_math::Slopes<6, 5> respond(const double* at, bool with_slopes) const;
  law_math::Slopes<6, 5> respond_straight(const Eigen::Vector3d& gap, const Eigen::Vector3d& rate) const;
  Eigen::Vector3d without_dimension(const double* gap) const { return {gap[0] / size_.length, gap[1] / size_.length, gap[2]}; }

  BladeSize size_;
  Blade blade_;
  Planar::Vec units_;     // of forces [N, N, N*m]
  Planar::Mat straight_;  // stiffness of the unloaded blade
};

}  // namespace pintle

// A uniform blade clamped at both ends, bent and stretched by any amount: the static beam of Reissner (J. Applied Mathematics and Physics
// 23 (1972) 795-804), in numbers without dimension. Lengths are measured by the blade's, forces by EI/L^2, moments by EI/L, energies by EI/L.
// theory/flexures section 2.
#pragma once

#include <Eigen/Core>

#include "laws/flexures/blade_basis.h"

namespace pintle {

/// Slope angle of the blade, end forces.
struct BladeShape {
  int level = 0;                          // of BladeBasis
  double theta = 0;                       // slope at the far end [rad]
  double c[BladeBasis::kMost] = {};       // of the functions of the basis
  double n[2] = {};                       // force on the far end, along and across the unloaded blade
};

/// What the blade answers to a displacement of its far end (x, y, angle) from the unloaded place, and to its rate.
struct BladeAnswer {
  using Mat3 = Eigen::Matrix3d;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // that holds the far end there
  double energy = 0;
  Mat3 stiffness = Mat3::Zero();  // d(force)/d(displacement)
  Mat3 losses = Mat3::Zero();     // rate' losses rate is the square of the strains' rates, weighted with their stiffness
  Mat3 losses_turn = Mat3::Zero();  // column m: derivative by displacement m of (losses rate)
};

class Blade {
 public:
  /// EI/(EA L^2) and EI/(GA L^2); the latter 0 for a blade without shear.
  Blade(double axial_compliance, double shear_compliance);

  /// The equilibrium that is connected with the straight blade; false where none is found: Eq. (2.9).
  bool find(const Eigen::Vector3d& displacement, BladeShape& shape) const;
  /// At an equilibrium. `with_slopes`: losses_turn too.
  BladeAnswer answer(const BladeShape& shape, const Eigen::Vector3d& displacement, const Eigen::Vector3d& rate, bool with_slopes) const;
  /// The largest of |curvature| by `bending` plus |axial force| by `axial` along the blade.
  double largest(const BladeShape& shape, const Eigen::Vector3d& displacement, double bending, double axial) const;

 private:
  struct Work;
  void follow_slope(const BladeShape& shape, Work& work) const;
  void assemble(const BladeShape& shape, const Eigen::Vector3d& displacement, Work& work) const;
  bool is_stable(const Work& work) const;
  bool refine(const Eigen::Vector3d& displacement, BladeShape& shape, Work& work) const;
  bool solve(const Eigen::Vector3d& displacement, BladeShape& shape, Work& work) const;
  void find_losses(const Eigen::Vector3d& rate, bool with_slopes, const Work& work, BladeAnswer& out) const;

  double axial_, shear_;
};

}  // namespace pintle

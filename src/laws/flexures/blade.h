// A uniform blade clamped at both ends, bent and stretched by any amount: the static beam of Reissner (J. Applied Mathematics and Physics 23
// (1972) 795-804), in dimensionless form. Units are the blade's length for lengths, EI/L^2 for forces, EI/L for moments and EI/L for
// energies. theory/flexures section 2.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace pintle {

/// The response of the blade to a displacement of its far end (x, y, angle) from the unloaded position, and to its rate.
struct BladeAnswer {
  using Mat3 = Eigen::Matrix3d;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // force that holds the far end there
  double energy = 0;
  Mat3 stiffness = Mat3::Zero();  // d(force)/d(displacement)
  Mat3 losses = Mat3::Zero();     // rate' losses rate is the square of the strain rates, weighted with their stiffness
  Mat3 losses_turn = Mat3::Zero();  // column m: derivative by displacement m of (losses rate)
};

class Blade {
 public:
  /// EI/(EA L^2) and EI/(GA L^2); the latter 0 for a blade without shear.
  Blade(double axial_compliance, double shear_compliance);

  /// The response at the equilibrium that is connected with the straight blade, Eq. (2.9); nothing if none is found. `with_slopes`: losses_turn too.
  std::optional<BladeAnswer> answer(const Eigen::Vector3d& displacement, const Eigen::Vector3d& rate, bool with_slopes) const;
  /// The largest value along the blade of |curvature| times `bending` plus |axial force| times `axial`, at that equilibrium.
  std::optional<double> largest(const Eigen::Vector3d& displacement, double bending, double axial) const;
  bool has_equilibrium(const Eigen::Vector3d& displacement) const;

 private:
  double axial_, shear_;
};

}  // namespace pintle

#include "laws/flexures/leaf_spring.h"

#include <cmath>
#include <limits>
#include <optional>

namespace pintle {
namespace {

// EI/(EA L^2), EI/(GA L^2).
Blade blade_of(const BladeSize& size) {
  const double ratio = size.thickness / size.length;
  return {ratio * ratio / 12, size.shear_stiffness > 0 ? size.bending_stiffness() / (size.shear_stiffness * size.length * size.length) : 0};
}

}  // namespace

double BladeSize::bending_stiffness() const { return modulus * width * thickness * thickness * thickness / 12; }

LeafSpringLaw::LeafSpringLaw(const BladeSize& size) : size_(size), blade_(blade_of(size)) {
  const double EI = size.bending_stiffness(), L = size.length;
  units_ << EI / (L * L), EI / (L * L), EI / L;
  const Planar::Mat K = blade_.answer(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), false)->stiffness;
  straight_ = units_.asDiagonal() * K * Planar::Vec(1 / L, 1 / L, 1).asDiagonal();  // (2.13)
}

law_math::Slopes<6, 5> LeafSpringLaw::respond(const double* at, bool with_slopes) const {
  const Eigen::Vector3d gap(at[0], at[1], at[2]), rate(at[3], at[4], at[5]), displacement = without_dimension(at), velocity = without_dimension(at + 3);
  const std::optional<BladeAnswer> found = blade_.answer(displacement, velocity, with_slopes);
  if (!found) return respond_straight(gap, rate);
  const BladeAnswer& blade = *found;
  const double energy = size_.bending_stiffness() / size_.length, time = size_.damping_time;
  const Eigen::Vector3d lost = time * (blade.losses * velocity), force = -units_.cwiseProduct(blade.force + lost);  // (2.8), (2.10)
  const Eigen::Vector3d lengths(1 / size_.length, 1 / size_.length, 1);
  law_math::Slopes<6, 5> out;
  for (int k = 0; k < 3; ++k) out.value[k] = force[k];
  out.value[3] = energy * blade.energy;
  out.value[4] = energy * velocity.dot(lost);
  if (!with_slopes) return out;
  for (int m = 0; m < 3; ++m) {
    for (int k = 0; k < 3; ++k) {
      out.slope[k][m] = -units_[k] * lengths[m] * (blade.stiffness(k, m) + time * blade.losses_turn(k, m));
      out.slope[k][3 + m] = -units_[k] * lengths[m] * time * blade.losses(k, m);
    }
    out.slope[3][m] = units_[m] * blade.force[m];
    out.slope[4][m] = energy * lengths[m] * time * velocity.dot(blade.losses_turn.col(m));
    out.slope[4][3 + m] = 2 * units_[m] * lost[m];
  }
  return out;
}

// Eq. (2.13).
law_math::Slopes<6, 5> LeafSpringLaw::respond_straight(const Eigen::Vector3d& gap, const Eigen::Vector3d& rate) const {
  const Eigen::Vector3d elastic = straight_ * gap, lost = size_.damping_time * (straight_ * rate);
  law_math::Slopes<6, 5> out;
  out.value[3] = 0.5 * gap.dot(elastic);
  out.value[4] = rate.dot(lost);
  for (int k = 0; k < 3; ++k) {
    out.value[k] = -elastic[k] - lost[k];
    out.slope[3][k] = elastic[k];
    out.slope[4][3 + k] = 2 * lost[k];
    for (int m = 0; m < 3; ++m) {
      out.slope[k][m] = -straight_(k, m);
      out.slope[k][3 + m] = -size_.damping_time * straight_(k, m);
    }
  }
  return out;
}

void LeafSpringLaw::borders(const LawInput<double>& in, double* value) const {
  value[0] = blade_.has_equilibrium(without_dimension(in.gap)) ? 1 : -1;
}

std::span<const LawColumn> LeafSpringLaw::columns() const {
  static const std::array<LawColumn, 2> kColumns{{{"bending_stress", "Pa", "largest elastic stress in the blade, of bending and axial force together"},
                                                  {"equilibrium", "", "1; 0 where the blade has none and the force is that of small deflections"}}};
  return kColumns;
}

void LeafSpringLaw::observe(const LawInput<double>& in, const Planar::Vec&, double* value) const {
  const Stress now = stress(in.gap);
  value[0] = now.largest;
  value[1] = now.found ? 1 : 0;
}

// Eq. (2.14).
LeafSpringLaw::Stress LeafSpringLaw::stress(const double* gap) const {
  const double ratio = size_.thickness / size_.length;
  const std::optional<double> strain = blade_.largest(without_dimension(gap), 0.5 * ratio, ratio * ratio / 12);
  if (!strain) return {std::numeric_limits<double>::quiet_NaN(), false};
  return {size_.modulus * *strain, true};
}

}  // namespace pintle

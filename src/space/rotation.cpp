#include "space/rotation.h"

namespace pintle::rotation {

// Eq. (1.1).
Eigen::Quaterniond quaternion(const Eigen::Vector3d& turn) {
  const double square = turn.squaredNorm(), f = functions(0.25 * square).once, half = 0.5 * f;
  return {std::cos(0.5 * std::sqrt(square)), half * turn.x(), half * turn.y(), half * turn.z()};
}

// Eq. (1.3).
Eigen::Vector3d vector_of(const Eigen::Quaterniond& r) {
  const double sine = r.vec().norm();
  if (sine == 0) return Eigen::Vector3d::Zero();
  const double half = std::atan2(sine, std::abs(r.w()));
  return (r.w() < 0 ? -2 : 2) * half / sine * r.vec();
}

}  // namespace pintle::rotation

#include "space/spatial_pose.h"

namespace pintle {
namespace {

using S = Spatial;
using Matrix = Eigen::Matrix3d;

SpatialBodyView<double> view(const S::Motion& m) { return {components(m.p), components(m.R), components(m.v), components(m.w)}; }

Matrix matrix_of(const Matrix3<double>& R) {
  Matrix out;
  out << R.xx, R.xy, R.xz, R.yx, R.yy, R.yz, R.zx, R.zy, R.zz;
  return out;
}
// The matrix of the cross product a x .
Matrix crossing(const S::Point& a) {
  Matrix out;
  out << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return out;
}
// The derivative of k = 1 / (1 + n_z) by n_z; zero where k is limited.
double slope_of(double n_z, double k) { return 1 + n_z < rotation::kLeastOnePlusCosine ? 0 : -k * k; }

}  // namespace

SpatialRelativePose SpatialRelativePose::between(const S::Motion& A, const S::Frame& F, const S::Motion& B, const S::Frame& M) {
  SpatialRelativePose r;
  r.A = view(A);
  r.B = view(B);
  r.F = S::attachment(F);
  r.M = S::attachment(M);
  const auto g = SpatialPoseGeometry<double>::between(r.A, r.F, r.B, r.M);
  r.map = SpatialGapMap<double>::of(g);
  g.gaps(r.A, r.F, r.B, r.M, r.z);
  g.rates(r.A, r.B, r.rate);
  g.biases(r.bias);
  return r;
}

S::Point SpatialRelativePose::world_force(const S::Vec& f) const { return pintle::world_force(map, f); }
S::Point SpatialRelativePose::world_couple(const S::Vec& f) const { return pintle::world_couple(map, f); }
Eigen::Matrix<double, 12, 12> SpatialRelativePose::geometric(const S::Vec& f) const { return geometric_stiffness(map, f); }

S::Point world_force(const SpatialGapMap<double>& map, const S::Vec& f) { return vector_of(map.RF * Vector3<double>{f[0], f[1], f[2]}); }
S::Point world_couple(const SpatialGapMap<double>& map, const S::Vec& f) { return vector_of(map.RF * couple_of(map.n, map.k, f[3], f[4], f[5])); }

// Eqs. (3.10), (3.11): the changes of force and couple in world axes, then those of the moments in the bodies' axes.
Eigen::Matrix<double, 12, 12> geometric_stiffness(const SpatialGapMap<double>& map, const S::Vec& f) {
  const Matrix RA = matrix_of(map.RA), RB = matrix_of(map.RB), RF = matrix_of(map.RF);
  const double x = map.n.x, y = map.n.y, slope = slope_of(map.n.z, map.k);
  Matrix D;
  D << map.k * f[5], 0, f[3] + slope * x * f[5], 0, map.k * f[5], f[4] + slope * y * f[5], -f[3], -f[4], 0;
  const Matrix pull = crossing(world_force(map, f)), E = -RF * (D * crossing(vector_of(map.n))) * RF.transpose();
  const Matrix b = crossing(vector_of(map.arm_b));
  const Matrix of_b = RB.transpose() * (b * pull + crossing(world_couple(map, f)) + E);
  const Matrix turned_force = pull * RA, arm = RA.transpose() * pull;
  Eigen::Matrix<double, 12, 12> N = Eigen::Matrix<double, 12, 12>::Zero();
  N.block<3, 3>(0, 3) = turned_force;
  N.block<3, 3>(6, 3) = -turned_force;
  N.block<3, 3>(3, 0) = -arm;
  N.block<3, 3>(3, 6) = arm;
  N.block<3, 3>(3, 3) = RA.transpose() * (pull * crossing(vector_of(map.arm_a)) + E) * RA;
  N.block<3, 3>(3, 9) = -RA.transpose() * (pull * b + E) * RB;
  N.block<3, 3>(9, 3) = -of_b * RA;
  N.block<3, 3>(9, 9) = of_b * RB;
  return N;
}

// Eqs. (3.12), (3.13).
Eigen::Matrix<double, 6, 12> SpatialRelativePose::rate_gradient(const S::Motion&, const S::Motion&) const {
  const Matrix RA = matrix_of(map.RA), RB = matrix_of(map.RB), to_F = matrix_of(map.RF).transpose();
  const S::Point wA = pintle::vector_of(A.w), wB = pintle::vector_of(B.w), w = to_F * (wB - wA);
  const S::Point arm_a = pintle::vector_of(map.arm_a), arm_b = pintle::vector_of(map.arm_b), spin_b = wB.cross(arm_b);
  const S::Point at_M = pintle::vector_of(B.v - A.v) + spin_b - wA.cross(arm_a);
  const Matrix spin_a = to_F * crossing(wA);
  const auto [x, y, cosine] = map.n;
  const double k = map.k;
  Matrix J, H;
  J << cosine, 0, -x, 0, cosine, -y, k * x, k * y, 1;
  H << -w.z(), 0, w.x(), 0, -w.z(), w.y(), k * w.x(), k * w.y(), slope_of(cosine, k) * (x * w.x() + y * w.y());
  const Matrix turning = -(J * to_F * crossing(wB) + H * crossing(pintle::vector_of(map.n)) * to_F);
  Eigen::Matrix<double, 6, 12> gradient = Eigen::Matrix<double, 6, 12>::Zero();
  gradient.block<3, 3>(0, 0) = spin_a;
  gradient.block<3, 3>(0, 6) = -spin_a;
  gradient.block<3, 3>(0, 3) = to_F * (crossing(at_M) - crossing(arm_a) * crossing(wA)) * RA;
  gradient.block<3, 3>(0, 9) = (spin_a * crossing(arm_b) - to_F * crossing(spin_b)) * RB;
  gradient.block<3, 3>(3, 3) = -turning * RA;
  gradient.block<3, 3>(3, 9) = turning * RB;
  return gradient;
}

}  // namespace pintle

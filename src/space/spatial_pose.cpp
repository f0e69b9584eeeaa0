#include "space/spatial_pose.h"

namespace pintle {
namespace {

using S = Spatial;
using Both = Dual<2 * S::kDof>;  // derivatives by increments of both bodies

SpatialBodyView<double> view(const S::Motion& m) { return {components(m.p), components(m.R), components(m.v), components(m.w)}; }

Both variable(double value, int i) { return Both::variable(value, i); }

Matrix3<Both> constant(const Matrix3<double>& R) {
  return {Both(R.xx), Both(R.xy), Both(R.xz), Both(R.yx), Both(R.yy), Both(R.yz), Both(R.zx), Both(R.zy), Both(R.zz)};
}
SpatialFrame<Both> constant(const SpatialFrame<double>& F) { return {{Both(F.p.x), Both(F.p.y), Both(F.p.z)}, constant(F.R)}; }

// A body displaced by increments that are the variables from number `first` on; its velocities in its own axes stay.
SpatialBodyView<Both> displaced(const SpatialBodyView<double>& body, int first) {
  const Both x = variable(0, first + 3), y = variable(0, first + 4), z = variable(0, first + 5), one(1.0);
  const Matrix3<Both> turn{one, -z, y, z, one, -x, -y, x, one};  // to first order, all that derivatives see
  const Vector3<double> spin = turned_back(body.R, body.w);
  SpatialBodyView<Both> to;
  to.p = {variable(body.p.x, first), variable(body.p.y, first + 1), variable(body.p.z, first + 2)};
  to.R = constant(body.R) * turn;
  to.v = {Both(body.v.x), Both(body.v.y), Both(body.v.z)};
  to.w = to.R * Vector3<Both>{Both(spin.x), Both(spin.y), Both(spin.z)};
  return to;
}

SpatialPoseGeometry<Both> displaced(const SpatialRelativePose& pose) {
  return SpatialPoseGeometry<Both>::between(displaced(pose.A, 0), constant(pose.F), displaced(pose.B, S::kDof), constant(pose.M));
}

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

S::Point SpatialRelativePose::world_couple(const S::Vec& f) const {
  return pintle::vector_of(map.RF * couple_of(map.n, map.k, f[3], f[4], f[5]));
}

Eigen::Matrix<double, 12, 12> SpatialRelativePose::geometric(const S::Vec& f) const {
  const auto at = SpatialGapMap<Both>::of(displaced(*this));
  std::array<Both, S::kDof> force, on_a{}, on_b{};
  for (int k = 0; k < S::kDof; ++k) force[k] = Both(f[k]);
  at.push(force.data(), on_a, on_b);
  Eigen::Matrix<double, 12, 12> N;
  for (int k = 0; k < S::kDof; ++k)
    for (int c = 0; c < 2 * S::kDof; ++c) {
      N(k, c) = on_a[k].d[c];
      N(S::kDof + k, c) = on_b[k].d[c];
    }
  return N;
}

Eigen::Matrix<double, 6, 12> SpatialRelativePose::rate_gradient(const S::Motion&, const S::Motion&) const {
  std::array<Both, S::kDof> by;
  const auto g = displaced(*this);
  g.rates(A, B, by);
  Eigen::Matrix<double, 6, 12> gradient;
  for (int k = 0; k < S::kDof; ++k)
    for (int c = 0; c < 2 * S::kDof; ++c) gradient(k, c) = by[k].d[c];
  return gradient;
}

}  // namespace pintle

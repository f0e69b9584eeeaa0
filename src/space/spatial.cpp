#include "space/spatial.h"

namespace pintle {

void Spatial::move(Coordinates& q, const Vec& dq) {
  q.p += dq.head<3>();
  q.r = (q.r * rotation::quaternion(dq.tail<3>())).normalized();
}

Spatial::Vec Spatial::difference(const Coordinates& q1, const Coordinates& q0) {
  Vec d;
  d << q1.p - q0.p, rotation::vector_of(q0.r.conjugate() * q1.r);
  return d;
}

Spatial::Vec Spatial::rate_of_increment(const Vec& dq, const Vec& v) {
  const Vector3<double> turn{dq[3], dq[4], dq[5]}, w{v[3], v[4], v[5]};
  const auto rate = rotation::rate(turn, w, rotation::functions(rotation::square_of(turn)).inverse);
  Vec r;
  r << v.head<3>(), rate.x, rate.y, rate.z;
  return r;
}

bool Spatial::is_finite(const Coordinates& q) { return q.p.allFinite() && q.r.coeffs().allFinite(); }

Spatial::Motion Spatial::Motion::of(const Coordinates& q, const Vec& v) {
  Motion m;
  m.p = q.p;
  m.R = q.r.toRotationMatrix();
  m.set_velocity(v);
  return m;
}

void Spatial::Motion::set_velocity(const Vec& x) {
  v = x.head<3>();
  w_body = x.tail<3>();
  w = R * w_body;
}

Spatial::Point Spatial::Motion::turned(const Point& r) const { return R * r; }

Spatial::Vec Spatial::Motion::wrench(const Point& force, const Point& couple, const Point& r) const {
  Vec f;
  f << force, R.transpose() * (couple + r.cross(force));
  return f;
}

// By the shortest rotation of z onto the axis; for -z, of all half turns the one about x.
Spatial::Frame Spatial::Frame::along(const Point& p, const Point& axis) {
  const double across = std::hypot(axis.x(), axis.y());
  if (across == 0) return {p, axis.z() < 0 ? Eigen::Matrix3d(Point(1, -1, -1).asDiagonal()) : Eigen::Matrix3d::Identity()};
  const double half = 0.5 * std::atan2(across, axis.z()), sine = std::sin(half) / across;
  return {p, Eigen::Quaterniond(std::cos(half), -sine * axis.y(), sine * axis.x(), 0).toRotationMatrix()};
}

}  // namespace pintle

// The plane: three degrees of freedom a body, (x, y, angle) of its centre of mass; rotations add.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace pintle {

struct Planar {
  static constexpr int kDof = 3;                         // degrees of freedom of a free body
  using Vec = Eigen::Matrix<double, kDof, 1>;            // (x, y, angle) [m, m, rad], or their rates, or (fx, fy, moment)
  using Mat = Eigen::Matrix<double, kDof, kDof>;
  using Point = Eigen::Vector2d;                         // [m]

  // Turned by a right angle: J r.
  static Point perp(const Point& r) { return {-r.y(), r.x()}; }
  static double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

  // Where a body is and how it moves, in world axes.
  struct Motion {
    Point p = Point::Zero();  // centre of mass [m]
    double angle = 0;         // [rad]
    double c = 1, s = 0;      // its cosine and sine
    Point v = Point::Zero();  // [m/s]
    double w = 0;             // [rad/s]

    static Motion of(const Vec& q, const Vec& v) {
      return {{q[0], q[1]}, q[2], std::cos(q[2]), std::sin(q[2]), {v[0], v[1]}, v[2]};
    }
    Point turned(const Point& r) const { return {c * r.x() - s * r.y(), s * r.x() + c * r.y()}; }
  };

  // A frame fixed in a body: where its origin is [m] and how its x axis is turned [rad], in body axes.
  struct Frame {
    Point p = Point::Zero();
    double angle = 0;
    double c = 1, s = 0;

    static Frame at(const Point& p, double angle) { return {p, angle, std::cos(angle), std::sin(angle)}; }
  };
};

}  // namespace pintle

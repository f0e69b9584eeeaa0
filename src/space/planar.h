// The plane: three degrees of freedom a body, (x, y, angle) of its centre of mass; rotations add.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace pintle {

template <class T>
struct PlanarPoseGeometry;
template <class T>
struct PlanarGapMap;
struct PlanarRelativePose;
template <int N>
struct PlanarBodyLanes;

struct Planar {
  static constexpr int kDof = 3;                         // degrees of freedom of a free body, and components of a relative pose
  static constexpr int kDim = 2;                         // number of translations, which come first; the others are rotations
  static constexpr int kTurn = 2;                        // component of a relative pose about the joint's axis
  static constexpr bool kCurved = false;                 // rotations add: coordinates are increments
  static constexpr bool kGyroscopic = false;             // a constant mass matrix and the velocity alone cause no force
  using Vec = Eigen::Matrix<double, kDof, 1>;            // (x, y, angle) [m, m, rad], or their rates, or (fx, fy, moment)
  using Mat = Eigen::Matrix<double, kDof, kDof>;
  using Point = Eigen::Vector2d;                         // [m]
  using Coordinates = Vec;                               // where a body is

  template <class T>
  using PoseGeometry = PlanarPoseGeometry<T>;
  template <class T>
  using GapMap = PlanarGapMap<T>;
  using RelativePose = PlanarRelativePose;
  template <int N>
  using BodyLanes = PlanarBodyLanes<N>;

  // Turned by a right angle: J r.
  static Point perp(const Point& r) { return {-r.y(), r.x()}; }
  static double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

  static Coordinates at_origin() { return Vec::Zero(); }
  static Coordinates moved(const Coordinates& q, const Vec& dq) { return q + dq; }
  static void move(Coordinates& q, const Vec& dq) { q += dq; }
  // What moves q0 to q1.
  static Vec difference(const Coordinates& q1, const Coordinates& q0) { return q1 - q0; }
  // The rate of an increment dq from the configuration in which velocities are measured.
  static Vec rate_of_increment(const Vec&, const Vec& v) { return v; }
  static Point position(const Coordinates& q) { return q.head<2>(); }
  static bool is_finite(const Coordinates& q) { return q.allFinite(); }
  // Adds the whole turns that bring a relative pose nearest to `reference`: in the plane angles count turns already.
  static void count_turns(const Vec&, Vec&) {}

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
    // The same position with other velocities.
    void set_velocity(const Vec& x) {
      v = x.head<2>();
      w = x[2];
    }
    Point turned(const Point& r) const { return {c * r.x() - s * r.y(), s * r.x() + c * r.y()}; }
    // A force and a couple on the body, in world axes, as a generalised force at its centre of mass; r: from there to the point where the force acts.
    Vec wrench(const Point& force, double couple, const Point& r) const { return {force.x(), force.y(), couple + cross(r, force)}; }
  };

  // A frame fixed in a body: position of its origin [m] and angle of its x axis [rad], in body axes.
  struct Frame {
    Point p = Point::Zero();
    double angle = 0;
    double c = 1, s = 0;

    static Frame at(const Point& p, double angle) { return {p, angle, std::cos(angle), std::sin(angle)}; }
  };

  // The part of a frame that PoseGeometry needs.
  struct AttachmentFrame {
    Point p = Point::Zero();
    double c = 1, s = 0;
  };
  static AttachmentFrame attachment(const Frame& F) { return {F.p, F.c, F.s}; }
};

}  // namespace pintle

// Space: six degrees of freedom per body, the position of its centre of mass in world axes and an orientation, which is advanced on
// the group of rotations. Angular velocities and moments are in body axes, along which the inertia is diagonal. theory/space. Matrix
// products are in the .cpp: nearly every other source includes this header.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "space/rotation.h"

/// Code that is instantiated for bodies in space, and left out of a program with planar mechanisms only.
#ifdef PINTLE_PLANAR_ONLY
#define PINTLE_IN_SPACE(...)
#else
#define PINTLE_IN_SPACE(...) __VA_ARGS__
#endif

namespace pintle {

template <class T>
struct SpatialPoseGeometry;
template <class T>
struct SpatialGapMap;
struct SpatialRelativePose;
template <int N>
struct SpatialBodyLanes;

/// A frame on a body in the form PoseGeometry needs.
template <class T>
struct SpatialFrame {
  Vector3<T> p;
  Matrix3<T> R;
};

struct Spatial {
  static constexpr int kDof = 6;               // degrees of freedom of a free body, and components of a relative pose
  static constexpr int kDim = 3;               // number of translations, which come first; the others are rotations
  static constexpr int kTurn = 5;              // component of a relative pose about the joint's axis
  static constexpr bool kCurved = true;        // rotations do not add: an increment is not a difference of coordinates
  static constexpr bool kGyroscopic = true;    // the velocity of a spinning body alone causes moments
  using Vec = Eigen::Matrix<double, kDof, 1>;  // (velocity in world axes, angular velocity in body axes) [m/s, rad/s], or (force, moment)
  using Mat = Eigen::Matrix<double, kDof, kDof>;
  using Point = Eigen::Vector3d;               // [m]

  /// Where a body is.
  struct Coordinates {
    Point p = Point::Zero();                                    // centre of mass, world axes [m]
    Eigen::Quaterniond r = Eigen::Quaterniond::Identity();      // from body axes to the world's
  };

  template <class T>
  using PoseGeometry = SpatialPoseGeometry<T>;
  template <class T>
  using GapMap = SpatialGapMap<T>;
  using RelativePose = SpatialRelativePose;
  template <int N>
  using BodyLanes = SpatialBodyLanes<N>;

  static Coordinates at_origin() { return {}; }
  /// dq: displacement in world axes, rotation vector in body axes. theory/space Eq. (1.1).
  static void move(Coordinates& q, const Vec& dq);
  static Coordinates moved(const Coordinates& q, const Vec& dq) {
    Coordinates to = q;
    move(to, dq);
    return to;
  }
  /// The increment that moves q0 to q1, by at most half a turn.
  static Vec difference(const Coordinates& q1, const Coordinates& q0);
  /// The rate of an increment dq from the configuration in which the velocity v is measured. Eq. (1.4).
  static Vec rate_of_increment(const Vec& dq, const Vec& v);
  static const Point& position(const Coordinates& q) { return q.p; }
  static bool is_finite(const Coordinates& q);
  /// Adds the whole turns about the joint's axis that bring the pose nearest to `reference`.
  static void count_turns(const Vec& reference, Vec& z) {
    constexpr double turn = 2 * std::numbers::pi;
    z[kTurn] += turn * std::round((reference[kTurn] - z[kTurn]) / turn);
  }

  /// Where a body is and how it moves.
  struct Motion {
    Point p = Point::Zero();                             // centre of mass [m]
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();     // body axes in the world
    Point v = Point::Zero();                             // [m/s]
    Point w = Point::Zero();                             // angular velocity, world axes [rad/s]
    Point w_body = Point::Zero();                        // in body axes

    static Motion of(const Coordinates& q, const Vec& v);
    void set_velocity(const Vec& x);
    Point turned(const Point& r) const;
    /// A force and a couple on the body, in world axes, as a generalised force at its centre of mass; r: from there to the point where the force acts.
    Vec wrench(const Point& force, const Point& couple, const Point& r) const;
  };

  /// A frame fixed in a body: its origin [m] and its axes, in body axes. A joint's axis is the z axis of its frames.
  struct Frame {
    Point p = Point::Zero();
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();

    static Frame at(const Point& p, const Eigen::Matrix3d& R) { return {p, R}; }
    /// A frame whose z axis is along `axis`, which need not have length one. Throws nothing: a zero axis counts as z.
    static Frame along(const Point& p, const Point& axis);
  };

  using AttachmentFrame = SpatialFrame<double>;
  static AttachmentFrame attachment(const Frame& F) { return {components(F.p), components(F.R)}; }
};

}  // namespace pintle

// Positions of bodies in a row of a run, and at instants between rows.
#pragma once

#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

#include "report/scene.h"

namespace pintle {

/// The pose of a body's axes: their origin, and the cosine and sine of their angle.
struct Pose {
  double x = 0, y = 0, c = 1, s = 0;
  Vec2 world(Vec2 p) const { return {x + c * p[0] - s * p[1], y + s * p[0] + c * p[1]}; }
  Vec2 local(Vec2 p) const { return {c * (p[0] - x) + s * (p[1] - y), -s * (p[0] - x) + c * (p[1] - y)}; }
  Vec2 turned(Vec2 d) const { return {c * d[0] - s * d[1], s * d[0] + c * d[1]}; }
};

/// The position of a spot, given the poses of its bodies.
inline Vec2 place_of(const MovingPoint& spot, const Pose& at, const Pose& toward) {
  const Vec2 a = at.world(spot.at.point), b = toward.world(spot.toward.point), off = toward.turned(spot.off);
  return {a[0] + spot.share * (b[0] - a[0]) + off[0], a[1] + spot.share * (b[1] - a[1]) + off[1]};
}

Pose pose_of(const BodyTrack& track, const Trajectory& trajectory, std::size_t row);

/// Everything that moves, at one instant.
struct Instant {
  double t = 0;
  std::vector<Pose> poses;   ///< per body of the scene
  std::vector<Vec2> forces;  ///< per arrow of the scene [N]
  std::vector<Vec2> loads;   ///< per load of the scene, world axes [N]

  /// The identity for kWorld.
  Pose pose(int body) const { return body == kWorld ? Pose{} : poses[static_cast<std::size_t>(body)]; }
  Vec2 place(const Anchor& anchor) const { return pose(anchor.body).world(anchor.point); }
  /// The direction of its axis in the world, of length 1.
  Vec2 along(const Anchor& anchor) const { return pose(anchor.body).turned({std::cos(anchor.axis), std::sin(anchor.axis)}); }
  Vec2 place(const MovingPoint& spot) const { return place_of(spot, pose(spot.at.body), pose(spot.toward.body)); }
};

/// At time t [s], interpolated linearly between the neighbouring rows. The trajectory has at least one row.
Instant instant_at(const Scene& scene, const Trajectory& trajectory, double t);

/// Maps names of columns to their indices.
class ColumnIndex {
 public:
  explicit ColumnIndex(const std::vector<Column>& columns);
  int find(const std::string& name) const;  ///< -1: not found

 private:
  std::unordered_map<std::string, int> places_;
};

}  // namespace pintle

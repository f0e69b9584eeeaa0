// What is measured of a run: joint forces and the position of one point at given times, and the difference of two such sets.
#pragma once

#include <vector>

#include "system/state.h"

namespace pintle::bench {

/// `count` times after the start, equally spaced, the last one at the end.
std::vector<double> output_times(double duration, int count);

/// A point of a body, relative to its centre of mass in body axes [m]. No body: no point is followed.
struct FollowedPoint {
  int body = kGround;
  Planar::Point at = Planar::Point::Zero();
};

class Samples {
 public:
  explicit Samples(const System& system, FollowedPoint point = {}) : system_(&system), point_(point) {}

  /// World force [N] and couple [N*m] of every joint; `force` is the joints' own, conjugate to their gaps.
  void add(const Vecs& q, const Vecs& v, const Vecs& force);
  /// The same with the forces from the laws at q, v.
  void add_by_laws(double t, const Vecs& q, const Vecs& v);
  /// Given loads: fx, fy, couple of every joint.
  void add_loads(const std::vector<double>& loads);
  /// The point's position in the world [m].
  void add_place(const Planar::Point& p) { places_.push_back(p); }

  bool has_forces() const { return rows_ > 0; }
  bool has_places() const { return !places_.empty(); }
  const std::vector<Planar::Point>& places() const { return places_; }

  /// The largest difference of any joint's force, relative to that joint's peak in `reference`; NaN without forces [-].
  double error(const Samples& reference) const;
  /// The largest distance of the point from its position in `reference`, and the distance at the end [m].
  double place_error(const Samples& reference) const;
  double end_error(const Samples& reference) const;
  double largest_force() const;

 private:
  std::vector<double> peaks() const;
  const double* at(std::size_t row, int joint) const { return &values_[3 * (row * system_->joints.size() + joint)]; }

  const System* system_;
  FollowedPoint point_;
  std::size_t rows_ = 0;
  std::vector<double> values_;  // per row, per joint: fx, fy, couple
  std::vector<Planar::Point> places_;
  std::vector<Planar::Motion> motions_;
  Vecs force_;
};

}  // namespace pintle::bench

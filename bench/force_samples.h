// Joint forces at given times, and how far two sets of them are apart.
#pragma once

#include <vector>

#include "system/state.h"

namespace pintle::bench {

/// `count` times after the start, evenly spaced, the last one the end.
std::vector<double> output_times(double duration, int count);

class ForceSamples {
 public:
  explicit ForceSamples(const System& system) : system_(&system) {}

  /// World force [N] and couple [N*m] of every joint; `force` is the joints' own, conjugate to their gaps.
  void add(double t, const Vecs& q, const Vecs& v, const Vecs& force);
  /// The same with the forces that the laws give at q, v.
  void add_by_laws(double t, const Vecs& q, const Vecs& v);
  /// The same with the loads as they are: fx, fy, couple of every joint.
  void add_loads(const std::vector<double>& loads);

  /// The largest difference of any joint's force, over that joint's peak in `reference`.
  double error(const ForceSamples& reference) const;
  double largest_force() const;

 private:
  std::vector<double> peaks() const;
  const double* at(std::size_t row, int joint) const { return &values_[3 * (row * system_->joints.size() + joint)]; }

  const System* system_;
  std::size_t rows_ = 0;
  std::vector<double> values_;  // per row, per joint: fx, fy, couple
  std::vector<Planar::Motion> motions_;
  Vecs force_;
};

}  // namespace pintle::bench

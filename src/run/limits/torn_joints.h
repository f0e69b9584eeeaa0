// Tells the user of joints that have deflected by a considerable part of the mechanism's size, as no machine does. theory/limits section 3.
#pragma once

#include <string>
#include <vector>

#include "pintle/trajectory.h"
#include "system/state.h"

namespace pintle {

/// How far forces deflect joints, relative to the mechanism's size.
template <class S>
class BasicDeflectionScale {
 public:
  BasicDeflectionScale() = default;
  BasicDeflectionScale(const BasicSystem<S>& system, const BasicState<S>& start);
  /// The deflection of joint j by a force [N], as a fraction of the size; 0 for motors, ideal joints, and joints so soft that they are meant to deflect.
  double of(std::size_t j, double force) const { return force * compliance_[j] / size_; }
  double size() const { return size_; }  // [m]

 private:
  double size_ = 0;
  std::vector<double> compliance_;  // [m/N]
};

/// A note on the joint that its peak force has torn open farthest; empty if there is none. `joints` are those of a finished run that began at `start`.
template <class S>
std::string note_on_torn_joint(const BasicSystem<S>& system, const BasicState<S>& start, const std::vector<LoadSummary>& joints);

}  // namespace pintle

// The largest effort of every drive during a run, and the positions of the bodies when it had grown most of the way there: after the
// run these are checked for a limit.
#pragma once

#include <cmath>
#include <vector>

#include "system/state.h"

namespace pintle {

/// The peak effort of a servo, or of what drives the length of a joint.
template <class S>
struct DrivePeak {
  int joint = 0;                        // index in the system
  double effort = 0, lag = 0, t = 0;    // the largest absolute value; the drive's gap then; and when
  double seen = 0, t_seen = 0;          // effort for which the positions are known, and when
  PositionsOf<S> q;                     // the positions then
};

template <class S>
class BasicDrivePeaks {
 public:
  explicit BasicDrivePeaks(const BasicSystem<S>& system) {
    for (int j = 0; j < system.n_joints(); ++j)
      if (system.joints[j].driven >= 0) components_.push_back(system.joints[j].driven), peaks_.push_back({.joint = j, .q = {}});
  }
  /// Call at the end of each step.
  void see(const BasicState<S>& state) {
    for (std::size_t i = 0; i < peaks_.size(); ++i) {
      DrivePeak<S>& peak = peaks_[i];
      const double effort = std::abs(state.force[peak.joint][components_[i]]);
      if (!(effort > peak.effort)) continue;
      peak.effort = effort;
      peak.lag = state.gap[peak.joint][components_[i]];
      peak.t = state.t;
      if (effort < kGrown * peak.seen) continue;
      peak.seen = effort;
      peak.t_seen = state.t;
      peak.q = state.q;
    }
  }
  const std::vector<DrivePeak<S>>& all() const { return peaks_; }

 private:
  static constexpr double kGrown = 1.25;  // positions are copied again when the effort has grown by this factor: seldom

  std::vector<int> components_;  // of the gaps
  std::vector<DrivePeak<S>> peaks_;
};

}  // namespace pintle

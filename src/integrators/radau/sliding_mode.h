// Sliding modes of motors: the effort jumps and drives the motion back from both sides, as dry friction does at rest. A
// run would cross such a jump forever (chattering), so it is held at the jump, on a steep ramp between the efforts of
// both sides. theory/time section 7.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "system/state.h"

namespace pintle {

/// Remembers the jump that was crossed last.
template <class S>
class BasicChatteringDetector {
 public:
  /// Call after each crossing, with the instants before and after: the jump if it has been crossed again within `soon`.
  std::optional<SlidingMode> crossed(const BasicSystem<S>& system, double t0, const std::vector<typename S::Motion>& m0, double t1,
                                  const std::vector<typename S::Motion>& m1, double soon);
  void forget() { last_.reset(); }

 private:
  std::optional<SlidingMode> last_;
  double t_ = 0;
};
using ChatteringDetector = BasicChatteringDetector<Planar>;

/// Releases the jumps whose ramps have been left; true if there was one.
template <class S>
bool leave_sliding(const BasicSystem<S>& system, double t, const std::vector<typename S::Motion>& m, std::vector<SlidingMode>& sliding);

/// How steep a ramp may be.
struct RampSize {
  double time;    // in which a jump's effort moves its argument across the ramp [s]
  double margin;  // smallest width, for the rounding of velocities
};
/// `next_step`: the first step after the jump [s].
template <class S>
RampSize ramp_size(const BasicSystem<S>& system, const SlidingMode& jump, const BasicState<S>& state, double next_step, double tolerance);

/// Holds `jump` if the efforts of its sides drive its argument back towards it, at the share of both that keeps the argument
/// constant. `balance()` renews accelerations for what is in `sliding`, `rate()` is then that of the argument, now `margin`.
template <class Balance, class Rate>
bool enter_sliding(const SlidingMode& jump, double margin, const RampSize& size, std::vector<SlidingMode>& sliding, const Balance& balance,
               const Rate& rate) {
  sliding.push_back(jump);
  Expression::Ramp& ramp = sliding.back().ramp;
  double pull[2];
  for (const int side : {0, 1}) {
    ramp.share = side;
    balance();
    pull[side] = rate();
  }
  const double against = pull[0] - pull[1];
  const bool meet = pull[0] > 0 && pull[1] < 0;
  if (meet) {
    ramp.share = pull[0] / against;
    ramp.slope = 1 / std::max(size.time * against, size.margin);
    ramp.at = margin;
  } else {
    sliding.pop_back();
  }
  balance();
  return meet;
}

}  // namespace pintle

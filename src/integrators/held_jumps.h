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
class JumpWatch {
 public:
  /// Call after each crossing, with the instants before and after it: the jump that has been crossed again within `soon`.
  std::optional<HeldJump> crossed(const System& system, double t0, const std::vector<Planar::Motion>& m0, double t1,
                                  const std::vector<Planar::Motion>& m1, double soon);
  void forget() { last_.reset(); }

 private:
  std::optional<HeldJump> last_;
  double t_ = 0;
};

/// Lets go of the jumps whose ramps have been left; true if there was one.
bool release_jumps(const System& system, double t, const std::vector<Planar::Motion>& m, std::vector<HeldJump>& held);

/// How steep a ramp may be.
struct RampSize {
  double time;    // in which a jump's effort brings its argument over the ramp [s]
  double margin;  // the least width, for the rounding of velocities
};
RampSize ramp_size(const System& system, const HeldJump& jump, const State& state, double usual_step, double tolerance);

/// Holds `jump` if the efforts of its sides drive its argument towards each other's, at the share of them that leaves it where it
/// is. `balance()` renews the accelerations for what is in `held`, `rate()` is then that of the argument, now `margin`.
template <class Balance, class Rate>
bool hold_jump(const HeldJump& jump, double margin, const RampSize& size, std::vector<HeldJump>& held, const Balance& balance,
               const Rate& rate) {
  held.push_back(jump);
  Expression::Ramp& ramp = held.back().ramp;
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
    held.pop_back();
  }
  balance();
  return meet;
}

}  // namespace pintle

// Vibrations that the forces make grow and that the steps damp instead: friction that falls with the sliding speed, or couples a joint's directions, excites joints,
// and a method that damps what its steps do not resolve shows a smooth motion, in all passes alike. theory/time section 6.3.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

/// A mode whose growth was suppressed.
struct SuppressedMode {
  double rate = 0;       // of its growth, where it is largest [1/s]
  double frequency = 0;  // absolute value of the eigenvalue there [rad/s]
  double from = 0;       // when it begins to grow [s]
};

/// The longest step that follows it [s].
double longest_following_step(const SuppressedMode& mode);
/// What a run of this duration [s] says of it. `followed`: its steps were made short enough to follow it, and this changed the forces.
std::string note_on_suppressed(const SuppressedMode& mode, double duration, bool followed);

template <class S>
class BasicSuppressedInstability {
 public:
  /// Watches runs of this duration [s] if a force of the system may feed vibrations.
  BasicSuppressedInstability(const BasicSystem<S>& system, double duration);
  /// Call before another pass.
  void reset();
  /// Call after a step of h seconds that ended in `now`, by Radau IIA with so many stages.
  void see_step(const BasicState<S>& now, double h, int stages);
  /// The mode that would have grown fastest, if some would have grown by more than a factor of e during the pass.
  std::optional<SuppressedMode> growing_mode() const;

 private:
  // The longest step in a part of the run.
  struct Look {
    BasicState<S> end;
    double h = 0;
    int stages = 0;
  };
  // The rate and the eigenvalue's size of the mode that grows fastest although the step damps it; a rate of 0: there is none.
  SuppressedMode fastest_suppressed_mode(const Look& look) const;

  const BasicSystem<S>* system_;
  double part_ = 0;          // length of a part of the run [s]
  std::vector<Look> looks_;  // one for each part; empty: not watched
};

}  // namespace pintle

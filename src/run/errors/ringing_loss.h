// Ringing that long steps take off the joints. Vibrations smaller than the tolerance of the steps die out in all passes in the same way, whereas the true
// force goes on ringing if the joint itself damps less. theory/time Eqs. (6.11), (6.12).
#pragma once

#include <vector>

#include "integrators/radau/step_nodes.h"
#include "run/record/force_table.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicRingingLoss {
 public:
  /// For a run from `start`, with the masses BasicEffectiveMasses::closed at the start if they are known; all must outlive this object.
  BasicRingingLoss(const BasicSystem<S>& system, const BasicState<S>& start, const VecsOf<S>* effective_mass = nullptr);
  /// Call before another pass.
  void reset();

  /// Call after a step of h seconds.
  void see_step(const BasicStepNodes<S>& nodes, double h);
  int n_steps() const { return n_steps_; }
  /// Other joints also carry the forces that a joint's vibrations cause. Adds what they lack of these, for joints that have lost more than this force [N] or couple [N*m] themselves; with the forces' distribution at the start.
  void add_transmitted(double least_force, double least_couple);
  /// The largest force that joint j has lacked so far for lost ringing [N], and the largest couple [N*m].
  double force(std::size_t j) const { return linear_magnitude<S>(most_lost_[j]); }
  double couple(std::size_t j) const { return angular_magnitude<S>(most_lost_[j]); }

 private:
  void find_masses();

  const BasicSystem<S>* system_;
  const BasicState<S>* start_;
  const VecsOf<S>* known_mass_;
  VecsOf<S> mass_, damping_, stiffness_, decay_;  // effective mass of each component; its law at the start; the rate at which the joint damps its own vibration [1/s]; empty before the first step
  int n_steps_ = 0;
  VecsOf<S> lost_, most_lost_;  // at the last step, and the largest so far [N], [N*m]
};

}  // namespace pintle

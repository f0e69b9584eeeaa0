// What long steps take off the vibrations of the joints: a ringing that is smaller than the tolerance of the steps dies in all passes alike, and where the
// joint damps it less the true force goes on ringing. theory/time Eqs. (6.11), (6.12).
#pragma once

#include <vector>

#include "integrators/radau/step_nodes.h"
#include "run/record/force_table.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicRingingLoss {
 public:
  /// Of a run from `start`, with the masses BasicEffectiveMasses::closed there where they are known; all must outlive it.
  BasicRingingLoss(const BasicSystem<S>& system, const BasicState<S>& start, const VecsOf<S>* effective_mass = nullptr);
  /// Before another pass.
  void start_again();

  /// A step of h seconds has been made.
  void see_step(const BasicStepNodes<S>& nodes, double h);
  int n_steps() const { return n_steps_; }
  /// Joints carry what other joints' vibrations accelerate: adds to each what it lacks with those that have lost more than this force [N] or couple [N*m] of their own, as forces are at the start.
  void add_transmitted(double least_force, double least_couple);
  /// The largest force by which joint j lacks ringing so far [N], and the largest couple [N*m].
  double force(std::size_t j) const { return linear_magnitude<S>(most_lost_[j]); }
  double couple(std::size_t j) const { return angular_magnitude<S>(most_lost_[j]); }

 private:
  void find_masses();

  const BasicSystem<S>* system_;
  const BasicState<S>* start_;
  const VecsOf<S>* known_mass_;
  VecsOf<S> mass_, damping_, stiffness_, decay_;  // what a component's force accelerates; its law at the start; the rate at which the joint damps its own vibration [1/s]; empty before the first step
  int n_steps_ = 0;
  VecsOf<S> lost_, most_lost_;  // at the last step, and so far [N], [N*m]
};

}  // namespace pintle

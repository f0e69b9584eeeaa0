// Records what a run needs of its states whatever the space: joint forces, energies, what rows miss; and summarises the load of every joint.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"
#include "run/record/drive_peaks.h"
#include "run/record/force_table.h"
#include "run/record/lost_equilibria.h"
#include "run/record/missed_peaks.h"
#include "run/record/stuck_joints.h"

namespace pintle {

enum class Recorded {
  kColumns,  ///< everything that a table shows of every row
  kForces,   ///< the joint forces only: summaries of the joints, no columns, springs, motors, energies
  kStates,   ///< joint forces and energies, and the places and velocities of the bodies
};

template <class S>
class BasicForceRecorder {
 public:
  BasicForceRecorder(const BasicSystem<S>& system, const SimulateSettings& settings, Recorded what);
  virtual ~BasicForceRecorder() = default;

  /// Adds a row. Called in the order of time.
  virtual void add(const BasicState<S>& state);
  /// The end of a step of h seconds, between rows or at one.
  void see_step(const BasicState<S>& state, double h) {
    if (what_ == Recorded::kForces) return;
    missed_peaks_.add_step(state, h);
    stuck_joints_.see(state);
    lost_equilibria_.see(state);
    drive_peaks_.see(state);
  }
  const std::vector<DrivePeak<S>>& drive_peaks() const { return drive_peaks_.all(); }
  /// Of the last row.
  const std::vector<typename S::Motion>& last_motions() const { return m_; }
  const BasicForceTable<S>& forces() const { return forces_; }
  BasicForceTable<S> take_forces() { return std::move(forces_); }
  /// Forgets what only the result shows.
  virtual void keep_forces_only();
  /// Summaries of the joints, the energy account, notes on what the rows miss.
  virtual void fill(Trajectory& trajectory);

 protected:
  struct Energies {
    double kinetic, potential, dissipated, supplied;  // [J]
  };

  const BasicSystem<S>& system_;
  Recorded what_;
  std::vector<typename S::Motion> m_;  // of the row
  BasicForceTable<S> forces_;
  std::vector<Energies> energies_;     // per row, unless only forces are recorded

 private:
  void add_energies(const BasicState<S>& state);
  void fill_account(EnergyAccount& account) const;

  bool keeps_places_;
  double output_step_;
  BasicMissedPeaks<S> missed_peaks_;
  BasicStuckJoints<S> stuck_joints_;
  BasicLostEquilibria<S> lost_equilibria_;
  BasicDrivePeaks<S> drive_peaks_;
};
using ForceRecorder = BasicForceRecorder<Planar>;

/// The name of a body, for results.
template <class S>
std::string body_name(const BasicSystem<S>& system, int body) { return body == kGround ? "ground" : system.bodies[body].name; }

}  // namespace pintle

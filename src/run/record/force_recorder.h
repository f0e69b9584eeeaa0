// Records what a run needs of its states, in the plane and in space: joint forces, energies, and the statistics of all loads, also between rows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"
#include "run/record/drive_peaks.h"
#include "run/record/force_table.h"
#include "run/record/load_statistics.h"
#include "run/record/edge_overruns.h"
#include "run/record/lost_equilibria.h"
#include "run/record/stuck_joints.h"
#include "run/record/wound_belts.h"

namespace pintle {

enum class Recorded {
  kColumns,  ///< everything that a table shows for every row
  kForces,   ///< only the joint forces: summaries of the joints, but no columns, springs, motors or energies
  kStates,   ///< joint forces and energies, and the velocities of the bodies
};

template <class S>
class BasicForceRecorder {
 public:
  BasicForceRecorder(const BasicSystem<S>& system, Recorded what);
  virtual ~BasicForceRecorder() = default;

  /// Starts a run and adds its first row.
  void start(const BasicState<S>& state, const LoadSampling& sampling);
  /// Adds a row. Call in order of time.
  virtual void add(const BasicState<S>& state);
  /// Call after each step.
  void see_step(BasicStepper<S>& stepper);
  /// Ends the run and adds its last row.
  void finish(const BasicStepper<S>& stepper);
  const std::vector<DrivePeak<S>>& drive_peaks() const { return drive_peaks_.all(); }
  /// Motions of the last row.
  const std::vector<typename S::Motion>& last_motions() const { return m_; }
  const BasicForceTable<S>& forces() const { return forces_; }
  BasicForceTable<S> take_forces() { return std::move(forces_); }
  /// Available once the run has started.
  const BasicLoadRecorder<S>& loads() const { return *loads_; }
  /// For each of the stepper's crossings, the heat of its joint up to then [J].
  const std::vector<double>& heat_at_crossings() const { return heat_at_crossings_; }
  /// Discards what only the final result needs.
  virtual void keep_forces_only();
  /// Fills in the summaries of the joints, the energy account and notes.
  virtual void fill(Trajectory& trajectory);

 protected:
  struct Energies {
    double kinetic, potential, dissipated, supplied;  // [J]
  };
  /// What is sampled in addition to the joint loads; nothing by default.
  virtual const typename BasicLoadRecorder<S>::Signals* signals() const { return nullptr; }

  const BasicSystem<S>& system_;
  Recorded what_;
  std::vector<typename S::Motion> m_;  // of the last row
  BasicForceTable<S> forces_;
  std::vector<Energies> energies_;     // per row, unless only forces are recorded

 private:
  void add_energies(const BasicState<S>& state);
  void fill_account(EnergyAccount& account) const;

  double step_ = 0;  // the last one [s]
  std::optional<BasicLoadRecorder<S>> loads_;  // from the start
  std::vector<double> heat_, heat_at_crossings_;  // of each joint over the run, and as above [J]
  BasicStuckJoints<S> stuck_joints_;
  BasicLostEquilibria<S> lost_equilibria_;
  std::string note_on_creeping_;
  BasicWoundBelts<S> wound_belts_;
  BasicEdgeOverruns<S> edge_overruns_;
  BasicDrivePeaks<S> drive_peaks_;
};
using ForceRecorder = BasicForceRecorder<Planar>;

/// The name of a body, for results.
template <class S>
std::string body_name(const BasicSystem<S>& system, int body) { return body == kGround ? "ground" : system.bodies[body].name; }

}  // namespace pintle

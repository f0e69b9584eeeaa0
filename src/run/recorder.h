// Records states as rows of a trajectory, and summarises the load of every joint, spring and motor.
#pragma once

#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"
#include "run/missed_peaks.h"
#include "run/recording.h"
#include "run/stuck_joints.h"
#include "system/state.h"

namespace pintle {

/// One integration's output: joint forces at the output times, for comparison with another integration.
struct ForceTable {
  std::vector<double> t;
  std::vector<double> place;  // row-major: per time, per body: x, y [m], angle [rad]; where the tolerance is of the motion
  std::vector<double> world;  // row-major: per time, per joint: fx, fy [N] (world axes), couple [N*m] on the second body
};

/// Force on the second body in world axes and the couple about the second marker.
struct JointLoad {
  double fx = 0, fy = 0, couple = 0;
};
JointLoad joint_load(const System& system, int j, double t, const std::vector<Planar::Motion>& m, const Planar::Vec& force);

/// True if the joint's law can pass on a couple.
bool transmits_couple(const JointData& joint);

enum class Recorded {
  kColumns,  ///< every column, every row
  kForces,   ///< the joint forces only: summaries of the joints, no columns, springs, motors, energies
};

class Recorder {
 public:
  Recorder(const Model& model, const System& system, Recorded what = Recorded::kColumns);

  /// Adds a row. Called in the order of time.
  void add(const State& state);
  /// The end of a step of h seconds, between rows or at one.
  void see_step(const State& state, double h) {
    if (what_ != Recorded::kColumns) return;
    missed_peaks_.add_step(state, h);
    stuck_joints_.see(state);
  }
  void clear();
  const ForceTable& forces() const { return forces_; }
  /// Of what is recorded.
  std::vector<Column> columns() const;
  /// Forgets the rows, keeps the forces.
  void keep_forces_only();
  /// Columns, values, summaries, notes on what is not in them. The rows change hands.
  void fill(Trajectory& trajectory);

 private:
  // What a motor is in the system: a servo among the joints, or a load.
  struct Drive {
    int joint, load;
  };
  int component(const Drive& d) const { return d.joint >= 0 ? system_.joints[d.joint].servo : system_.loads[d.load].component; }
  void find_drives();
  void put(double x) { values_.push_back(x); }
  void put_row(const State& state);
  void put_joint(int j, const JointLoad& load);

  const Model& model_;
  const System& system_;
  Recorded what_;
  std::vector<Drive> drives_;
  Recording recording_;
  std::vector<double> values_;
  ForceTable forces_;
  std::vector<Planar::Motion> m_;
  MissedPeaks missed_peaks_;
  StuckJoints stuck_joints_;
};

}  // namespace pintle

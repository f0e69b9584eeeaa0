// Turns states into the rows of a trajectory, and sums up what every joint, spring and motor carried.
#pragma once

#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"
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
  void clear();
  const ForceTable& forces() const { return forces_; }
  const std::vector<Column>& columns() const { return columns_; }
  /// The table without rows' owner changing hands: columns, values, summaries.
  void fill(Trajectory& trajectory) const;

 private:
  void make_columns();
  void put(double x) { values_.push_back(x); }
  void put_row(const State& state);
  void put_joint(int j, const State& state, const JointLoad& load);

  const Model& model_;
  const System& system_;
  Recorded what_;
  std::vector<Column> columns_;
  std::vector<double> values_;
  ForceTable forces_;
  std::vector<Planar::Motion> m_;
};

}  // namespace pintle

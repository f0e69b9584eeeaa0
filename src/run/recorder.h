// Records states of the plane as rows of a trajectory, and summarises the load of every joint, spring and motor.
#pragma once

#include <array>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"
#include "run/record/force_recorder.h"
#include "run/recording.h"

namespace pintle {

class Recorder final : public ForceRecorder, private LoadRecorder::Signals {
 public:
  Recorder(const Model& model, const System& system, Recorded what = Recorded::kColumns);

  void add(const State& state) override;
  /// The columns that are recorded.
  std::vector<Column> columns() const;
  void keep_forces_only() override;
  /// Fills in columns, values, summaries, and notes on what they omit. The rows are moved out.
  void fill(Trajectory& trajectory) override;

 private:
  // What a motor is in the system: a servo among the joints, or a load.
  struct Drive {
    int joint, load;
  };
  // An applied force of the model, by its index in the system: functions of time, or a load along each of its components; -1: none.
  struct Applied {
    int functions = -1;
    std::array<int, 3> load{-1, -1, -1};
    bool has_torque = false;
  };
  int component(const Drive& d) const { return d.joint >= 0 ? system_.joints[d.joint].servo : system_.loads[d.load].component; }
  void find_drives();
  void index_applied_forces();
  // Forces of springs, then effort and power of each motor.
  const Signals* signals() const override { return this; }
  int n_signals() const override { return static_cast<int>(springs_.size() + 2 * drives_.size()); }
  void put_signals(const State& state, const std::vector<Planar::Motion>& m, double* out) const override;
  double effort_of(const Drive& drive, const State& state, const std::vector<Planar::Motion>& m) const;
  double power_of(const Drive& drive, double effort, const std::vector<Planar::Motion>& m) const;
  double effort_of_spring(const LoadData& spring, double t, const std::vector<Planar::Motion>& m) const;
  void put(double x) { values_.push_back(x); }
  void put_row(const State& state);
  void put_joint(int j, const Planar::Vec& load);
  void put_applied_force(const Applied& force, const State& state);

  const Model& model_;
  std::vector<Drive> drives_;
  std::vector<int> springs_;  // among the loads, in the order of the model
  std::vector<Applied> applied_;
  Recording recording_;
  std::vector<double> values_;
};

}  // namespace pintle

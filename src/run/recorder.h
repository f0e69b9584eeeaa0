// Records states of the plane as rows of a trajectory, and summarises the load of every joint, spring and motor.
#pragma once

#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"
#include "run/record/force_recorder.h"
#include "run/recording.h"

namespace pintle {

class Recorder final : public ForceRecorder {
 public:
  Recorder(const Model& model, const System& system, Recorded what = Recorded::kColumns);

  void add(const State& state) override;
  /// Of what is recorded.
  std::vector<Column> columns() const;
  void keep_forces_only() override;
  /// Columns, values, summaries, notes on what is not in them. The rows change hands.
  void fill(Trajectory& trajectory) override;

 private:
  // What a motor is in the system: a servo among the joints, or a load.
  struct Drive {
    int joint, load;
  };
  int component(const Drive& d) const { return d.joint >= 0 ? system_.joints[d.joint].servo : system_.loads[d.load].component; }
  void find_drives();
  void put(double x) { values_.push_back(x); }
  void put_row(const State& state);
  void put_joint(int j, const Planar::Vec& load);

  const Model& model_;
  std::vector<Drive> drives_;
  Recording recording_;
  std::vector<double> values_;
};

}  // namespace pintle

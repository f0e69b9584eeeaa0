// The explicit Dormand-Prince pair over a joint tree: it integrates coordinates and rates, with the joints that remain force
// laws evaluated at the bodies' gaps. dopri5.h is the method for free bodies. theory/tree section 7.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "integrators/law_borders.h"
#include "integrators/relative/tree_projector.h"
#include "integrators/stepper.h"

namespace pintle {

class TreeDopri5 final : public Stepper {
 public:
  TreeDopri5(const System& system, double tolerance);

  void set_max_step(double h) override { max_step_ = h; }
  void set_load_scale(const LoadScale& scale) override { scale_ = scale; }
  const LoadScale& load_scale() const override { return scale_; }
  void start(const State& state, double h) override;
  bool step(double t_end) override;
  const State& state() const override { return end_state_; }
  const State& previous() const override { return begin_state_; }
  const State& interpolate(double t) override;
  const State& state_before_event() const override { return borders_.before_event(end_state_); }
  const Counters& counters() const override { return counters_; }
  const std::string& failure() const override { return failure_; }
  const std::vector<LawCrossing>& crossings() const override { return borders_.crossings(); }

 private:
  void complete(TreeState& state);  // gaps, forces and accelerations at t, y, u
  void write(TreeState& at, State& state);
  double error(double h);
  void raise_scale();

  const System& system_;
  LawBorders borders_;
  std::unique_ptr<JointTree> tree_;
  double tolerance_, max_step_ = 0, h_ = 0;
  TreeInstant at_;
  Eigen::MatrixXd mass_matrix_;
  Cholesky mass_;
  TreeState begin_, end_, before_event_, stage_;  // before_event_: the end before laws set their states there
  State begin_state_, end_state_, inside_state_;
  std::array<Eigen::VectorXd, 7> ky_, ku_;
  std::array<std::vector<double>, 7> kz_;  // rates of the laws' states
  LoadScale scale_;
  std::vector<double> rounding_;  // loads_above_rounding
  Counters counters_;
  std::string failure_;
};

}  // namespace pintle

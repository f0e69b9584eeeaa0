// The augmented Lagrangian in relative coordinates. Ideal joints form a tree, whose coordinates the trapezoidal rule or HHT
// integrates; multipliers and penalties close the loops, and rates and accelerations are projected. theory/penalty section 5.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "integrators/general/alpha_weights.h"
#include "integrators/general/forced_steps.h"
#include "integrators/general/usual_tolerance.h"
#include "integrators/relative/tree_instant.h"
#include "integrators/stepper.h"
#include "linalg/dense_factors.h"

namespace pintle {

class TreeAugmented final : public Stepper {
 public:
  /// `weights` without a weight for old accelerations: trapezoidal rule and HHT.
  TreeAugmented(const System& system, const AlphaWeights& weights, double tolerance);

  void set_max_step(double h) override { max_step_ = h; }
  void set_load_scale(const LoadScale&) override {}
  const LoadScale& load_scale() const override { return no_scale_; }
  void start(const State& state, double h) override;
  bool step(double t_end) override;
  const State& state() const override { return end_state_; }
  const State& previous() const override { return begin_state_; }
  const State& interpolate(double t) override;
  const Counters& counters() const override { return counters_; }
  const std::string& failure() const override { return failure_; }
  std::vector<std::string> remarks() const override;

 private:
  using Vector = Eigen::VectorXd;
  struct Row {  // constraint that closes a loop
    int law, component;
  };

  Eigen::Index index(const Row& row) const { return 3 * row.law + row.component; }
  void complete(TreeState& state, State& out);
  void find_law_forces(TreeState& state);
  bool factorize();
  Vector reactions_for(const Vector& missing) const;
  Vector missing(const Vector& open) const;
  bool project(double t, Vector& u, Vector& w);
  void begin_step(double h);
  bool solve(double h);
  double correct(double h);
  void add_tangents(double h);
  double error(double h);
  void finish(double t, double h);

  const System& system_;
  AlphaWeights weights_;
  UsualTolerance tolerance_;
  std::unique_ptr<JointTree> tree_;
  TreeInstant at_;
  std::vector<Row> rows_;
  double max_step_ = 0, h_ = 0, h_before_ = 0;
  // Projections: A H^-1 A' of the rows, scaled to a unit diagonal.
  Cholesky mass_, rows_matrix_;
  Eigen::MatrixXd A_, pull_;  // the rows' part of A; H^-1 A'
  Vector scale_;
  Lu lu_;
  Eigen::MatrixXd newton_;
  TreeState begin_, end_, trial_, inside_;
  Vector own_w_, law_w_, w_before_, u_before_;    // accelerations at the start: the method's own, those of the forces; at the previous start
  Vector w_begin_, w_lagged_before_;              // the same for this step
  Vector multipliers_, stiffness_;                // of rows
  double largest_y_ = 1, largest_u_ = 1, violation_ = 0;
  ForcedSteps forced_;
  State begin_state_, end_state_, inside_state_;
  LoadScale no_scale_;
  Counters counters_;
  std::string failure_;
};

}  // namespace pintle

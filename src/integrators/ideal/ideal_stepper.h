// Time integration with ideal joints: Dormand-Prince 5(4) on the accelerations from the multipliers, with positions and
// velocities projected onto the constraints after every step, theory/ideal section 2; or on those from penalties, without
// projection, theory/penalty section 1.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "integrators/bend_watch.h"
#include "integrators/dense/dense_output.h"
#include "integrators/ideal/ideal_equations.h"
#include "integrators/stepper.h"

namespace pintle {

class IdealStepper final : public Stepper {
 public:
  /// `equations`: kIdeal or kPenalty.
  IdealStepper(const System& system, double tolerance, Equations equations = Equations::kIdeal, const PenaltySettings& penalty = {});

  void set_max_step(double h) override { max_step_ = h; }
  void set_load_scale(const LoadScale& scale) override { scale_ = scale; }
  const LoadScale& load_scale() const override { return scale_; }
  void start(const State& state, double h) override;
  bool step(double t_end) override;
  const State& state() const override { return end_; }
  const State& previous() const override { return begin_; }
  const State& interpolate(double t) override;
  const Counters& counters() const override { return counters_; }
  const std::string& failure() const override { return failure_; }
  std::vector<std::string> remarks() const override;
  bool watches_bends() const override { return true; }
  double unbounded_reactions() const override { return unbounded_at_; }

 private:
  // Independence of the constraints, as a fraction of the largest met.
  static constexpr double kSuspicious = 0.5;  // above this no singular position is searched for
  static constexpr double kFewDigits = 3e-2;  // below this forces lose too many digits, in proportion to its fourth power

  bool take_stages(double h);
  bool evaluate_stages(double h);
  bool find_tangent();
  bool onto_branch();
  double step_around_singular_position(double h);
  bool is_too_near(double independence) const;
  bool is_near_singular_position() const;
  void keep_accurate();
  void look_for_unbounded_reactions();
  void interpolate_forces(State& state);
  bool onto_constraints(State& state);
  bool finish(double t, double h);
  double error(double h);
  double share_of_step(double h, double t_end);
  bool find_jump(double h);
  /// Position and velocity of stage s, from the rates of the stages before it; its constraints are not closed yet.
  void compute_stage_values(int s, double h, State& stage) const;
  void grow_scale();
  void foresee_loads(double h);
  void raise_above_rounding();
  void look_for_singular_position();
  void report_singular_position(double t);

  const System& system_;
  bool projects_;
  double tolerance_, max_step_ = 0, h_ = 0, usual_h_ = 0;  // the next step; the last one away from singular positions
  double smooth_h_ = 0;                                     // the last one accepted at the first attempt, or the first one proposed
  IdealEquations equations_;
  std::unique_ptr<IdealEquations> at_begin_;                // created when a singular position is near
  BendWatch bends_;
  std::vector<Planar::Motion> begin_m_, stage_m_;  // at the start of the step; at its end
  DenseOutput dense_;
  State begin_, end_, inside_, stage_;
  struct AccurateState {        // not near a singular position
    State state;
    double independence;
  };
  std::vector<AccurateState> accurate_;
  Vecs jerk_, branch_, error_q_, error_v_;  // of the bodies: at the start of the step; positions; errors as accelerations
  double unbounded_at_ = -1;                // [s]
  double clear_h_ = 0;                      // shortest step over the singular position ahead [s]
  bool closed_ = false;                     // the stages are closed
  std::array<Vecs, 7> kq_, kv_;
  std::array<std::array<double, 2>, 7> power_{};  // supplied, lost [W]
  LoadScale scale_;
  Counters counters_;
  std::string failure_;
  int jump_ = -1;            // the switching function for which a step was last shortened, ...
  double jump_t_ = -1;       // ... and when [s]
  std::vector<std::string> remarks_;
  double most_independent_ = 0, independence_ = 0;  // the largest met; that at the end of the step
  double least_independence_ = 0;                   // in the stages
  int n_singular_ = 0;
};

}  // namespace pintle

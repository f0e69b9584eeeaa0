// The explicit Dormand-Prince pair of order 5(4) on the equations as they stand, with the error measured on joint forces
// as well as on velocities. J. R. Dormand and P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19-26.
#pragma once

#include <array>

#include "integrators/absolute/stage_solver.h"
#include "integrators/force_evaluator.h"
#include "integrators/law_borders.h"
#include "pintle/trajectory.h"
#include "system/state.h"

namespace pintle {

class Dopri5 {
 public:
  Dopri5(const System& system, double tolerance);
  void set_load_scale(const LoadScale& scale) { scale_ = scale; }
  const LoadScale& load_scale() const { return scale_; }
  void set_max_step(double h) { max_step_ = h; }
  void start(const State& state, double h);
  bool step(double t_end);
  const State& state() const { return end_; }
  const State& previous() const { return begin_; }
  const State& state_before_event() const { return borders_.before_event(end_); }
  const Counters& counters() const { return counters_; }
  const std::string& failure() const { return failure_; }
  const std::vector<LawCrossing>& crossings() const { return borders_.crossings(); }

  /// Fills in the gaps, forces, accelerations and powers for state.q, state.v.
  void complete(State& state) { force_evaluator_.complete(state); }

 private:
  double error(double h);
  void grow_scale();

  const System& system_;
  ForceEvaluator force_evaluator_;
  LawBorders borders_;
  double tolerance_, max_step_ = 0, h_ = 0;
  State begin_, end_;
  std::array<Vecs, 7> kq_, kv_;
  std::array<std::vector<double>, 7> kz_;  // rates of the laws' states
  Vecs q_, v_, dq_, dv_, external_, magnitudes_;
  std::vector<double> z_;
  std::vector<Planar::Motion> m_;
  std::vector<JointKinematics> r_;
  LoadScale scale_;
  std::vector<double> rounding_;  // loads_above_rounding
  Counters counters_;
  std::string failure_;
};

}  // namespace pintle

// The trapezoidal rule, HHT-alpha and the generalised-alpha method on M a = F(t, q, v), with joint forces from the laws, theory/solvers
// section 3, or with ideal joints, theory/penalty. One family with two parameters.
#pragma once

#include <memory>
#include <string>

#include "integrators/force_evaluator.h"
#include "integrators/law_borders.h"
#include "integrators/general/alpha_weights.h"
#include "integrators/general/force_tangents.h"
#include "integrators/general/forced_steps.h"
#include "integrators/general/usual_tolerance.h"
#include "integrators/stepper.h"

namespace pintle {

class AlphaStepper final : public Stepper {
 public:
  /// `ideal_joints`: if there are any.
  AlphaStepper(const System& system, const AlphaWeights& weights, double tolerance, std::unique_ptr<ConstraintForces> ideal_joints = nullptr);

  void set_max_step(double h) override { max_step_ = h; }
  void set_load_scale(const LoadScale&) override {}
  const LoadScale& load_scale() const override { return no_scale_; }
  void start(const State& state, double h) override;
  bool step(double t_end) override;
  const State& state() const override { return end_; }
  const State& previous() const override { return begin_; }
  const State& interpolate(double t) override;
  const State& state_before_event() const override { return borders_.before_event(end_); }
  const Counters& counters() const override { return counters_; }
  const std::string& failure() const override { return failure_; }
  const std::vector<LawCrossing>& crossings() const override { return borders_.crossings(); }
  std::vector<std::string> remarks() const override;

 private:
  struct Knot {     // a time that has been reached
    Vecs v, a, law;  // accelerations: the method's own, and those that the laws give
    double h = 0;    // of the step that led there
  };
  void set_lag(double h, const Knot& knot, Vecs& a) const;
  bool solve(double h);
  void find_begin_forces();
  void interpolate_forces(double s);
  void place(double h);
  void forces(double t, const Vecs& q, const Vecs& v, std::vector<double>& law_state, Vecs& F);
  void find_states(double t, const Vecs& q, const Vecs& v, double h);
  double correct(double h);
  double error(double h);
  bool set_end_state(double t, double h);
  bool projects() const { return constraints_ && constraints_->projects(); }
  bool crosses_border(double& h) { return !constraints_ && borders_.shorten(end_, h); }
  void finish(double h);

  const System& system_;
  AlphaWeights weights_;
  double beta_, gamma_;
  UsualTolerance tolerance_;
  double newton_tolerance_, max_step_ = 0, h_ = 0;
  std::unique_ptr<ConstraintForces> constraints_;
  ForceEvaluator force_evaluator_;
  LawBorders borders_;
  ForceTangents tangents_;
  BlockLu<double, Planar::kDof> lu_;
  State begin_, end_, between_;
  Knot before_, now_;                   // starts of the previous step and of this one
  Vecs a_before_, a_now_;               // their accelerations with the lag of this step
  Vecs q_, v_, a_, F_begin_, F_;        // the end that is being solved for
  std::vector<double> z_;               // the laws' own states there
  std::vector<Planar::Motion> m_;
  std::vector<BlockVec<double, Planar::kDof>> work_;
  ForcedSteps forced_;                  // with ideal joints
  double largest_q_ = 1, largest_v_ = 1;
  LoadScale no_scale_;
  Counters counters_;
  std::string failure_;
};

}  // namespace pintle

// The force-accurate implicit method: Radau IIA of order 5 or 9 on positions, velocities AND joint gaps, theory/time
// section 3.
//
// Every joint carries its gap e as a state of its own, driven by the bodies' accelerations:
//     M v' = Q + G' f,    q' = v,    e'' = G v' + (convective term),    f = law(e, e')
// On a stiff joint the stage equations then state G M^-1 (Q + G' f) + convective = small, as if the constraint had been
// differentiated twice: the force has the order of the method, at any stiffness, instead of being k times the difference
// of nearly equal positions. On a soft joint they are its plain equations of motion. After every step the positions and
// velocities are projected onto the gaps (EndPointProjection), so that nothing drifts. Steps end at the kinks and jumps
// of laws and loads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "integrators/absolute/end_point_projection.h"
#include "integrators/absolute/stage_solver.h"
#include "integrators/bend_watch.h"
#include "integrators/open_contacts.h"
#include "integrators/force_tail.h"
#include "integrators/radau/motion_scale.h"
#include "integrators/radau/step_events.h"
#include "pintle/model.h"

namespace pintle {

template <class S>
class BasicRadauStepper : StepEvents<BasicRadauStepper<S>, S> {
 public:
  /// `stages` is 3 (order 5) or 5 (order 9).
  BasicRadauStepper(const BasicSystem<S>& system, double tolerance, int stages = 3, ToleranceOf tolerance_of = ToleranceOf::kForces);

  void set_max_step(double h) { control_.longest = h; }
  /// Loads known from an earlier run; otherwise the largest so far is used.
  void set_load_scale(const BasicLoadScale<S>& scale) { scale_ = scale; }
  const BasicLoadScale<S>& load_scale() const { return scale_; }

  /// Starts at `state` (with all members filled in) with a first step of about h.
  void start(const BasicState<S>& state, double h);
  /// One accepted step, not beyond t_end. False when no step succeeded; `failure` says why.
  bool step(double t_end);
  /// One step of exactly h without error control (negative: backwards); false when Newton fails.
  bool trial(double h);

  const BasicState<S>& state() const { return end_; }
  const BasicState<S>& previous() const { return begin_; }
  const BasicState<S>& state_before_event() const { return this->end_before_borders(); }
  /// StepEvents::in_crossing.
  const BasicState<S>* in_crossing(double t) { return StepEvents<BasicRadauStepper<S>, S>::in_crossing(t); }
  /// The interior of the last step, for dense output.
  const BasicStepNodes<S>& nodes() const { return nodes_; }
  double next_step() const { return control_.next; }
  const Counters& counters() const { return counters_; }
  const std::string& failure() const { return failure_; }
  const std::vector<LawCrossing>& crossings() const { return crossings_; }
  int sliding_load() const { return sliding_load_; }
  double largest_step_error() const { return control_.largest_error; }
  const SwitchingEvent& event() const { return control_.event(); }
  /// The last event, if it came after `since`; otherwise empty.
  std::string last_event(double since) const { return control_.last_event(system_, since); }
  const RadauTable& table() const { return table_; }

 private:
  static constexpr bool kEveryJointIsALaw = true;  // the force of each follows from its gap: for StepEvents
  friend class StepControl;  // calls the functions below, up to finish_step
  double t() const { return begin_.t; }
  void begin_at_end() { begin_ = end_; }
  bool attempt(double h);                     // solves the stages from begin_
  double contraction() const { return solver_->contraction(); }
  bool unloaded() const;
  void foresee_loads(double h);
  void raise_above_rounding();
  void raise_above_rounding_of_servos();
  void raise_load_scale_above_rounding(int body, const typename S::Vec& rounding);

  // error_estimate.cpp: the error of a step and its end
  bool error_estimate(double h, double& error);
  double change_of_loads(double h);           // as the bodies are moved onto their gaps
  double open_contact_error(double h) const;
  double missed_behind_event(double h) const;
  double share_of_step(double h, double t_end) { return bends_.share_of_step(begin_.t, h, t_end, end_m_, stage_[n_ - 1].m); }
  double motion_tail();                       // as accelerations that the bodies can follow
  void finish_step(double h);                 // fills end_ and nodes_
  void taylor_step(double h);                       // the same by Taylor's series, where forces stay constant
  void find_increments(double h);             // of the nodes, in curved spaces
  using Power = std::array<double, 2>;        // supplied, lost [W]
  void add_work(double h);
  double servo_work_missed_by_quadrature(int j, double h) const;
  Power power_of_loads(double t, const PositionsOf<S>& q, const std::vector<typename S::Motion>& m) const;
  void add_power(const BasicJointData<S>& joint, const std::vector<typename S::Motion>& m, const BasicLawPoint<S>& at, const typename S::Vec& force, Power& power) const;
  void find_power();

  // event_crossing.cpp: for StepEvents
  using Events = StepEvents<BasicRadauStepper<S>, S>;
  friend Events;
  using Events::control_, Events::search_, Events::crossings_, Events::sliding_load_;
  double end_time() const { return end_.t; }
  const std::vector<typename S::Motion>& end_motions() const { return end_m_; }
  const BasicState<S>& end_state() const { return end_; }
  std::vector<SlidingMode>& sliding() { return end_.sliding; }
  void evaluate_switching_functions(double x, double h, double* value);
  void extrapolate_switching_functions(double d, double* value);
  void extrapolate_gaps(double d);
  double change_in_loss_power(double d) const;
  bool forces_stay_constant(double d);
  void evaluate_switching_functions_at_end(double* value) const;
  void extrapolate_end_state(double d);
  const std::vector<typename S::Motion>& motions_after(double d);
  bool cross_borders();
  void shift_gap(int joint, double d, double rate);
  void balance_end();
  void rebalance_end();
  void compensate_late_crossing(double late);
  void undo_compensation();

  const BasicSystem<S>& system_;
  const RadauTable& table_;
  const int n_;                               // stages
  double tolerance_;
  const bool of_motion_;                      // the tolerance is on the motion
  BasicMotionScale<S> motion_scale_;
  BasicState<S> begin_, end_, before_compensation_;
  std::unique_ptr<BasicStageSolver<S>> solver_;
  std::vector<BasicStage<S>> stage_;
  BasicStepNodes<S> nodes_;
  std::unique_ptr<BasicEndPointProjection<S>> end_point_;
  BasicStageTails<S> tails_;
  VecsOf<S> load_change_, loads_then_, before_rebalancing_, rounding_;  // reused storage
  BasicOpenContacts<S> open_contacts_;
  BasicForceTail<S> force_tail_;
  BasicBendWatch<S> bends_;
  std::vector<int> powered_;                  // joints whose power the stages do not sum up
  PositionsOf<S> inside_q_;
  VecsOf<S> inside_v_, inside_gap_, inside_rate_;
  std::vector<double> inside_law_state_;
  std::vector<BasicJointKinematics<S>> end_r_;
  std::vector<typename S::Motion> end_m_, inside_m_;
  BasicLoadScale<S> scale_;
  Counters counters_;
  std::string failure_;
};
using RadauStepper = BasicRadauStepper<Planar>;

}  // namespace pintle

// The force-accurate implicit method over a joint tree: Radau IIA on coordinates, rates AND the gaps of the joints that remain
// force laws. theory/tree sections 5 to 7; the method for free bodies is radau_stepper.h.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "integrators/bend_watch.h"
#include "integrators/open_contacts.h"
#include "integrators/force_tail.h"
#include "integrators/radau/step_events.h"
#include "integrators/relative/tree_projector.h"
#include "integrators/relative/tree_stages.h"
#include "integrators/stepper.h"

namespace pintle {

class TreeRadau final : public Stepper, StepEvents<TreeRadau, Planar> {
 public:
  /// `stages` is 3 (order 5) or 5 (order 9).
  TreeRadau(const System& system, double tolerance, int stages = 3);

  void set_max_step(double h) override { control_.longest = h; }
  void set_load_scale(const LoadScale& scale) override { scale_ = scale; }
  const LoadScale& load_scale() const override { return scale_; }
  void start(const State& state, double h) override;
  bool step(double t_end) override;
  const State& state() const override { return end_state_; }
  const State& previous() const override { return begin_state_; }
  const State& interpolate(double t) override;
  const State& state_before_event() const override { return end_before_borders(); }
  const Counters& counters() const override { return counters_; }
  const std::string& failure() const override { return failure_; }
  const std::vector<LawCrossing>& crossings() const override { return crossings_; }
  int sliding_load() const override { return sliding_load_; }
  double largest_step_error() const override { return control_.largest_error; }
  std::string last_event(double since) const override { return control_.last_event(system_, since); }
  bool watches_bends() const override { return true; }

  const JointTree& tree() const { return *tree_; }

 private:
  static constexpr bool kEveryJointIsALaw = false;  // joints of the tree have reactions instead
  friend class StepControl;  // which calls the functions from here to finish_step
  double t() const { return begin_.t; }
  void begin_at_end();
  bool attempt(double h);
  double contraction() const { return stages_.contraction(); }

  // tree_error_estimate.cpp: the error of a step, its end and its dense output
  bool error_estimate(double h, double& error);
  Eigen::VectorXd find_taut(double own) const;
  /// Legendre coefficient k of a body's acceleration over the step.
  Planar::Vec body_coefficient(int k, int body) const;
  double body_tail() const;
  double gap_tail();
  double state_tail(double h) const;
  /// The place of a joint among those that have laws.
  Eigen::Index law_index(int joint) const { return std::find(tree_->laws().begin(), tree_->laws().end(), joint) - tree_->laws().begin(); }
  double open_contact_error(double h) const;
  double ringing_behind_event(double h) const;
  double share_of_step(double h, double t_end) { return bends_.share_of_step(begin_.t, h, t_end, end_at_.pose().m, stages_.instant(n_ - 1).pose().m); }
  void finish_step(double h);
  void taylor_step(double h);
  void move_onto_gaps();
  void take_gaps();
  void add_work(double h);
  void finish_end(const Eigen::VectorXd& w);
  void find_curves();
  void follow(double x, TreeState& out) const;

  // tree_event_crossing.cpp: what StepEvents needs
  friend StepEvents;
  double end_time() const { return end_.t; }
  const std::vector<Planar::Motion>& end_motions() const { return end_at_.pose().m; }
  const State& end_state() const { return end_state_; }
  std::vector<SlidingMode>& sliding() { return sliding_; }
  void evaluate_switching_functions(double x, double h, double* value);
  void extrapolate_switching_functions(double d, double* value);
  bool forces_stay_constant(double d);
  void evaluate_switching_functions_at_end(double* value) { end_at_.evaluate_switching_functions(end_, value); }
  void extrapolate_end_state(double d);
  const std::vector<Planar::Motion>& motions_after(double d);
  bool cross_borders() { return end_at_.cross_borders(search_.start(), search_.end(), end_, end_state_.dissipated); }
  void shift_gap(int joint, double d, double rate);
  void balance_end();
  void rebalance_end() { balance_end(); }
  void compensate_late_crossing(double late);
  void undo_compensation();

  const System& system_;
  const RadauTable& table_;
  const int n_;  // stages
  double tolerance_;
  std::vector<SlidingMode> sliding_;
  std::unique_ptr<JointTree> tree_;
  TreeStages stages_;
  TreeProjector projector_;
  TreeInstant end_at_, inside_at_;
  OpenContacts open_contacts_;
  BasicForceTail<Planar> force_tail_;
  BendWatch bends_;
  TreeState begin_, end_, before_compensation_;
  State begin_state_, end_state_, inside_state_;
  double supplied_before_ = 0, dissipated_before_ = 0;  // of before_compensation_ [J]
  TreeNodes nodes_;
  // The last step as power series in the fraction of the step, with the mismatch of the integrals at its end; computed on first use.
  struct Curves {
    double from = 0, to = 0;
    Eigen::MatrixXd w, accel, force, power;
    Eigen::VectorXd bend_y, bend_u, bend_gap, bend_rate, bend_work;
  };
  Curves curves_;
  LoadScale scale_;
  Vecs loads_now_, loads_then_;
  Counters counters_;
  std::string failure_;
};

}  // namespace pintle

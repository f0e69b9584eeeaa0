// The force-accurate implicit method: Radau IIA of order 5 on positions, velocities AND joint gaps, theory/time section 3.
//
// Every joint carries its gap e as a state of its own, driven by what the bodies' accelerations make of it:
//     M v' = Q + G' f,    q' = v,    e'' = G v' + (convective term),    f = law(e, e')
// On a stiff joint the stage equations then say G M^-1 (Q + G' f) + convective = small, as if the constraint had been
// differentiated twice: the force comes out with the order of the method, at any stiffness, instead of as k times the
// difference of nearly equal positions. On a soft joint they are its plain equations of motion. After every step the
// positions and velocities are moved onto the gaps (GapProjector), so that nothing drifts.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "integrators/gap_projector.h"
#include "integrators/radau_table.h"
#include "pintle/trajectory.h"
#include "system/state.h"

namespace pintle {

/// How large the forces are that a relative tolerance refers to: per body the sum of the magnitudes of the loads on it.
struct LoadScale {
  Vecs body;  // [N, N, N*m]
};

class RadauStepper {
 public:
  RadauStepper(const System& system, double tolerance);

  void set_max_step(double h) { max_step_ = h; }
  /// Loads known from an earlier run; otherwise the largest so far is used.
  void set_load_scale(const LoadScale& scale) { scale_ = scale; }
  const LoadScale& load_scale() const { return scale_; }

  /// Starts at `state` (all of it filled in) with a first step of about h.
  void start(const State& state, double h);
  /// One accepted step, not beyond t_end. False when no step could be made; `failure` says why.
  bool step(double t_end);
  /// One step of exactly h without error control (negative: backwards); false when Newton fails. For start values.
  bool trial(double h);
  /// Restarts extrapolation, after a kink.
  void forget_history() { have_history_ = false; }

  const State& state() const { return end_; }
  const State& previous() const { return begin_; }
  double next_step() const { return h_; }
  const Counters& counters() const { return counters_; }
  const std::string& failure() const { return failure_; }
  /// Forces and their times at the stages of the last step.
  const Vecs& stage_force(int i) const { return stage_[i].force; }
  const RadauTable& table() const { return table_; }

 private:
  static constexpr int kStages = RadauTable::kStages;
  struct Stage {
    Vecs q, v, a, Q, gap, gap_rate, gap_accel, force, ra, re;
    std::vector<Planar::Motion> m;
    std::vector<Reading> r;
  };
  struct JointBlocks {
    Planar::Mat K, C;                         // tangents
    std::array<Planar::Mat, 4> SK, SC;        // AA, AB, BA, BB of G'KG - geometric, G'CG
    BlockPattern::Slot ab{0, true};
  };
  struct ComplexVec { Planar::Vec re, im; };

  bool attempt(double h);                     // solves the stages from begin_
  void predict(double h);
  void evaluate_stage(int i, double h);
  void linearize();                           // at the middle stage
  bool factorize(double h);
  void solve_correction(double h);
  double correction_size() const;
  bool finish_step(double h);                 // project, fill end_
  double error_estimate() const;
  void grow_scale();
  void note_failure(double h, const char* why);
  template <class T> void assemble(BlockLu<T, 3>& lu, const T& mu) const;

  const System& system_;
  const RadauTable& table_;
  double tolerance_;
  double max_step_ = 0;
  State begin_, end_;
  double h_ = 0, last_h_ = 0;
  bool have_history_ = false;
  double contraction_ = 0.5;
  std::array<Stage, kStages> stage_;
  std::array<Vecs, 4> history_a_, history_gap_;   // accelerations at {0, c1, c2, 1} of the last step
  std::vector<JointBlocks> blocks_;
  struct LoadBlock { int i, j; Planar::Mat dq, dv; };
  std::vector<LoadBlock> load_blocks_;
  BlockLu<double, 3> real_lu_;
  BlockLu<Complex, 3> complex_lu_;
  std::vector<BlockVec<double, 3>> real_rhs_;
  std::vector<BlockVec<Complex, 3>> complex_rhs_;
  std::vector<Planar::Vec> real_re_;              // transformed gap residuals
  std::vector<ComplexVec> complex_re_;
  std::array<Vecs, kStages> delta_a_, delta_gap_;
  GapProjector projector_;
  Vecs wanted_, move_;
  std::vector<Reading> end_r_, frozen_;           // frozen: Jacobians of the correction
  std::vector<Planar::Motion> end_m_;
  LoadScale scale_;
  Counters counters_;
  std::string failure_;
};

}  // namespace pintle

// The stage solver with its stages in lanes: what it knows. What it does is in stage_solver.cpp, which compiles it for registers of
// several widths.
#pragma once

#include <vector>

#include "integrators/newton_contraction.h"
#include "integrators/stage_lanes.h"
#include "integrators/stage_solver.h"
#include "solve/block_lu.h"

namespace pintle {

template <int N>
class LaneSolver : public StageSolver {
 public:
  LaneSolver(const System& system, const RadauTable& table, double tolerance, Steps steps);

  void write(std::vector<Stage>& stages) const override;
  double contraction() const override { return contraction_.seen(); }
  double residual(int j) const override;

 protected:
  bool solve_stages(const State& begin, double h, const StepNodes* before, double last_h, const LoadScale& scale, Counters& counters);
  void find_yield(std::vector<Three>& forces) const;
  void find_tails(const State& begin, std::vector<Three>& bodies, std::vector<Three>& gaps) const;

 private:
  using L = Lanes<N>;
  using X = Spectrum<N>;
  static constexpr int kMiddle = N / 2;  // the stage where the equations are linearised

  // Bodies by index; the ground stands behind the last one and never moves.
  std::size_t body(int index) const { return index == kGround ? bodies_.size() - 1 : static_cast<std::size_t>(index); }
  std::size_t n_bodies() const { return bodies_.size() - 1; }

  void predict(const State& begin, double h, const StepNodes* before, double last_h);
  void find_targets(double t, double h);
  void take_scale(const LoadScale& scale);
  L place(const L& a, double x0, double v0, L& v) const;
  void place_body(const State& begin, std::size_t b);
  void place_bodies(const State& begin);
  void check_angles(const L& angles);
  void place_joint(const State& begin, std::size_t j, L& worst, L& sum);
  void place_joints(const State& begin);
  void find_residuals(const State& begin, double h);
  void find_loads(const State& begin, double h);
  void find_map(std::size_t j, L (&bias)[3]);
  L find_gradient(const JointData& joint, const PoseGeometry<L>& pose, JointLanes<N>& lanes) const;
  void linearize(double t, HeldJumps held);
  bool renew(const State& begin, double h, Counters& counters);
  bool factorize(double h);
  void add_joint(std::size_t j, const X& mu);
  void add_pose_joint(std::size_t j, const X& mu);
  static void add_block(Block<X, 3>& block, const Planar::Mat& K, const Planar::Mat& C, const X& mu, double sign);
  double correct(const State& begin);

  const System& system_;
  const RadauTable& table_;
  const StageMatrices<N> matrices_;
  StepMatrices<N> step_;
  double tolerance_;
  Steps steps_;
  NewtonContraction contraction_;
  static constexpr double kGood = 0.15, kSlow = 0.4;  // contractions: Jacobians serve the next step; they do not serve this one
  static constexpr int kMostWithOld = 4;      // iterations
  double factorized_for_ = 0;                 // the step; 0: none
  bool loads_;                                // there is more than weight
  bool simple_ = true;                        // and no joint that is more than springs and dampers
  std::vector<BodyLanes<N>> bodies_;
  std::vector<JointLanes<N>> joints_;
  Vecs Q_;                                    // of one stage
  std::vector<Planar::Motion> motions_;
  struct LoadBlock { int i, j; Planar::Mat dq, dv; };
  std::vector<BlockPattern::Slot> slots_;     // of each joint's bodies, A before B
  std::vector<LoadBlock> load_blocks_;
  X mu2_;
  BlockLu<X, 3> lu_;
  std::vector<BlockVec<X, 3>> rhs_;           // and the ground's
};

}  // namespace pintle

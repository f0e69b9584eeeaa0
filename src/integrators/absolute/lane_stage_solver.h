// The stage solver with its stages in lanes: its data. What it does is in stage_newton_iteration.h, which is compiled for registers of
// several widths.
#pragma once

#include <array>
#include <vector>

#include "integrators/radau/stage_lanes.h"
#include "integrators/absolute/stage_solver.h"
#include "integrators/radau/newton_convergence.h"
#include "integrators/radau/predictor.h"
#include "linalg/block_lu.h"

namespace pintle {

/// Large mechanisms do not fit into caches: every iteration passes through the bodies and joints once forwards and once backwards,
/// stores its data in the order of elimination, and does not store what can be recomputed.
template <class S, int N>
class LaneStageSolver : public BasicStageSolver<S> {
 public:
  LaneStageSolver(const BasicSystem<S>& system, const RadauTable& table, double tolerance, Steps steps);

  double contraction() const override { return contraction_.seen(); }
  double residual(int j) const override;

 protected:
  bool solve_stages(const BasicState<S>& begin, double h, const BasicStepNodes<S>* before, double last_h, const BasicLoadScale<S>& scale, Counters& counters);
  void write_stages(const BasicState<S>& begin, std::vector<BasicStage<S>>& stages, BasicStageTails<S>& tails) const;
  void filter_lanes(std::vector<RowOf4<S>>& forces) const;

 private:
  using L = Lanes<N>;
  using X = Spectrum<N>;
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  static constexpr int kMiddle = N / 2;  // the stage where the equations are linearised
  static constexpr int kMostStatePasses = 3;  // Newton passes for the states of a law at given gaps; one serves laws that are linear in them

  struct Body : S::template BodyLanes<N> {
    L residual[S::kDof];         // of its equation of motion: unbalanced forces [N, N, N*m]; then Newton's correction of a
    double over_scale[S::kDof];  // mass over the loads by which corrections are measured
    int index = 0;         // in the system
  };
  struct Joint {
    L accel[S::kDof], force[S::kDof];
    typename S::template GapMap<double> frozen;   // at the stage where the equations are linearised
    typename S::AttachmentFrame F, M;  // its attachments to its bodies
    double k[S::kDof], c[S::kDof];       // of springs and dampers
    double over_scale[S::kDof];    // 1 over the loads by which changes of the force are measured
    int index = 0;           // in the system
    int a, b;                // its bodies; the ground comes after the last one
    int first, last;         // of its bodies, without the ground
    int general = -1;        // index into general_, where the law is more than springs and dampers
    bool linear = false;     // springs and dampers
    int functions = 0;       // components of its gap that are functions of the pose; 0: the gap is the pose
    bool loses = false;      // it loses power as a spring and a damper that no motor drives
    signed char driven = -1;  // component that follows a target
    BlockPattern::Slot slot{};  // of its bodies, A before B
  };
  // Data of a joint whose law is more than springs and dampers.
  struct General {
    BasicLawTangents<S> tangents;            // at the stage where the equations are linearised
    LawImpedance<X, S> impedance;       // at the same stage
    X over_mu2[S::kDof * S::kDof];                   // its weight over mu^2
    X missing_gap[S::kDof];                // residual of the gap's equation, in the diagonal frame
    std::vector<L> state, rate;      // of the law itself; the rates are unknowns of the stages
    std::vector<L> residual;         // of the rates' equations
    std::vector<X> missing_hat;      // the same in the diagonal frame
    BasicLawTangents<S> at_stage;    // of one stage at a time
    std::vector<double> matrix, move;  // of the states' equations at all stages, and their solution
  };
  struct Curve;  // through the last step's nodes

  std::size_t n_bodies() const { return bodies_.size() - 1; }
  int body_or_ground(int place) const { return place == static_cast<int>(n_bodies()) ? kGround : place; }

  void fetch_body(const BasicState<S>& begin, const Curve& curve, const BasicLoadScale<S>& scale, std::size_t b) const;
  void fetch_joint(const BasicState<S>& begin, const Curve* unplaced, std::size_t j) const;
  void fetch_body_end(const BasicState<S>& begin, const std::vector<BasicStage<S>>& stages, const BasicStageTails<S>& tails, std::size_t b) const;
  void fetch_joint_end(const BasicState<S>& begin, const std::vector<BasicStage<S>>& stages, const BasicStageTails<S>& tails, std::size_t j) const;
  bool assemble_and_eliminate(const BasicState<S>& begin, double h, const Curve* unplaced, const BasicLoadScale<S>& scale, bool linearized);
  void begin_bodies(const BasicState<S>& begin, const Curve& curve, const BasicLoadScale<S>& scale, std::size_t first, std::size_t end);
  void begin_joint(const BasicState<S>& begin, const Curve& curve, const BasicLoadScale<S>& scale, Joint& joint);
  void find_targets(double t, double h);
  void place_body(const BasicState<S>& begin, std::size_t b);
  void check_angles(const L& angles, std::size_t first, std::size_t end);
  void place_joint(const BasicState<S>& begin, Joint& joint, L& worst, L& sum);
  void begin_residual(std::size_t b);
  void find_loads(const BasicState<S>& begin, double h);
  void find_balanced_loads();
  void assemble_joint(Joint& joint, const typename S::template GapMap<L>& map, const L (&bias)[S::kDof]);
  typename S::template GapMap<L> find_map(const Joint& joint, L (&bias)[S::kDof]) const;
  void find_gradients(const Joint& joint, typename S::template GapMap<L>& map, L (&bias)[S::kDof]) const;
  void begin_matrix(double h);
  void add_loads(const BasicState<S>& begin, double h);
  void linearize(const BasicState<S>& begin, Joint& joint, const typename S::template GapMap<L>& map);
  void add_joint(const Joint& joint, const X* weight, const typename S::Vec& force);
  static void add_block(Block<X, S::kDof>& block, const typename S::Mat& K, const typename S::Mat& C, const X& mu, double sign);
  double back_substitute(const BasicState<S>& begin);
  double extrapolation_error(const BasicStepNodes<S>& before, const RadauTable::Vec& weights) const;
  void linearize_at(double t, const BasicLaw<S>& law, const L* gap, const L* rate, const General& general, int stage, BasicLawTangents<S>& tangents) const;
  bool miss_states(const Joint& joint, const General& general) const;
  void solve_states(double t, const BasicLaw<S>& law, const L* gap, const L* rate, General& general);
  void place_general(const BasicState<S>& begin, Joint& joint, const L* gap, const L* rate, L* force);
  void answer_states(General& general, const X* missing, X* f) const;
  void move_states(General& general, const L* accel) const;
  void write_states(const BasicState<S>& begin, const Joint& joint, const L* gap, const L* rate, std::vector<BasicStage<S>>& stages, BasicStageTails<S>& tails) const;
  void apply_joint_correction(const BasicState<S>& begin, Joint& joint, L& worst, L& sum);
  void apply_body_correction(const BasicState<S>& begin, int b, const BlockVec<X, S::kDof>& x, L& worst, L& sum);

  const BasicSystem<S>& system_;
  const RadauTable& table_;
  const StageMatrices<N> matrices_;
  StepMatrices<N> step_;
  double tolerance_;
  NewtonContraction contraction_;
  Predictor predictor_;
  bool relinearizes_ = false;                // some law is linearised again
  static constexpr double kSlow = 0.4;       // contraction rate above which Jacobians of an earlier step do not serve this one
  static constexpr int kMostWithOld = 4;     // iterations with Jacobians of an earlier step, at most. The rule for new ones, 0.15 and no such limit, costs as much, but what it leaves makes the momentum of a rub and bristles at 1e-5 miss their stated errors
  double factorized_for_ = 0;                 // step size of the factorisation; 0: none
  bool loads_;                                // there are loads other than weight
  static constexpr std::size_t kTile = 16;    // bodies that fit into the innermost cache, with their joints
  static constexpr std::size_t kSoon = 16, kLater = 24;  // prefetch distances, in bodies or joints: of the system's data on them; of the solver's own, which come first
  bool large_;                                // memory is prefetched
  std::vector<int> by_first_;                 // if large: joints in the order of their first bodies
  bool simple_ = true;                        // no loads, and no joints but springs and dampers that no motor drives
  bool poses_ = true;                         // no joint but springs and dampers in the relative pose
  const BlockPattern pattern_;                // of rows in the order of elimination
  std::vector<Body> bodies_;                  // in that order
  std::vector<Joint> joints_;                 // in the order of their last bodies
  std::vector<General> general_;
  std::vector<L> target_accel_;               // accelerations of targets, by joint of the system; empty: nothing is driven
  VecsOf<S> Q_;                                    // of one stage, by body of the system
  std::vector<BlockVec<L, S::kDof>> loads_on_;      // on the bodies and the ground: gravity and loads at the stages, where there are loads
  std::vector<typename S::Motion> motions_;       // of one stage, by body of the system, where they are needed
  X mu_, mu2_, once_, twice_;                 // mu, mu^2, 1 / mu, 1 / mu^2
  LaneMatrix<N> back_;                        // T mu^2: from the diagonal frame to accelerations at the stages
  BlockLu<X, S::kDof> lu_;
  std::vector<BlockVec<X, S::kDof>> rhs_;           // of the bodies and the ground
};

}  // namespace pintle

#include "integrators/step_end.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "integrators/pose_blocks.h"
#include "integrators/stage_lanes.h"
#include "integrators/step_error.h"
#include "solve/wide.h"

namespace pintle {
namespace {

using S = Planar;

// What the rounding of positions leaves of a gap, or that of velocities of its rate.
double rounding_of(const Vecs& x) { return 16 * std::numeric_limits<double>::epsilon() * largest_coordinate(x); }

constexpr double kMostOfRates = 1e-9;  // of the largest velocity: what may be left of rates in the shortest steps

// As carried, but as the geometry has it where that is another one.
S::Vec carried_or(const S::Vec& carried, const S::Vec& geometry, double rounding) {
  return ((geometry - carried).array().abs() > rounding).select(geometry, carried);
}

class EndSolver : public StepEnd {
 public:
  explicit EndSolver(const System& system)
      : system_(system), joints_(system.joints.size()), lu_(system.pattern(), symmetry_of_joints(system)), four_(system.bodies.size() + 1),
        one_(system.bodies.size() + 1), pull_(system.bodies.size() + 1) {
    const auto body = [&](int index) { return index == kGround ? system.bodies.size() : static_cast<std::size_t>(index); };
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const JointData& data = system.joints[j];
      Joint& joint = joints_[j];
      joint.a = body(data.at.a);
      joint.b = body(data.at.b);
      joint.linear = std::get_if<LinearLaw>(&data.law);
      joint.pose = joint.linear && std::holds_alternative<Selection>(data.probe);
      if (!joint.linear) {
        joint.full = full_.size();
        full_.emplace_back();
      }
      for (int k = 0; k < S::kDof; ++k) joint.forbidden[k] = data.free_mask[k] == 0;
      if (data.at.a != kGround && data.at.b != kGround) joint.slot = system.pattern().slot(data.at.a, data.at.b);
    }
  }

  const std::vector<Four>& answers() const override { return four_; }

 protected:
  bool find_answers(double t, double mu, const Stage& last, StageTails& tails) {
    begin_matrix(mu);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      Joint& joint = joints_[j];
      system_.with_reading(j, t, last.m, [&](const Reading& r) {
        joint.map = r.map;
        for (int k = 0; k < S::kDof; ++k) tails.gaps[j][k].set(3, last.gap[j][k] - r.gap[k]);
      });
      add_joint(j, mu, last);
      Four f;
      weigh(joint, tails.gaps[j].a.data(), f.a.data());
      joint.map.push(f.a.data(), four_[joint.a], four_[joint.b]);
    }
    if (!lu_.factorize()) return false;
    lu_.solve(four_);
    return true;
  }

  // The gaps' own accelerations come out of the stages as second differences of what the forces demand; where a joint is
  // neither stiff nor soft for this step, their error is the force's.
  double find_error(const StageTails& tails, const LoadScale& scale) const {
    TailSize bodies, gaps;
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) {
        const double over = system_.bodies[b].mass[k] / scale.body[b][k];
        bodies.add(over * tails.bodies[b][k]);
        gaps.add(over * four_[b][k]);
      }
    return std::max(bodies.value(), kGapError * gaps.value());
  }

  void find_end(const Stage& last, double h, State& end, std::vector<S::Motion>& m, LoadScale& scale) {
    const double rounding = rounding_of(last.q), most = kMostOfRates * largest_coordinate(last.v);
    const double rounding_of_rate = std::max(rounding_of(last.v), std::min(rounding / std::abs(h), most));
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) end.q[b][k] = last.q[b][k] + four_[b][k][3];
    end.v = last.v;
    end.a = last.a;
    end.gap_accel = last.gap_accel;
    system_.motions(end.q, end.v, m);
    if (!(ask_rates(last, end, m) < rounding)) {  // one pass has left more
      ask_gaps(last, end, m);
      answer(end.q);
      system_.motions(end.q, end.v, m);
      ask_rates(last, end, m);
    }
    move_velocities(end, m);
    if (!(ask_forces(last, end, m, rounding, rounding_of_rate) < rounding_of_rate)) {
      ask_rates(last, end, m);
      move_velocities(end, m);
      ask_forces(last, end, m, rounding, rounding_of_rate);
    }
    balance(last, end, scale);
  }

 private:
  struct Joint {
    GapMap<double> map{};               // at the last stage, as in the matrix: with another one stiff joints would answer what is no gap
    double weight[3] = {};              // K + mu C where that is diagonal
    std::size_t a = 0, b = 0;           // its bodies; the ground stands behind the last one
    const LinearLaw* linear = nullptr;  // its law, if that is one
    std::size_t full = 0;               // its matrix among full_, where that is not diagonal
    BlockPattern::Slot slot{};          // of its bodies, A before B
    std::array<bool, 3> forbidden{};    // components
    bool pose = false;                  // springs and dampers in the relative pose
  };
  using Three = BlockVec<double, S::kDof>;

  std::size_t n_bodies() const { return system_.bodies.size(); }

  template <class T>
  void weigh(const Joint& joint, const T* gap, T* f) const {
    if (joint.linear) {
      for (int k = 0; k < S::kDof; ++k) f[k] = joint.weight[k] * gap[k];
    } else {
      const S::Mat& w = full_[joint.full];
      for (int k = 0; k < S::kDof; ++k) f[k] = w(k, 0) * gap[0] + w(k, 1) * gap[1] + w(k, 2) * gap[2];
    }
  }

  void begin_matrix(double mu) {
    lu_.set_diagonal([&](int b, int k) { return mu * mu * system_.bodies[b].mass[k]; });
    std::fill(four_.begin(), four_.end(), Four{});
  }

  void add_joint(std::size_t j, double mu, const Stage& last) {
    Joint& joint = joints_[j];
    const JointData& data = system_.joints[j];
    if (joint.linear) {
      for (int k = 0; k < S::kDof; ++k) joint.weight[k] = joint.linear->k[k] + mu * joint.linear->c[k];
    } else {
      const Response response = respond(data.law, last.gap[j], last.gap_rate[j]);
      full_[joint.full] = response.stiffness + mu * response.damping;
    }
    if (joint.pose) add_pose_blocks(lu_, data.at, joint.slot, joint.map, joint.weight, S::Vec::Zero());
    else add_gap_blocks(lu_, data.at, joint.slot, joint.map, joint.linear ? S::Mat(S::Vec(joint.weight[0], joint.weight[1], joint.weight[2]).asDiagonal()) : full_[joint.full]);
  }

  // one_ += G' W gap.
  void ask(const Joint& joint, const S::Vec& gap) {
    double f[3];
    weigh(joint, gap.data(), f);
    joint.map.push(f, one_[joint.a], one_[joint.b]);
  }
  static double largest(const Joint& joint, const S::Vec& gap, double than) {
    for (int k = 0; k < S::kDof; ++k)
      if (joint.forbidden[k]) than = std::max(than, std::abs(gap[k]));
    return than;
  }
  static void clear(std::vector<Three>& x) { std::fill(x.begin(), x.end(), Three{}); }

  void answer(Vecs& x) {
    lu_.solve(one_);
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) x[b][k] += one_[b][k];
  }

  void ask_gaps(const Stage& last, const State& end, const std::vector<S::Motion>& m) {
    clear(one_);
    for (std::size_t j = 0; j < joints_.size(); ++j)
      system_.with_reading(j, end.t, m, [&](const Reading& r) { ask(joints_[j], last.gap[j] - r.gap); });
  }

  // What is left of the gaps is returned.
  double ask_rates(const Stage& last, const State& end, const std::vector<S::Motion>& m) {
    clear(one_);
    double left = 0;
    for (std::size_t j = 0; j < joints_.size(); ++j)
      system_.with_reading(j, end.t, m, [&](const Reading& r) {
        left = largest(joints_[j], last.gap[j] - r.gap, left);
        ask(joints_[j], last.gap_rate[j] - r.rate);
      });
    return left;
  }

  void move_velocities(State& end, std::vector<S::Motion>& m) {
    answer(end.v);
    for (std::size_t b = 0; b < n_bodies(); ++b) {
      m[b].v = end.v[b].head<2>();
      m[b].w = end.v[b][2];
    }
  }

  // The joints' forces at their gaps, into pull_ by the matrix's map, so that the balance takes off all that is wrong with them; and
  // what their accelerations want, into one_. What is left of the rates is returned.
  double ask_forces(const Stage& last, State& end, const std::vector<S::Motion>& m, double rounding, double rounding_of_rate) {
    clear(one_);
    clear(pull_);
    double left = 0;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const Joint& joint = joints_[j];
      const JointData& data = system_.joints[j];
      system_.with_reading(j, end.t, m, [&](const Reading& r) {
        left = largest(joint, last.gap_rate[j] - r.rate, left);
        ask(joint, last.gap_accel[j] - r.bias - gap_change(data.at, r, last.a));
        end.gap[j] = carried_or(last.gap[j], r.gap, rounding);
        end.gap_rate[j] = carried_or(last.gap_rate[j], r.rate, rounding_of_rate);
      });
      end.force[j] = joint.linear ? joint.linear->force(end.gap[j], end.gap_rate[j]) : law_force(data.law, end.gap[j], end.gap_rate[j]);
      joint.map.push(end.force[j].data(), pull_[joint.a], pull_[joint.b]);
    }
    return left;
  }

  // At the end of the step positions and velocities are better than anywhere inside: so are the forces that balance them. The
  // magnitudes of the loads on each body go into one_.
  void balance(const Stage& last, State& end, LoadScale& scale) {
    lu_.solve(one_);
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) pull_[b][k] += last.Q[b][k] - system_.bodies[b].mass[k] * (last.a[b][k] + one_[b][k]);
    lu_.solve(pull_);
    pull_.back() = {};  // the ground's
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) one_[b][k] = std::abs(last.Q[b][k]) + std::abs(system_.bodies[b].mass[k] * end.a[b][k]);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const Joint& joint = joints_[j];
      double gap[3], change[3];
      joint.map.gather(pull_[joint.a].a.data(), pull_[joint.b].a.data(), gap);
      weigh(joint, gap, change);
      for (int k = 0; k < S::kDof; ++k) end.force[j][k] -= change[k];
      add_magnitudes(joint.map, end.force[j], one_[joint.a], one_[joint.b]);
    }
    for (std::size_t b = 0; b < n_bodies(); ++b) raise_scale(system_.bodies[b], S::Vec(one_[b][0], one_[b][1], one_[b][2]), scale.body[b]);
  }

  const System& system_;
  std::vector<Joint> joints_;
  std::vector<S::Mat> full_;
  BlockLu<double, S::kDof> lu_;
  std::vector<Four> four_;          // of bodies and the ground, as the next ones
  std::vector<Three> one_, pull_;
};

// The same text for registers of every width.
class NarrowEnd final : public EndSolver {
 public:
  using EndSolver::EndSolver;
  bool prepare(double t, double mu, const Stage& last, StageTails& tails) override { return find_answers(t, mu, last, tails); }
  double error(const StageTails& tails, const LoadScale& scale) const override { return find_error(tails, scale); }
  void finish(const Stage& last, double h, State& end, std::vector<S::Motion>& m, LoadScale& scale) override { find_end(last, h, end, m, scale); }
};

#ifdef PINTLE_WIDE
class WideEnd final : public EndSolver {
 public:
  using EndSolver::EndSolver;
  PINTLE_WIDE bool prepare(double t, double mu, const Stage& last, StageTails& tails) override { return find_answers(t, mu, last, tails); }
  PINTLE_WIDE double error(const StageTails& tails, const LoadScale& scale) const override { return find_error(tails, scale); }
  PINTLE_WIDE void finish(const Stage& last, double h, State& end, std::vector<S::Motion>& m, LoadScale& scale) override { find_end(last, h, end, m, scale); }
};
#endif

}  // namespace

std::unique_ptr<StepEnd> make_step_end(const System& system) {
#ifdef PINTLE_WIDE
  if (has_wide_registers()) return std::make_unique<WideEnd>(system);
#endif
  return std::make_unique<NarrowEnd>(system);
}

}  // namespace pintle

// Steps of Radau IIA of order 5 with variants side by side: does what RadauStepper does, with given lengths and with new Jacobians in
// every step. theory/time sections 3 to 5.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "batch/batch.h"
#include "batch/batch_projector.h"
#include "batch/batch_curves.h"
#include "batch/batch_start.h"
#include "integrators/radau/newton_convergence.h"
#include "integrators/radau/radau_table.h"
#include "integrators/radau/step_error.h"
#include "linalg/complex_lanes.h"

namespace pintle::PINTLE_BATCH {

class BatchSteps {
 public:
  BatchSteps(BatchMechanism& mechanism, const BatchPlan& plan)
      : mechanism_(mechanism), tolerance_(plan.tolerance), of_newton_(plan.of_newton), n_(mechanism.n_bodies()), projector_(mechanism), real_(mechanism.pattern(), Symmetry::kSymmetric),
        pair_(mechanism.pattern(), Symmetry::kSymmetric), begin_(n_, mechanism.joints.size()), end_(begin_), over_scale_(n_), over_joint_(mechanism.joints.size()),
        real_rhs_(n_ + 1), pair_rhs_(n_ + 1), real_e_(mechanism.joints.size()), pair_e_(mechanism.joints.size()), m_(n_ + 1),
        r_(mechanism.joints.size()), frozen_(mechanism.joints.size()), wanted_(mechanism.joints.size()), move_(n_ + 1), tail_(n_ + 1), loads_at_end_(n_ + 1),
        nodes_(n_, mechanism.joints.size()), curves_(mechanism) {
    for (Stage& s : stage_) s = Stage(n_, mechanism.joints.size());
    for (std::size_t i = 0; i < n_; ++i)
      for (int k = 0; k < 3; ++k) over_scale_[i][k] = 1 / plan.scale.body[i][k];
    for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
      for (int k = 0; k < 3; ++k) {
        const Placement& at = mechanism.joints[j].at;
        const auto on = [&](int body) { return body == kGround ? 0.0 : plan.scale.body[body][k]; };
        over_joint_[j][k] = 1 / std::max(on(at.a), on(at.b));
      }
  }

  void start(const BatchState& state) {
    end_ = state;
    have_nodes_ = false;
    worst_ = VariantLanes(0.0);
    iterations_ = 0;
    contraction_.fill(kFirstContraction);
    curves_.forget();
    curves_.look_at(end_.t, end_.force);
  }

  /// `share`: length of the step as a fraction of the duration.
  void step(double share, const VariantLanes& duration) {
    std::swap(begin_, end_);
    const VariantLanes h = share * duration;
    predict(have_nodes_ ? share / last_share_ : 0);
    solve(h);
    VariantLanes error;
    error_estimate(h, error);
    worst_ = larger(worst_, error);
    finish(h);
    look_for_nonsense();
    curves_.look_along(begin_, end_, nodes_);
    last_share_ = share;
    have_nodes_ = true;
  }

  /// The largest error estimate of a step over the tolerance; infinite if an iteration has failed or a result is not a number.
  const VariantLanes& worst() const { return worst_; }
  /// Iterations of the step that took the most.
  int iterations() const { return iterations_; }
  const std::vector<BatchPeak>& peaks() const { return curves_.peaks(); }
  const BatchState& state() const { return end_; }

 private:
  static constexpr int N = kBatchStages, kMost = NewtonContraction::kMaxIterations;
  static constexpr double kFirstContraction = 0.5;
  using Pair = ComplexLanes<kVariantLanes>;

  struct Stage {
    VariantVecs q, v, a, Q, gap, rate, accel, force, bias;
    std::vector<GapMap<VariantLanes>> map;
    Stage() = default;
    Stage(std::size_t n, std::size_t joints)
        : q(n + 1), v(n + 1), a(n + 1), Q(n + 1), gap(joints), rate(joints), accel(joints), force(joints), bias(joints), map(joints) {}
  };

  // NaN never compares as larger, so it would go unnoticed.
  void look_for_nonsense() {
    VariantLanes nothing(0.0);
    for (const VariantVec& f : end_.force)
      for (int k = 0; k < 3; ++k) nothing += 0.0 * f[k];
    for (const VariantVec& a : end_.a)
      for (int k = 0; k < 3; ++k) nothing += 0.0 * a[k];
    for (int lane = 0; lane < kVariantLanes; ++lane)
      if (nothing[lane] != 0) worst_.set(lane, HUGE_VAL);
  }

  // Extrapolates the last step's curve. `ratio`: this step over the last one; 0: there is none.
  PINTLE_PART void predict(double ratio) {
    for (int s = 0; s < N; ++s) {
      Stage& stage = stage_[s];
      if (ratio == 0) {
        stage.a = begin_.a;
        stage.accel = begin_.accel;
        continue;
      }
      const RadauTable::Vec w = table_.weights(1 + table_.c[s] * ratio);
      const auto continued = [&](const std::array<VariantVecs, N + 1>& nodes, VariantVecs& out) {
        for (std::size_t i = 0; i < out.size(); ++i)
          for (int k = 0; k < 3; ++k) out[i][k] = w[0] * nodes[0][i][k] + w[1] * nodes[1][i][k] + w[2] * nodes[2][i][k] + w[3] * nodes[3][i][k];
      };
      continued(nodes_.a, stage.a);
      continued(nodes_.accel, stage.accel);
    }
  }

  // Eq. (3.5).
  PINTLE_PART void place(const VariantLanes& h) {
    const VariantLanes h2 = h * h;
    const auto integrate = [&](std::size_t count, auto of, const VariantVecs& x0, const VariantVecs& v0, auto x, auto v) {
      for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
          const VariantLanes a0 = (stage_[0].*of)[i][k], a1 = (stage_[1].*of)[i][k], a2 = (stage_[2].*of)[i][k];
          for (int s = 0; s < N; ++s) {
            (stage_[s].*v)[i][k] = v0[i][k] + h * (table_.A(s, 0) * a0 + table_.A(s, 1) * a1 + table_.A(s, 2) * a2);
            (stage_[s].*x)[i][k] = x0[i][k] + table_.c[s] * h * v0[i][k] + h2 * (table_.A2(s, 0) * a0 + table_.A2(s, 1) * a1 + table_.A2(s, 2) * a2);
          }
        }
    };
    integrate(n_, &Stage::a, begin_.q, begin_.v, &Stage::q, &Stage::v);
    integrate(r_.size(), &Stage::accel, begin_.gap, begin_.rate, &Stage::gap, &Stage::rate);
  }

  // Forces from gaps and rates; `change`: how much they have changed, relative to the loads.
  PINTLE_PART void find_forces(VariantLanes& change) {
    change = VariantLanes(0.0);
    for (std::size_t j = 0; j < r_.size(); ++j)
      for (Stage& stage : stage_) {
        const VariantVec f = BatchMechanism::law_force(mechanism_.joints[j], stage.gap[j], stage.rate[j]);
        for (int k = 0; k < 3; ++k) change = larger(change, over_joint_[j][k] * sizes(f[k] - stage.force[j][k]));
        stage.force[j] = f;
      }
  }

  // Maps, convective terms and loads at the stages.
  PINTLE_PART void read_stages(const VariantLanes& h) {
    for (int s = 0; s < N; ++s) {
      Stage& stage = stage_[s];
      const VariantLanes t = begin_.t + table_.c[s] * h;
      mechanism_.motions(stage.q, stage.v, m_);
      mechanism_.maps(t, m_, stage.map, stage.bias);
      mechanism_.external(t, m_, stage.Q);
    }
  }

  // The matrices at the middle stage, from the joints' maps and forces and the loads' derivatives; factorises them. Eq. (3.8).
  PINTLE_PART void linearize(const VariantLanes& h) {
    constexpr int kMiddle = 1;
    const VariantLanes over = reciprocal(h);
    mu_ = table_.real_eigenvalue * over;
    nu_ = {table_.eigenvalue[0].real() * over, table_.eigenvalue[0].imag() * over};
    mu2_ = mu_ * mu_;
    nu2_ = nu_ * nu_;
    over_mu2_ = reciprocal(mu2_);
    over_nu2_ = reciprocal(nu2_);
    real_.set_diagonal([this](int i, int k) { return mechanism_.bodies[i].mass[k] * mu2_; });
    pair_.set_diagonal([this](int i, int k) { return mechanism_.bodies[i].mass[k] * nu2_; });
    for (std::size_t j = 0; j < r_.size(); ++j) {
      const BatchJoint& joint = mechanism_.joints[j];
      frozen_[j] = stage_[kMiddle].map[j];
      VariantLanes w[3];
      Pair z[3];
      for (int k = 0; k < 3; ++k) {
        w[k] = joint.k[k] + mu_ * joint.c[k];
        z[k] = {joint.k[k] + nu_.re * joint.c[k], nu_.im * joint.c[k]};
      }
      PoseBlocks<Planar, VariantLanes>::of(frozen_[j], w, stage_[kMiddle].force[j]).add_to(real_, joint.at, joint.slot);
      PoseBlocks<Planar, Pair>::of(frozen_[j], z, stage_[kMiddle].force[j]).add_to(pair_, joint.at, joint.slot);
    }
    if (mechanism_.has_loads()) add_load_tangents(begin_.t + table_.c[kMiddle] * h);
    real_.factorize();
    pair_.factorize();
  }

  // The symmetric part of the loads' derivatives: matrices stay symmetric, and Newton's iteration makes up for the rest.
  PINTLE_PART void add_load_tangents(const VariantLanes& t) {
    mechanism_.motions(stage_[1].q, stage_[1].v, m_);
    mechanism_.load_tangents(t, m_, [this](int lane, int i, int j, const Planar::Mat& dq, const Planar::Mat& dv) {
      if (i == j) {
        add_slopes(lane, real_.diagonal(i), pair_.diagonal(i), dq, dv);
        add_slopes(lane, real_.diagonal(i), pair_.diagonal(i), dq.transpose(), dv.transpose());
        return;
      }
      const BlockPattern::Slot slot = mechanism_.pattern().slot(i, j), upper{slot.index, true};
      if (slot.upper) add_slopes(lane, real_.off_diagonal(upper), pair_.off_diagonal(upper), dq, dv);
      else add_slopes(lane, real_.off_diagonal(upper), pair_.off_diagonal(upper), dq.transpose(), dv.transpose());
    });
  }
  // Adds half of the derivatives.
  PINTLE_LANES void add_slopes(int lane, Block<VariantLanes, 3>& real, Block<Pair, 3>& pair, const Planar::Mat& dq, const Planar::Mat& dv) const {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        subtract(real(r, c), lane, 0.5 * (dq(r, c) + mu_[lane] * dv(r, c)));
        subtract(pair(r, c).re, lane, 0.5 * (dq(r, c) + nu_.re[lane] * dv(r, c)));
        subtract(pair(r, c).im, lane, 0.5 * (nu_.im[lane] * dv(r, c)));
      }
  }

  // Newton's iteration, in each lane until it has converged. Eqs. (3.6)-(3.11).
  void solve(const VariantLanes& h) {
    VariantLanes active(1.0), last(0.0), change, of_forces;
    place(h);
    find_forces(of_forces);
    for (int iteration = 0; iteration < kMost; ++iteration) {
      iterations_ = std::max(iterations_, iteration + 1);
      read_stages(h);
      if (iteration == 0) linearize(h);
      correct(active, change);
      place(h);
      find_forces(of_forces);
      change = larger(change, of_forces);
      if (!judge(iteration, change, last, active)) return;
      last = change;
    }
    for (int lane = 0; lane < kVariantLanes; ++lane)
      if (active[lane] != 0) worst_.set(lane, HUGE_VAL);
  }

  // Sets `active` to 0 in lanes that are done; returns false if all are. Same rule as NewtonContraction.
  bool judge(int iteration, const VariantLanes& change, const VariantLanes& last, VariantLanes& active) {
    bool any = false;
    for (int lane = 0; lane < kVariantLanes; ++lane) {
      if (active[lane] == 0) continue;
      const double size = change[lane] / of_newton_;
      if (change[lane] < NewtonContraction::kRounding) {
        active.set(lane, 0);
        continue;
      }
      double rate = iteration == 0 ? std::clamp(2 * contraction_[lane], 0.01, 0.9) : change[lane] / last[lane];
      if (iteration == 1) rate = std::max(rate, std::min(contraction_[lane], std::sqrt(rate)));
      if (iteration > 0) contraction_[lane] = rate;
      const bool done = rate < 1 && rate / (1 - rate) * size < NewtonContraction::kShare;
      const bool failed = !std::isfinite(size) || rate > 2;
      if (failed) worst_.set(lane, HUGE_VAL);
      if (done || failed) active.set(lane, 0);
      else any = true;
    }
    return any;
  }

  // Corrects the active lanes once. `worst`: the size of the corrections of all lanes, as body forces over the loads.
  PINTLE_PART void correct(const VariantLanes& active, VariantLanes& worst) {
    const auto real_part = [&](const auto& x) { return table_.inverse_real[0] * x(0) + table_.inverse_real[1] * x(1) + table_.inverse_real[2] * x(2); };
    const auto pair_part = [&](const auto& x) {
      const auto& w = table_.inverse_complex[0];
      const VariantLanes x0 = x(0), x1 = x(1), x2 = x(2);
      return Pair(w[0].real() * x0 + w[1].real() * x1 + w[2].real() * x2, w[0].imag() * x0 + w[1].imag() * x1 + w[2].imag() * x2);
    };
    std::array<VariantVecs, N>& missing = missing_;
    for (int s = 0; s < N; ++s) {
      Stage& stage = stage_[s];
      missing[s] = stage.Q;  // Q + G' f - M a
      for (std::size_t j = 0; j < r_.size(); ++j) BatchMechanism::add_force(mechanism_.joints[j], stage.map[j], stage.force[j], missing[s]);
      for (std::size_t i = 0; i < n_; ++i)
        for (int k = 0; k < 3; ++k) missing[s][i][k] -= mechanism_.bodies[i].mass[k] * stage.a[i][k];
    }
    for (std::size_t i = 0; i < n_; ++i)
      for (int k = 0; k < 3; ++k) {
        const auto of = [&](int s) { return missing[s][i][k]; };
        real_rhs_[i][k] = real_part(of);
        pair_rhs_[i][k] = pair_part(of);
      }
    real_rhs_.back() = {};
    pair_rhs_.back() = {};
    for (std::size_t j = 0; j < r_.size(); ++j) {
      const BatchJoint& joint = mechanism_.joints[j];
      VariantVec residual[N];
      for (int s = 0; s < N; ++s) {
        const Stage& stage = stage_[s];
        const VariantVec e = BatchMechanism::gap_change(joint, stage.map[j], stage.a);
        for (int k = 0; k < 3; ++k) residual[s][k] = stage.accel[j][k] - e[k] - stage.bias[j][k];
      }
      VariantVec f;
      BlockVec<Pair, 3> z;
      for (int k = 0; k < 3; ++k) {
        const auto of = [&](int s) { return residual[s][k]; };
        real_e_[j][k] = real_part(of);
        pair_e_[j][k] = pair_part(of);
        f[k] = (joint.k[k] + mu_ * joint.c[k]) * over_mu2_ * real_e_[j][k];
        z[k] = Pair(joint.k[k] + nu_.re * joint.c[k], nu_.im * joint.c[k]) * over_nu2_ * pair_e_[j][k];
      }
      frozen_[j].push(f.a.data(), real_rhs_[joint.a], real_rhs_[joint.b]);
      frozen_[j].push(z.a.data(), pair_rhs_[joint.a], pair_rhs_[joint.b]);
    }
    real_.solve(real_rhs_);
    pair_.solve(pair_rhs_);
    real_rhs_.back() = {};
    pair_rhs_.back() = {};
    worst = VariantLanes(0.0);
    const auto back = [&](const VariantLanes& real, const Pair& pair, int s) {
      return table_.T_real[s] * real + 2 * table_.T_complex[0][s].real() * pair.re - 2 * table_.T_complex[0][s].imag() * pair.im;
    };
    for (std::size_t i = 0; i < n_; ++i)
      for (int k = 0; k < 3; ++k) {
        const VariantLanes real = real_rhs_[i][k] = mu2_ * real_rhs_[i][k];
        const Pair pair = pair_rhs_[i][k] = nu2_ * pair_rhs_[i][k];
        const VariantLanes over = mechanism_.bodies[i].mass[k] * over_scale_[i][k];
        for (int s = 0; s < N; ++s) {
          const VariantLanes delta = back(real, pair, s);
          worst = larger(worst, over * sizes(delta));
          stage_[s].a[i][k] += where_larger(active, VariantLanes(0.0), delta, VariantLanes(0.0));
        }
      }
    for (std::size_t j = 0; j < r_.size(); ++j) {
      const BatchJoint& joint = mechanism_.joints[j];
      const VariantVec real = BatchMechanism::gap_change(joint, frozen_[j], real_rhs_);
      BlockVec<Pair, 3> pair;
      frozen_[j].gather(pair_rhs_[joint.a].a.data(), pair_rhs_[joint.b].a.data(), pair.a.data());
      for (int k = 0; k < 3; ++k)
        for (int s = 0; s < N; ++s)
          stage_[s].accel[j][k] += where_larger(active, VariantLanes(0.0), back(real[k] - real_e_[j][k], pair[k] - pair_e_[j][k], s), VariantLanes(0.0));
    }
  }

  // The last of three coefficients, times the expected fall-off to the next one, over the tolerance. Eqs. (3.12), (3.13).
  PINTLE_LANES VariantLanes tail(const VariantLanes& last, const VariantLanes& before, const VariantLanes& before_that) const {
    VariantLanes out;
    for (int lane = 0; lane < kVariantLanes; ++lane) {
      const double x = last[lane];
      out.set(lane, x > 0 ? x * fall_off(x, before[lane], before_that[lane]) / tolerance_ : x == 0 ? 0 : HUGE_VAL);
    }
    return out;
  }

  PINTLE_PART void error_estimate(const VariantLanes& h, VariantLanes& error) {
    const Stage& last = stage_[N - 1];
    read(mechanism_, begin_.t + h, last.q, last.v, m_, r_);
    projector_.prepare(r_, (kProjectionShare * table_.real_eigenvalue) * reciprocal(h));
    VariantLanes size[N + 1];
    for (int k = 1; k <= N; ++k) {
      size[k] = VariantLanes(0.0);
      for (std::size_t i = 0; i < n_; ++i)
        for (int c = 0; c < 3; ++c) {
          VariantLanes x = table_.to_legendre(k, 0) * begin_.a[i][c];
          for (int s = 0; s < N; ++s) x += table_.to_legendre(k, s + 1) * stage_[s].a[i][c];
          size[k] = larger(size[k], mechanism_.bodies[i].mass[c] * over_scale_[i][c] * sizes(x));
        }
    }
    const VariantLanes of_bodies = tail(size[3], size[2], size[1]);
    for (int back = 0; back < N; ++back) {
      for (std::size_t j = 0; j < r_.size(); ++j)
        for (int k = 0; k < 3; ++k) {
          VariantLanes x(0.0);
          for (int s = 0; s < N; ++s) x += table_.stages_to_legendre(N - 1 - back, s) * stage_[s].accel[j][k];
          wanted_[j][k] = x;
        }
      std::fill(tail_.begin(), tail_.end(), VariantVec{});
      projector_.close(wanted_, tail_);
      size[back] = VariantLanes(0.0);
      for (std::size_t i = 0; i < n_; ++i)
        for (int k = 0; k < 3; ++k) size[back] = larger(size[back], mechanism_.bodies[i].mass[k] * over_scale_[i][k] * sizes(tail_[i][k]));
    }
    error = larger(of_bodies, kGapError * tail(size[0], size[1], size[2]));
  }

  // Eqs. (4.1)-(4.4).
  PINTLE_PART void finish(const VariantLanes& h) {
    const Stage& last = stage_[N - 1];
    nodes_.a[0] = begin_.a;
    nodes_.accel[0] = begin_.accel;
    nodes_.force[0] = begin_.force;
    for (int s = 0; s < N; ++s) {
      nodes_.a[s + 1] = stage_[s].a;
      nodes_.accel[s + 1] = stage_[s].accel;
      nodes_.force[s + 1] = stage_[s].force;
    }
    end_.t = begin_.t + h;
    end_.q = last.q;
    end_.v = last.v;
    end_.a = last.a;
    end_.accel = last.accel;
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t j = 0; j < r_.size(); ++j)
        for (int k = 0; k < 3; ++k) wanted_[j][k] = last.gap[j][k] - r_[j].gap[k];
      projector_.close(wanted_, end_.q);
      read(mechanism_, end_.t, end_.q, end_.v, m_, r_);
    }
    std::fill(move_.begin(), move_.end(), VariantVec{});
    for (int pass = 0; pass < 2; ++pass) {
      find_missing(mechanism_, r_, last.rate, &BatchJointKinematics::rate, move_, wanted_);
      projector_.close(wanted_, move_);
    }
    for (std::size_t i = 0; i < n_; ++i)
      for (int k = 0; k < 3; ++k) end_.v[i][k] += move_[i][k];
    read_rates(mechanism_, end_.t, end_.v, m_, r_);
    take_gaps(h);
    move_ = last.a;
    find_missing(mechanism_, r_, last.accel, &BatchJointKinematics::bias, move_, wanted_);
    projector_.close(wanted_, move_);
    mechanism_.external(end_.t, m_, loads_at_end_);  // those of the stage are from before its last correction
    projector_.improve_forces(loads_at_end_, move_, end_.force);
    nodes_.force[N] = end_.force;
  }

  // Eq. (4.3).
  PINTLE_LANES void take_gaps(const VariantLanes& h) {
    const Stage& last = stage_[N - 1];
    VariantLanes largest(1e-3);
    for (std::size_t i = 0; i < n_; ++i) largest = larger(largest, larger(sizes(end_.q[i][0]), sizes(end_.q[i][1])));
    const VariantLanes rounding = (16 * 2.220446049250313e-16) * largest, of_rate = rounding * reciprocal(h);
    const auto carried_or = [](const VariantLanes& carried, const VariantLanes& geometry, const VariantLanes& limit) { return where_larger(sizes(geometry - carried), limit, geometry, carried); };
    for (std::size_t j = 0; j < r_.size(); ++j) {
      for (int k = 0; k < 3; ++k) {
        end_.gap[j][k] = carried_or(last.gap[j][k], r_[j].gap[k], rounding);
        end_.rate[j][k] = carried_or(last.rate[j][k], r_[j].rate[k], of_rate);
      }
      end_.force[j] = BatchMechanism::law_force(mechanism_.joints[j], end_.gap[j], end_.rate[j]);
    }
  }

  BatchMechanism& mechanism_;
  const RadauTable& table_ = RadauTable::of(N);
  double tolerance_, of_newton_;
  std::size_t n_;
  BatchProjector projector_;
  BlockLu<VariantLanes, 3> real_;
  BlockLu<Pair, 3> pair_;
  BatchState begin_, end_;
  std::array<Stage, N> stage_;
  std::array<VariantVecs, N> missing_;
  std::vector<std::array<double, 3>> over_scale_, over_joint_;
  VariantVecs real_rhs_;
  std::vector<BlockVec<Pair, 3>> pair_rhs_;
  VariantVecs real_e_;
  std::vector<BlockVec<Pair, 3>> pair_e_;
  std::vector<BatchMotion> m_;
  std::vector<BatchJointKinematics> r_;
  std::vector<GapMap<VariantLanes>> frozen_;
  VariantVecs wanted_, move_, tail_, loads_at_end_;
  BatchNodes nodes_;
  BatchCurves curves_;
  VariantLanes mu_, mu2_, over_mu2_, worst_;
  Pair nu_, nu2_, over_nu2_;
  std::array<double, kVariantLanes> contraction_{};
  int iterations_ = 0;
  bool have_nodes_ = false;
  double last_share_ = 0;
};

}  // namespace pintle::PINTLE_BATCH

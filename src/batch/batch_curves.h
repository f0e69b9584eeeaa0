// The joint forces of variants along a step, and the largest of them. Does what DenseOutput and LoadRecorder do: theory/time section 5.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/cubic_hermite.h"
#include "batch/batch_projector.h"
#include "integrators/dense/force_samples.h"
#include "integrators/radau/radau_table.h"
#include "run/record/sampled_curve.h"

namespace pintle::PINTLE_BATCH {

/// Accelerations and joint forces at the nodes {0, c_1 .. c_n} of a step.
struct BatchNodes {
  std::array<VariantVecs, kBatchStages + 1> a, accel, force;

  BatchNodes(std::size_t bodies, std::size_t joints) {
    for (VariantVecs& x : a) x.resize(bodies + 1);
    for (auto* nodes : {&accel, &force})
      for (VariantVecs& x : *nodes) x.resize(joints);
  }
};

class BatchCurves {
 public:
  explicit BatchCurves(BatchMechanism& mechanism)
      : mechanism_(mechanism), projector_(mechanism), m_(mechanism.n_bodies() + 1), r_(mechanism.joints.size()),
        here_(mechanism.n_bodies(), mechanism.joints.size()), Q_(mechanism.n_bodies() + 1), wanted_(mechanism.joints.size()),
        move_(mechanism.n_bodies() + 1), peaks_(mechanism.joints.size()) {
    for (VariantVecs& x : sampled_) x.resize(mechanism.joints.size());
  }

  void forget() { std::fill(peaks_.begin(), peaks_.end(), BatchPeak{}); }
  /// Takes the start and the force there.
  PINTLE_PART void look_at(const VariantLanes& t, const VariantVecs& force) {
    for (std::size_t j = 0; j < peaks_.size(); ++j) {
      raise(peaks_[j].square, peaks_[j].time, force[j][0] * force[j][0] + force[j][1] * force[j][1], t);
      raise(peaks_[j].couple_square, peaks_[j].couple_time, force[j][2] * force[j][2], t);
    }
  }
  /// Takes a step.
  void look_along(const BatchState& begin, const BatchState& end, const BatchNodes& nodes) {
    find(begin, end, nodes);
    find_peaks(begin.t, end.t - begin.t);
  }
  const std::vector<BatchPeak>& peaks() const { return peaks_; }

 private:
  static constexpr int N = kBatchStages, kSamples = ForceSamples::kN;

  // The curves of the forces, through the ends of the step and samples inside it.
  PINTLE_PART void find(const BatchState& begin, const BatchState& end, const BatchNodes& nodes) {
    const VariantLanes h = end.t - begin.t, h2 = h * h, mu = table_.real_eigenvalue * reciprocal(h);
    sampled_[0] = begin.force;
    sampled_[kSamples + 1] = end.force;
    for (int i = 1; i <= kSamples; ++i) {
      const double x = samples_.x[i];
      const auto &value = samples_.value[i], &once = samples_.once[i], &twice = samples_.twice[i], &whole = samples_.once[kSamples + 1],
                 &whole_twice = samples_.twice[kSamples + 1];
      const auto combined = [](const ForceSamples::AtNodes& w, const VariantLanes* a) { return w[0] * a[0] + w[1] * a[1] + w[2] * a[2] + w[3] * a[3]; };
      const double hermite = cubic_blend(x);
      const auto along = [&](std::size_t count, const std::array<VariantVecs, N + 1>& of, const VariantVecs& x0, const VariantVecs& v0, const VariantVecs& x1,
                             const VariantVecs& v1, VariantVecs* position, VariantVecs& rate, VariantVecs* accel) {
        for (std::size_t b = 0; b < count; ++b)
          for (int k = 0; k < 3; ++k) {
            const VariantLanes a[N + 1] = {of[0][b][k], of[1][b][k], of[2][b][k], of[3][b][k]};
            const VariantLanes bend_v = v1[b][k] - v0[b][k] - h * combined(whole, a);
            rate[b][k] = v0[b][k] + x * bend_v + h * combined(once, a);
            if (accel) (*accel)[b][k] = combined(value, a);
            if (!position) continue;
            const VariantLanes bend_q = x1[b][k] - x0[b][k] - h * v0[b][k] - h2 * combined(whole_twice, a);
            (*position)[b][k] = x0[b][k] + x * h * v0[b][k] + hermite * bend_q + h2 * combined(twice, a);
          }
      };
      along(mechanism_.n_bodies(), nodes.a, begin.q, begin.v, end.q, end.v, &here_.q, here_.v, nullptr);
      along(r_.size(), nodes.accel, begin.gap, begin.rate, end.gap, end.rate, nullptr, here_.rate, &here_.accel);
      for (std::size_t j = 0; j < r_.size(); ++j)
        for (int k = 0; k < 3; ++k)
          here_.force[j][k] = value[0] * nodes.force[0][j][k] + value[1] * nodes.force[1][j][k] + value[2] * nodes.force[2][j][k] + value[3] * nodes.force[3][j][k];
      const VariantLanes t = begin.t + x * h;
      read(mechanism_, t, here_.q, here_.v, m_, r_);
      projector_.prepare(r_, mu);
      for (std::size_t j = 0; j < r_.size(); ++j)
        for (int k = 0; k < 3; ++k) wanted_[j][k] = here_.rate[j][k] - r_[j].rate[k];
      projector_.close(wanted_, here_.v);
      read_rates(mechanism_, t, here_.v, m_, r_);
      mechanism_.external(t, m_, Q_);
      projector_.balance(r_, Q_, here_.accel, here_.force, move_);
      sampled_[i] = here_.force;
    }
  }

  // theory/time Eq. (5.4)
  PINTLE_PART void find_peaks(const VariantLanes& t0, const VariantLanes& h) {
    for (std::size_t j = 0; j < peaks_.size(); ++j) {
      VariantLanes square[CurveGrid::kPoints], couple_square[CurveGrid::kPoints];
      for (int p = 0; p < CurveGrid::kPoints; ++p) {
        const CurveGrid::Weights& weight = grid_.at_point(p);
        VariantVec f;
        for (int c = 0; c < 3; ++c) {
          VariantLanes sum(0.0);
          for (int i = 0; i < kSamples + 2; ++i) sum += weight[static_cast<std::size_t>(i)] * sampled_[i][j][c];
          f[c] = sum;
        }
        square[p] = f[0] * f[0] + f[1] * f[1];
        couple_square[p] = f[2] * f[2];
      }
      find_peak(square, t0, h, peaks_[j].square, peaks_[j].time);
      find_peak(couple_square, t0, h, peaks_[j].couple_square, peaks_[j].couple_time);
    }
  }
  // The largest of the points of the grid and of the parabolas through three neighbours.
  PINTLE_LANES void find_peak(const VariantLanes* square, const VariantLanes& t0, const VariantLanes& h, VariantLanes& peak, VariantLanes& time) {
    constexpr double d = 1.0 / CurveGrid::kIntervals;
    for (int p = 1; p < CurveGrid::kPoints; ++p) {
      raise(peak, time, square[p], t0 + p * d * h);
      if (p == CurveGrid::kIntervals) break;
      const VariantLanes rise = square[p + 1] - square[p - 1], bend = 2.0 * square[p] - square[p + 1] - square[p - 1];
      const VariantLanes share = rise * reciprocal(2.0 * bend), top = square[p] + 0.25 * rise * share;
      raise(peak, time, where_larger(2.0 * bend, sizes(rise), top, square[p]), t0 + (VariantLanes(static_cast<double>(p)) + share) * d * h);
    }
  }
  PINTLE_LANES void raise(VariantLanes& peak, VariantLanes& time, const VariantLanes& square, const VariantLanes& t) {
    time = where_larger(square, peak, t, time);
    peak = larger(peak, square);
  }

  BatchMechanism& mechanism_;
  const RadauTable& table_ = RadauTable::of(N);
  const ForceSamples& samples_ = ForceSamples::of(table_);
  const CurveGrid grid_{ForceSamples::kAll};
  BatchProjector projector_;
  std::vector<BatchMotion> m_;
  std::vector<BatchJointKinematics> r_;
  BatchState here_;
  VariantVecs Q_, wanted_, move_;
  std::array<VariantVecs, kSamples + 2> sampled_;
  std::vector<BatchPeak> peaks_;
};

}  // namespace pintle::PINTLE_BATCH

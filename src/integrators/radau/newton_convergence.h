// Stopping criteria of Newton's iteration on the stage equations, from its contraction rate. theory/time section 3.4.
#pragma once

#include <algorithm>
#include <cmath>

namespace pintle {

/// Frozen Jacobians make good and bad iterations alternate: the contraction rate is taken over two of them, or from the last step.
class NewtonContraction {
 public:
  enum class Verdict { kGoOn, kDone, kHopeless };
  static constexpr int kMaxIterations = 14;   // iterations per step, at most
  static constexpr double kShare = 0.05;      // fraction of the tolerance left to the iteration
  static constexpr double kRounding = 1e-15;  // fraction of the loads: a smaller correction is rounding
  static constexpr double kGood = 0.15;       // contraction rate up to which Jacobians serve the next step. Halved or doubled: 5 % more factorisations and 1 % fewer iterations, or 4 % fewer factorisations and as many iterations

  /// Before a step's first iteration.
  void start() { last_ = before_last_ = seen_ = 0; }

  /// After iteration number `iteration`, from 0: judges the size of its correction, relative to the loads, against the tolerance.
  Verdict judge(int iteration, double correction, double tolerance) {
    const double size = correction / tolerance;
    if (!std::isfinite(size)) return Verdict::kHopeless;
    if (size * tolerance < kRounding) return Verdict::kDone;
    double rate = iteration == 0 ? std::pow(std::clamp(contraction_, 1e-3, kSlow), 0.8) : size / last_;
    if (iteration == 1) rate = std::max(rate, std::min(contraction_, std::sqrt(rate)));
    if (iteration > 1) rate = std::max(rate, std::sqrt(size / before_last_));
    if (iteration > 0) contraction_ = seen_ = rate;
    if (rate > 2 || (rate > 0.95 && iteration > 2)) return Verdict::kHopeless;
    before_last_ = last_;
    last_ = size;
    return rate < 1 && rate / (1 - rate) * size < kShare ? Verdict::kDone : Verdict::kGoOn;
  }

  /// The contraction rate observed last.
  double rate() const { return contraction_; }
  /// The rate observed in this step; 0: none, it took one iteration.
  double seen() const { return seen_; }
  /// Whether to renew Jacobians of an earlier step, or of laws whose tangents have changed since the first guess, at the current iterate.
  bool wants_new_jacobians() const { return seen_ > kGood; }

 private:
  static constexpr double kSlow = 0.9;        // largest contraction rate expected of a first iteration, after one that failed

  double last_ = 0, before_last_ = 0, contraction_ = 0.5, seen_ = 0;
};

}  // namespace pintle

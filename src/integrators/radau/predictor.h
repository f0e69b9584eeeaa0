// The first guess of a step's stages: the last step's curve goes on. theory/time section 3.2.
#pragma once

#include <cmath>

#include "integrators/radau/radau_table.h"
#include "laws/law.h"

namespace pintle {

/// Whether Newton's iteration linearises a law again: its tangents change on the way from a first guess to the solution. Not those of friction
/// without states: where its slip turns round within a step that the iteration solves all the same, the error estimate may not see the turn between
/// the stages. Three of 817 runs of the battery, all with such friction, were over their tolerance when the iteration solved those steps.
template <class S>
bool is_relinearized(const BasicLaw<S>& law) {
  return !law.as_linear() && !(law.has_friction() && law.n_states() == 0);
}

/// Whether steps are as long as Newton's method allows, and grow as fast.
enum class Steps { kAccurate, kLong };

/// Extrapolates the polynomial through the last nodes of a step into the next one, of the degree that serves best. In long steps their ratio tells
/// it: the full degree swings away. Otherwise it is full, or the one that would have served the last step better: beside laws that are linearised again
/// the full degree may carry their last bits, which the iteration has left, thousands of times as large into the next step.
class Predictor {
 public:
  explicit Predictor(Steps steps) : steps_(steps) {}

  /// Weights of the last step's nodes, at a share of a step that is `ratio` times as long.
  RadauTable::Vec weights(const RadauTable& table, double share, double ratio) const { return table.weights_of_last(degree(table, ratio) + 1, 1 + share * ratio); }

  /// After a step `ratio` times as long as the one before, with such a first correction [tolerances]: `error(weights)` is that of a guess with such
  /// weights at its end. No matter in long steps.
  template <class Error>
  void choose_degree(const RadauTable& table, double ratio, double first_correction, Error&& error) {
    if (steps_ == Steps::kLong || first_correction <= kFar) return;
    parabola_ = error(table.weights_of_last(kParabola + 1, 1 + ratio)) < error(table.weights(1 + ratio));
  }

 private:
  static constexpr double kFar = 10;  // tolerances: a first correction from which another degree may save an iteration. 0, 5 and 20 change steps and iterations of 21 models by 1.6 % at most
  static constexpr int kLine = 1, kParabola = 2;                      // degrees
  static constexpr double kLongForParabola = 1.3, kLongForLine = 1.8;  // ratio of long steps above which stages are guessed by a parabola, which takes the fewest iterations in steps that grow; above which by a line

  int degree(const RadauTable& table, double ratio) const {
    if (steps_ == Steps::kAccurate) return parabola_ ? kParabola : table.n;
    const double size = std::abs(ratio);
    return size > kLongForLine ? kLine : size > kLongForParabola ? kParabola : table.n;
  }

  Steps steps_;
  bool parabola_ = false;
};

}  // namespace pintle

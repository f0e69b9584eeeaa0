// The first guess of a step's stages: the last step's curve, extrapolated. theory/time section 3.2.
#pragma once

#include <cmath>

#include "integrators/radau/radau_table.h"
#include "laws/law.h"

namespace pintle {

/// Whether Newton's iteration relinearises a law: its tangents change between a first guess and the solution. Those of friction without states are
/// not renewed: where its slip reverses within a step that the iteration solves all the same, the error estimate may miss a reversal between the
/// stages. Three of 817 runs of the battery, all with such friction, exceeded their tolerance when the iteration solved those steps.
template <class S>
bool is_relinearized(const BasicLaw<S>& law) {
  return !law.as_linear() && !(law.has_friction() && law.n_states() == 0);
}

/// Whether steps are as long as Newton's method allows, and grow as fast as it allows.
enum class Steps { kAccurate, kLong };

/// Extrapolates the polynomial through the last nodes of a step into the next one, with the degree that works best. In long steps their ratio decides:
/// the full degree oscillates. Otherwise it is full, or the one that would have served the last step better: with relinearised laws the full degree may
/// amplify the last bits that the iteration has left thousands of times in the next step.
class Predictor {
 public:
  explicit Predictor(Steps steps) : steps_(steps) {}

  /// Weights of the last step's nodes, at a share of a step that is `ratio` times as long.
  RadauTable::Vec weights(const RadauTable& table, double share, double ratio) const { return table.weights_of_last(degree(table, ratio) + 1, 1 + share * ratio); }

  /// After a step `ratio` times as long as the one before, with this first correction [tolerances]: `error(weights)` is the error at its end of a
  /// guess with these weights. No effect in long steps.
  template <class Error>
  void choose_degree(const RadauTable& table, double ratio, double first_correction, Error&& error) {
    if (steps_ == Steps::kLong || first_correction <= kFar) return;
    parabola_ = error(table.weights_of_last(kParabola + 1, 1 + ratio)) < error(table.weights(1 + ratio));
  }

 private:
  static constexpr double kFar = 10;  // tolerances: above this first correction another degree may save an iteration. 0, 5 and 20 change steps and iterations of 21 models by 1.6 % at most
  static constexpr int kLine = 1, kParabola = 2;                      // degrees
  static constexpr double kLongForParabola = 1.3, kLongForLine = 1.8;  // ratio of long steps above which stages are guessed by a parabola, which takes the fewest iterations in steps that grow; ratio above which they are guessed by a line

  int degree(const RadauTable& table, double ratio) const {
    if (steps_ == Steps::kAccurate) return parabola_ ? kParabola : table.n;
    const double size = std::abs(ratio);
    return size > kLongForLine ? kLine : size > kLongForParabola ? kParabola : table.n;
  }

  Steps steps_;
  bool parabola_ = false;
};

}  // namespace pintle

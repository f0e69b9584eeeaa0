// The first guess of a step's stages: the last step's curve goes on. theory/time section 3.1.
#pragma once

#include "integrators/radau/radau_table.h"
#include "laws/law.h"

namespace pintle {

/// Whether the tangents of a law change on the way from a first guess to the solution, so that a better guess and new tangents help. Not those of friction
/// without states: where its slip turns round within a step that Newton's iteration solves all the same, the error estimate may not see the turn between
/// the stages. Three of 817 runs of the battery, all with such friction, were over their tolerance when the iteration solved those steps.
template <class S>
bool is_curved(const BasicLaw<S>& law) {
  return !law.as_linear() && !(law.has_friction() && law.n_states() == 0);
}

/// Where laws curve, or states of theirs are next to rest, the curve of full degree through the last step's nodes may carry their last bits, which the
/// iteration has left, thousands of times as large into the next step. Then a parabola through the last three nodes is the better guess. The last
/// step that was far off tells which.
class Predictor {
 public:
  /// Weights of the last step's nodes, at a share of a step that is `ratio` times as long.
  RadauTable::Vec weights(const RadauTable& table, double share, double ratio) const { return of_degree(table, parabola_, share, ratio); }

  /// After a step whose first correction was so large [tolerances]: `misfit(weights)` is by how much a guess with such weights misses its end.
  template <class Misfit>
  void compare(const RadauTable& table, double ratio, double first_correction, Misfit&& misfit) {
    if (first_correction > kFar) parabola_ = misfit(of_degree(table, true, 1, ratio)) < misfit(of_degree(table, false, 1, ratio));
  }

 private:
  static constexpr double kFar = 10;    // tolerances: a first correction that costs one iteration more than a good guess would
  static constexpr int kOfParabola = 3;  // nodes

  static RadauTable::Vec of_degree(const RadauTable& table, bool parabola, double share, double ratio) {
    return parabola ? table.weights_of_last(kOfParabola, 1 + share * ratio) : table.weights(1 + share * ratio);
  }

  bool parabola_ = false;
};

}  // namespace pintle

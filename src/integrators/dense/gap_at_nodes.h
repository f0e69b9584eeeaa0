// One component of a gap at the nodes of an implicit step, where its force is known.
#pragma once

#include <cstddef>

#include "integrators/radau/step_nodes.h"
#include "system/state.h"

namespace pintle {

struct GapAtNodes {
  double gap[RadauTable::kMaxNodes], rate[RadauTable::kMaxNodes];  // of the stages, theory/time Eq. (3.5), and at the end of the step

  template <class S>
  static GapAtNodes of(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes, std::size_t joint, int component) {
    const int n = nodes.table->n;
    GapAtNodes at;
    at.gap[0] = begin.gap[joint][component];
    at.rate[0] = begin.gap_rate[joint][component];
    for (int i = 0; i + 1 < n; ++i) {
      double once = 0;
      for (int s = 0; s < n; ++s) once += nodes.table->A(i, s) * nodes.gap_accel[s + 1][joint][component];
      at.rate[i + 1] = at.rate[0] + (end.t - begin.t) * once;
      at.gap[i + 1] = of_stage(i, begin, end, nodes, joint, component);
    }
    at.gap[n] = end.gap[joint][component];
    at.rate[n] = end.gap_rate[joint][component];
    return at;
  }

  /// The gap as integrated to the end of the step, before it may have been taken from the bodies there.
  template <class S>
  static double of_last_stage(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes, std::size_t joint, int component) {
    return of_stage(nodes.table->n - 1, begin, end, nodes, joint, component);
  }

 private:
  template <class S>
  static double of_stage(int stage, const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes, std::size_t joint, int component) {
    const double h = end.t - begin.t;
    double twice = 0;
    for (int s = 0; s < nodes.table->n; ++s) twice += nodes.table->A2(stage, s) * nodes.gap_accel[s + 1][joint][component];
    return begin.gap[joint][component] + nodes.table->c[stage] * h * begin.gap_rate[joint][component] + h * h * twice;
  }
};

}  // namespace pintle

// One component of a gap at the nodes of an implicit step, where its force is known.
#pragma once

#include <utility>

#include "integrators/radau/step_nodes.h"
#include "system/state.h"

namespace pintle {

struct GapAtNodes {
  double gap[RadauTable::kMaxNodes], rate[RadauTable::kMaxNodes];  // of the stages, theory/time Eq. (3.5), and at the end of the step
  double integrated;                                               // the gap of the last stage, before the end took it from the bodies

  template <class S>
  static GapAtNodes of(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes, std::size_t joint, int component) {
    const RadauTable& table = *nodes.table;
    const double h = end.t - begin.t;
    GapAtNodes at;
    at.gap[0] = begin.gap[joint][component];
    at.rate[0] = begin.gap_rate[joint][component];
    for (int i = 0; i < table.n; ++i) {
      double once = 0, twice = 0;
      for (int s = 0; s < table.n; ++s) {
        once += table.A(i, s) * nodes.gap_accel[s + 1][joint][component];
        twice += table.A2(i, s) * nodes.gap_accel[s + 1][joint][component];
      }
      at.rate[i + 1] = at.rate[0] + h * once;
      at.gap[i + 1] = at.gap[0] + table.c[i] * h * at.rate[0] + h * h * twice;
    }
    at.integrated = std::exchange(at.gap[table.n], end.gap[joint][component]);
    at.rate[table.n] = end.gap_rate[joint][component];
    return at;
  }
};

}  // namespace pintle

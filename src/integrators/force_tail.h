// The error of joint forces that the loads of the bodies do not show. theory/time Eq. (3.21).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "integrators/load_scale.h"
#include "integrators/radau/radau_table.h"
#include "integrators/radau/step_error.h"
#include "system/system.h"

namespace pintle {

template <class S>
class BasicForceTail {
 public:
  /// Watches those of the joints whose law has no states: friction that may act on next to no mass, in the components that rub; and laws that hold their joint
  /// by more than a spring and a damper, such as those of leaf springs, whose joints may load each other while hardly anything moves.
  BasicForceTail(const BasicSystem<S>& system, const std::vector<int>& joints) : system_(system) {
    for (const int j : joints) {
      const BasicLaw<S>& law = system.joints[j].law;
      if (law.n_states() > 0) continue;
      const bool bends = std::any_of(law.parts().begin(), law.parts().end(), [](const auto& part) { return part->holds() && !part->stops() && !part->starts_free(); });
      if (bends) watched_.emplace_back(j, S::Vec::Ones());
      else if (law.has_friction()) watched_.emplace_back(j, (law.engaged_stiffness().array() > 0).select(S::Vec::Zero(), S::Vec::Ones()));
    }
  }

  /// Over the load scale. force_at(node, j): the force of joint j at the start of the step, node 0, and at its n stages.
  template <class ForceAt>
  double size(const RadauTable& table, const BasicLoadScale<S>& scale, const ForceAt& force_at) const {
    std::array<double, 3> largest{};
    double sum = 0;  // finite if all are
    for (const auto& [j, counts] : watched_) {
      const typename S::Vec load = load_on(system_.joints[j].at, scale);
      for (int back = 0; back < 3; ++back) {
        typename S::Vec tail = S::Vec::Zero();
        for (int node = 0; node <= table.n; ++node) tail += table.to_legendre(table.n - back, node) * force_at(node, j);
        const double relative = tail.cwiseProduct(counts).cwiseQuotient(load).cwiseAbs().maxCoeff();
        largest[static_cast<std::size_t>(back)] = std::max(largest[static_cast<std::size_t>(back)], relative);
        sum += tail.sum();
      }
    }
    return std::isfinite(sum) ? tail_size(largest[0], largest[1], largest[2]) : std::numeric_limits<double>::infinity();
  }

 private:
  const BasicSystem<S>& system_;
  std::vector<std::pair<int, typename S::Vec>> watched_;  // joints, and 1 in the components that count
};

}  // namespace pintle

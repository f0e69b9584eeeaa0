// Flexure joints that a run has taken to where their blades have no equilibrium.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

template <class S>
class BasicLostEquilibria {
 public:
  /// Watches the joints whose law reports this, in a column called `equilibrium`.
  explicit BasicLostEquilibria(const BasicSystem<S>& system) : system_(system) {
    for (int j = 0; j < system.n_joints(); ++j) {
      const std::vector<LawColumn> columns = system.joints[j].law.columns();
      const auto found = std::find_if(columns.begin(), columns.end(), [](const LawColumn& c) { return c.name == "equilibrium"; });
      if (found != columns.end()) joints_.push_back({j, static_cast<std::size_t>(found - columns.begin())});
    }
  }
  /// Call at the end of a step, or at an output row inside it, before its end.
  void see(const BasicState<S>& state) {
    for (Joint& joint : joints_) {
      if (state.t >= joint.lost_at) continue;
      values_.clear();
      system_.joints[joint.index].law.observe(law_point(system_, joint.index, state), state.force[joint.index], values_);
      if (!(values_[joint.column] > 0)) joint.lost_at = state.t;
    }
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    for (const Joint& joint : joints_)
      if (std::isfinite(joint.lost_at))
        notes.push_back(fmt::format("joint {} lost its equilibrium at t = {:.5g} s (its blade would snap, or is bent or stretched too far): from then on its force is that of small deflections, not the blade's own",
                                    system_.joints[joint.index].name, joint.lost_at));
    return notes;
  }

 private:
  struct Joint {
    int index;
    std::size_t column;  // among the law's columns
    double lost_at = std::numeric_limits<double>::infinity();  // the earliest time seen [s]
  };

  const BasicSystem<S>& system_;
  std::vector<Joint> joints_;
  std::vector<double> values_;  // reused so that steps do not allocate
};

}  // namespace pintle

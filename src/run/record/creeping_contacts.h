// Contacts that a run ends with while their damping still holds them back: loads that others share with them have not come to them yet.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

template <class S>
class BasicCreepingContacts {
 public:
  /// Of the laws that tell an approach speed.
  explicit BasicCreepingContacts(const BasicSystem<S>& system) : system_(system) {
    for (int j = 0; j < system.n_joints(); ++j) {
      const std::vector<LawColumn> columns = system.joints[j].law.columns();
      if (std::any_of(columns.begin(), columns.end(), [](const LawColumn& c) { return c.name == "approach_speed"; })) joints_.push_back(j);
    }
  }
  /// The end of a run that began at `begin` [s].
  void see_end(const BasicState<S>& state, double begin) {
    for (const int j : joints_) {
      BasicLawTangents<S> law;
      system_.joints[j].law.linearize(law_point(system_, j, state), law);
      const double force = state.force[j].template head<S::kDim>().norm();
      for (int k = 0; k < S::kDim; ++k) {
        const double stiffness = std::abs(law.stiffness(k, k)), damping = std::abs(law.damping(k, k));
        if (!(stiffness > 0) || !(force > 0)) continue;
        const double share = damping * std::abs(state.gap_rate[j][k]) / force, within = damping / stiffness;
        if (share > kShare && within > kSlow * (state.t - begin)) creeping_.push_back({j, share, within});
      }
    }
  }
  std::vector<std::string> notes() const {
    if (creeping_.empty()) return {};
    std::string names;
    double share = 0, within = 0;
    for (const Creeping& one : creeping_) {
      const std::string& name = system_.joints[static_cast<std::size_t>(one.joint)].name;
      if (names.size() < name.size() || names.substr(names.size() - name.size()) != name) names += (names.empty() ? "" : ", ") + name;
      share = std::max(share, one.share);
      within = std::max(within, one.within);
    }
    return {fmt::format("contacts that have not come to rest under their load at the end ({}): up to {:.2g} of their force is damping, which lets them follow it within {:.2g} s only, and what others share with them is on its way. "
                        "A contact that is loaded slowly is damped as by an impact at least_approach_speed; with a larger one, or a restitution nearer to 1, it follows sooner",
                        names, share, within)};
  }

 private:
  static constexpr double kShare = 0.02, kSlow = 0.02;  // of the force; of the run
  struct Creeping {
    int joint;
    double share, within;  // of its force; [s]
  };

  const BasicSystem<S>& system_;
  std::vector<int> joints_;
  std::vector<Creeping> creeping_;
};

}  // namespace pintle

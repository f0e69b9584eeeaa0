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
    std::vector<std::string> notes;
    for (const Creeping& one : creeping_)
      notes.push_back(fmt::format("joint {}: at the end {:.2g} of its force is damping, which lets the contact follow its load within {:.2g} s only: what others share with it has not come to it yet. "
                                  "A contact that is loaded slowly is damped as by an impact at least_approach_speed; a larger one, or a restitution nearer to 1, lets it follow sooner",
                                  system_.joints[static_cast<std::size_t>(one.joint)].name, one.share, one.within));
    return notes;
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

// Joints whose friction held them from the first step of a run to the last: a table of forces alone does not show that they are jammed.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

template <class S>
class BasicStuckJoints {
 public:
  /// Those with a law that says whether they stick: by columns called `friction` and `stuck`.
  explicit BasicStuckJoints(const BasicSystem<S>& system) : system_(system) {
    for (int j = 0; j < system.n_joints(); ++j) {
      const std::vector<LawColumn> columns = system.joints[j].law.columns();
      const auto find = [&columns](const char* name) { return std::find_if(columns.begin(), columns.end(), [name](const LawColumn& c) { return c.name == name; }); };
      if (find("stuck") == columns.end() || find("friction") == columns.end()) continue;
      held_.push_back({j, static_cast<std::size_t>(find("friction") - columns.begin()), static_cast<std::size_t>(find("stuck") - columns.begin()), find("friction")->unit});
    }
  }
  /// The end of a step, or an output row.
  void see(const BasicState<S>& state) {
    for (Joint& joint : held_) {
      if (!joint.stuck) continue;
      values_.clear();
      system_.joints[joint.index].law.observe(law_point(system_, joint.index, state), state.force[joint.index], values_);
      joint.stuck = values_[joint.at_stuck] > 0;
      joint.friction = std::max(joint.friction, std::abs(values_[joint.at_friction]));
      joint.force = std::max(joint.force, state.force[joint.index].cwiseProduct(typename S::Vec(S::Vec::Ones() - system_.joints[joint.index].free_mask)).norm());
    }
  }
  /// One for each joint that never slipped although its friction had something to carry.
  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    for (const Joint& joint : held_) {
      const double lever = system_.joints[joint.index].law.lever();
      if (!joint.stuck || !(joint.friction > kCarries * joint.force * (lever > 0 ? lever : 1))) continue;
      notes.push_back(fmt::format("joint {} is jammed: it would move without its friction, which held it for the whole run and carried up to {:.4g} {}",
                                  system_.joints[joint.index].name, joint.friction, joint.unit));
    }
    return notes;
  }

 private:
  static constexpr double kCarries = 1e-6;  // of the joint's force: less is rounding
  struct Joint {
    int index;
    std::size_t at_friction, at_stuck;  // among the law's columns
    std::string unit;
    bool stuck = true;
    double friction = 0, force = 0;  // the largest; of what is held
  };

  const BasicSystem<S>& system_;
  std::vector<Joint> held_;
  std::vector<double> values_;  // reused so that steps do not allocate
};

}  // namespace pintle

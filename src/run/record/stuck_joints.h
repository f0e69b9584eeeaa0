// Joints that friction holds from the first step of a run to the last, or through the last half of it: a table of forces alone does not show that they
// have jammed or come to rest.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

template <class S>
class BasicStuckJoints {
 public:
  /// Watches the joints whose law reports whether they stick, in columns called `friction` and `stuck`.
  explicit BasicStuckJoints(const BasicSystem<S>& system) : system_(system) {
    for (int j = 0; j < system.n_joints(); ++j) {
      if (system.joints[j].ideal) continue;
      const std::vector<LawColumn> columns = system.joints[j].law.columns();
      const auto find = [&columns](const char* name) { return std::find_if(columns.begin(), columns.end(), [name](const LawColumn& c) { return c.name == name; }); };
      if (find("stuck") == columns.end() || find("friction") == columns.end()) continue;
      held_.push_back({j, static_cast<std::size_t>(find("friction") - columns.begin()), static_cast<std::size_t>(find("stuck") - columns.begin()), find("friction")->unit});
    }
  }
  /// Call at the end of a step, or at an output row.
  void see(const BasicState<S>& state) {
    if (!begin_) begin_ = state.t;
    end_ = state.t;
    largest_ = std::max(largest_, largest_force(state.force));
    for (Joint& joint : held_) {
      values_.clear();
      system_.joints[joint.index].law.observe(law_point(system_, joint.index, state), state.force[joint.index], values_);
      const bool stuck = values_[joint.at_stuck] > 0;
      if (stuck && !joint.since) joint = {joint.index, joint.at_friction, joint.at_stuck, joint.unit, state.t};
      if (!system_.joints[joint.index].law.breach(state.gap[joint.index])) joint.by_stop = false;
      if (!stuck) joint.since.reset();
      if (!stuck) continue;
      joint.friction = std::max(joint.friction, std::abs(values_[joint.at_friction]));
      joint.force = std::max(joint.force, state.force[joint.index].cwiseProduct(typename S::Vec(S::Vec::Ones() - system_.joints[joint.index].free_mask)).norm());
    }
  }
  /// One for each joint that no longer slips although its friction carries a load and no stop holds it.
  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    for (const Joint& joint : held_) {
      const double lever = system_.joints[joint.index].law.lever();
      if (!joint.since || joint.by_stop || end_ - *joint.since < kLong * (end_ - *begin_) || !(joint.friction > kCarries * std::max(joint.force, kCarries * largest_) * (lever > 0 ? lever : 1))) continue;
      const std::string& name = system_.joints[joint.index].name;
      if (*joint.since == *begin_) notes.push_back(fmt::format("joint {} never slips: its friction holds it for the whole run, and carries up to {:.4g} {}; if it was to move, it is jammed", name, joint.friction, joint.unit));
      else notes.push_back(fmt::format("joint {} sticks from t = {:.5g} s to the end: its friction has carried up to {:.4g} {} since then", name, *joint.since, joint.friction, joint.unit));
    }
    return notes;
  }

 private:
  static constexpr double kCarries = 1e-6;  // fraction of the joint's force, or of this fraction of the largest force: less is roundoff
  static constexpr double kLong = 0.5;      // fraction of the run for which a joint has to stick for a note
  struct Joint {
    int index;
    std::size_t at_friction, at_stuck;  // among the law's columns
    std::string unit;
    std::optional<double> since{};  // when it began to stick [s]
    double friction = 0, force = 0;  // the largest friction; the largest force in the held components
    bool by_stop = true;             // it has rested on a stop ever since then
  };

  const BasicSystem<S>& system_;
  std::vector<Joint> held_;
  std::optional<double> begin_;  // first time seen [s]
  double end_ = 0, largest_ = 0;  // last time seen [s]; largest joint force [N]
  std::vector<double> values_;  // reused so that steps do not allocate
};

}  // namespace pintle

// Rollers that have run beyond the part of their edge that was checked for corners and hollows.
#pragma once

#include <fmt/format.h>

#include <string>
#include <variant>
#include <vector>

#include "joints/edge_profile.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicEdgeOverruns {
 public:
  explicit BasicEdgeOverruns(const BasicSystem<S>& system) : system_(system) {
    if constexpr (S::kDim == 2)
      for (int j = 0; j < system.n_joints(); ++j)
        if (std::holds_alternative<EdgeGap>(system.joints[static_cast<std::size_t>(j)].displacement)) inside_.push_back(j);
  }
  /// Call at the end of a step, or at an output row inside it, before its end. A roller lifted off its edge touches nothing there.
  void see(const BasicState<S>& state) {
    if constexpr (S::kDim == 2) {
      if (inside_.empty()) return;
      system_.motions(state.q, state.v, m_);
      std::erase_if(inside_, [&](int j) {
        const BasicJointData<S>& joint = system_.joints[static_cast<std::size_t>(j)];
        if (!(joint.law.penetration(state.gap[static_cast<std::size_t>(j)]) > 0)) return false;
        const EdgeProfile& edge = *std::get<EdgeGap>(joint.displacement).profile;
        const typename S::Vec z = system_.pose(joint.at, m_).z;
        if (z[0] - edge.roller_radius() >= edge.from() && z[0] + edge.roller_radius() <= edge.to()) return false;  // it cannot touch farther away
        const double x = edge.nearest({z[0], z[1]});
        if (x >= edge.from() && x <= edge.to()) return false;
        notes_.push_back(fmt::format("joint {}: from t = {:.4g} s on it runs beyond its edge ({} = {:.4g} m), where the edge has not been checked for corners, or for hollows that the roller does not fit into: extend from and to as far as it runs",
                                     joint.name, state.t, x < edge.from() ? "from" : "to", x < edge.from() ? edge.from() : edge.to()));
        return true;
      });
    }
  }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  const BasicSystem<S>& system_;
  std::vector<int> inside_;  // joints whose roller has not left its edge
  std::vector<std::string> notes_;
  std::vector<typename S::Motion> m_;
};

}  // namespace pintle

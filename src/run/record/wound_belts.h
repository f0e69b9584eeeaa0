// Belts and ropes that a run has wound up to their end, or whose discs have met.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "joints/belt.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicWoundBelts {
 public:
  explicit BasicWoundBelts(const BasicSystem<S>& system) : system_(system) {
    if constexpr (S::kDim == 2)
      for (int j = 0; j < system.n_joints(); ++j)
        if (const auto belt = belt_of(system.joints[static_cast<std::size_t>(j)].displacement)) belts_.push_back({j, *belt});
  }
  /// Call at the end of a step, or at an output row inside it, before its end.
  void see(const BasicState<S>& state) {
    if constexpr (S::kDim == 2) {
      if (belts_.empty()) return;
      system_.motions(state.q, state.v, m_);
      for (Wound& one : belts_) {
        const double run = one.belt.run(system_.pose(system_.joints[static_cast<std::size_t>(one.joint)].at, m_).z);
        if (run < one.shortest) one.shortest = run, one.at = state.t;
      }
    }
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    for (const Wound& one : belts_)
      if (one.shortest < kEnd * std::max(std::abs(one.belt.radius_first), std::abs(one.belt.radius_second)))
        notes.push_back(fmt::format("joint {}: its free run is down to {:.3g} m at t = {:.4g} s, where its end has reached its disc; a real belt would have stopped there, and the motion after that runs past the disc",
                                    system_.joints[static_cast<std::size_t>(one.joint)].name, one.shortest, one.at));
    return notes;
  }

 private:
  static constexpr double kEnd = 0.05;  // fraction of the larger radius: with a shorter free run, a belt's end has come to its disc, up to 1.2e-3 radii beside the line of the run
  struct Wound {
    int joint;
    Belt belt;
    double shortest = std::numeric_limits<double>::infinity(), at = 0;  // the free run [m], when [s]
  };

  const BasicSystem<S>& system_;
  std::vector<Wound> belts_;
  std::vector<typename S::Motion> m_;
};

}  // namespace pintle

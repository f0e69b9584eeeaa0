// The borders of laws for methods that do not search a step's curve for events: looked at where a step ends.
#pragma once

#include <algorithm>
#include <vector>

#include "system/state.h"

namespace pintle {

class LawBorders {
 public:
  explicit LawBorders(const System& system) : system_(system), before_(system.switching().size()), after_(before_) {}

  /// The values at the state that a step begins with.
  void start(const State& state) {
    if (!before_.empty()) find(state, before_);
  }
  /// The share of a step that ends at `end` after which the first border of a law is crossed, on a straight line; 1: none is.
  double first_crossing(const State& end) {
    double share = 1;
    if (before_.empty()) return share;
    find(end, after_);
    for (std::size_t f = 0; f < after_.size(); ++f) {
      const SwitchingFunction& function = system_.switching()[f];
      if (function.owner == SwitchingFunction::Owner::kLaw && function.is_event(before_[f], after_[f])) share = std::min(share, before_[f] / (before_[f] - after_[f]));
    }
    return share;
  }
  /// Lets the laws set their states where the step that ends at `end` has crossed their borders; what they store less then is dissipated. Whether
  /// any has: forces are to be found anew, and what was remembered of the step's curve does not go on.
  bool cross(State& end) {
    if (before_.empty()) return false;
    find(end, after_);
    const bool crossed = system_.cross_borders(end.t, end.gap, end.gap_rate, before_.data(), after_.data(), end.law_state, end.dissipated);
    if (crossed) find(end, before_);
    else before_.swap(after_);
    return crossed;
  }

 private:
  void find(const State& at, std::vector<double>& value) {
    system_.motions(at.q, at.v, m_);
    system_.find_switching(at.t, m_, at.gap, at.gap_rate, at.law_state, at.sliding, value.data());
  }

  const System& system_;
  std::vector<double> before_, after_;
  std::vector<Planar::Motion> m_;
};

/// A step that crosses a border is made anew so much shorter that it ends just behind it, so often at most.
inline constexpr int kMostShortened = 12;
/// So much of a step may lie behind a border.
inline constexpr double kBehindBorder = 1e-3;

}  // namespace pintle

// The borders of laws for methods that do not search a step's curve for events: looked at where a step ends.
#pragma once

#include <algorithm>
#include <vector>

#include "integrators/law_crossings.h"
#include "system/state.h"

namespace pintle {

class LawBorders {
 public:
  explicit LawBorders(const System& system) : system_(system), before_(system.switching().size()), after_(before_) {}

  /// The values at the state that a step begins with.
  void start(const State& state) {
    if (!before_.empty()) find(state, before_);
  }
  /// Whether a step of h that ends at `end` ends before the first border that sets a law's states, or close enough behind it; otherwise h is made shorter
  /// for another trial. `tries` counts those of one step.
  bool is_short_enough(const State& end, double& h, int& tries) {
    const double share = first_crossing(end);
    if (tries == 0) longest_ = h;
    if (share >= 1 - kBehind || share * h < kShortest * longest_ || tries >= kMostTries) return true;
    ++tries;
    h *= share + 0.5 * kBehind;
    return false;
  }
  /// Lets the laws set their states where the step that ends at `end` has crossed their borders; what they store less then is dissipated. Whether
  /// any has: forces are to be found anew, what was remembered of the step's curve does not go on, and `note` must follow.
  bool cross(State& end) {
    if (before_.empty()) return false;
    find(end, after_);
    const bool crossed = system_.cross_borders(end.t, end.gap, end.gap_rate, before_.data(), after_.data(), end.law_state, end.dissipated);
    if (!crossed) before_.swap(after_);
    return crossed;
  }
  /// The end with the forces that it has then: what has been crossed is noted there.
  void note(const State& end) {
    note_crossings(system_, end, before_.data(), after_.data(), crossings_);
    find(end, before_);
  }
  const std::vector<LawCrossing>& crossings() const { return crossings_; }

 private:
  static constexpr int kMostTries = 12;
  static constexpr double kBehind = 1e-3;    // of a step: so much may lie behind a border
  static constexpr double kShortest = 1e-7;  // of the first trial: what is crossed so early has been met already

  // The share of the step after which the first border of a law with states is crossed, on a straight line; 1: none is.
  double first_crossing(const State& end) {
    double share = 1;
    if (before_.empty()) return share;
    find(end, after_);
    for (std::size_t f = 0; f < after_.size(); ++f) {
      const SwitchingFunction& function = system_.switching()[f];
      if (sets_states(function) && function.is_event(before_[f], after_[f])) share = std::min(share, before_[f] / (before_[f] - after_[f]));
    }
    return share;
  }
  bool sets_states(const SwitchingFunction& function) const {
    return function.owner == SwitchingFunction::Owner::kLaw && system_.joints[static_cast<std::size_t>(function.index)].law.parts()[static_cast<std::size_t>(function.part)]->n_states() > 0;
  }
  void find(const State& at, std::vector<double>& value) {
    system_.motions(at.q, at.v, m_);
    system_.find_switching(at.t, m_, at.gap, at.gap_rate, at.law_state, at.sliding, value.data());
  }

  const System& system_;
  std::vector<double> before_, after_;
  std::vector<Planar::Motion> m_;
  std::vector<LawCrossing> crossings_;
  double longest_ = 0;  // first trial of a step [s]
};

}  // namespace pintle

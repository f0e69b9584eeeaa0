// The borders of laws for methods that do not search a step's curve for events: checked where a step ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "integrators/law_crossings.h"
#include "integrators/thresholds.h"
#include "system/state.h"

namespace pintle {

class LawBorders {
 public:
  explicit LawBorders(const System& system) : system_(system), before_(system.switching_functions().size()), behind_(before_) {}

  /// The run begins here.
  void start(const State& state) {
    crossed_ = false;
    if (!before_.empty()) find(state, before_);
  }
  void begin_step() { n_shortened_ = 0; }
  /// Shortens h where the step of h that ends at `end` goes too far beyond the first border at which a law sets its states. It is to be repeated.
  bool shorten(const State& end, double& h) {
    const double share = first_crossing(end);
    if (n_shortened_ == 0) longest_ = h;
    const bool already_crossed = share * h < std::max(kShortest * longest_, kTimeResolved * kLastBits * std::abs(end.t));
    if (share >= 1 - kBehind || already_crossed || n_shortened_ >= kMostShortened) return false;
    ++n_shortened_;
    h *= share + 0.5 * kBehind;
    return true;
  }
  /// Whether this step has been shortened: its length is then no guide to the next one's.
  bool has_shortened() const { return n_shortened_ > 0; }
  /// Lets the laws set their states where the step that ends at `end` has crossed their borders; energy that they store less then is dissipated.
  /// Returns whether any has: then forces must be recomputed, the step's curve does not continue into the next step, and `record` must follow.
  bool cross(State& end) {
    if (before_.empty()) return false;
    find(end, behind_);
    if (is_border_between(system_, before_.data(), behind_.data())) before_event_ = end;
    crossed_ = system_.cross_borders(end.t, end.gap, end.gap_rate, before_.data(), behind_.data(), end.law_state, end.dissipated);
    if (!crossed_) before_.swap(behind_);
    return crossed_;
  }
  /// `end`, or the state before the laws set their states there: where the curve of the step ends.
  const State& before_event(const State& end) const { return crossed_ ? before_event_ : end; }
  bool crossed() const { return crossed_; }
  /// Records what has been crossed, with the forces at the end after it.
  void record(const State& end) {
    record_crossings(system_, end, before_.data(), behind_.data(), crossings_);
    find(end, before_);
  }
  const std::vector<LawCrossing>& crossings() const { return crossings_; }

 private:
  static constexpr int kMostShortened = 12;  // times that one step is shortened for borders, at most
  static constexpr double kBehind = 1e-3;    // fraction of a step that may lie beyond a border
  static constexpr double kShortest = 1e-7;  // fraction of the first attempt: a border crossed this early has been dealt with already

  static constexpr double kTimeResolved = 16;  // last bits of the time: the same for a border crossed this early

  // The share of the step at which the first border of a law with states is crossed, by linear interpolation; 1: none is.
  double first_crossing(const State& end) {
    double share = 1;
    if (before_.empty()) return share;
    find(end, behind_);
    for (std::size_t f = 0; f < behind_.size(); ++f)
      if (system_.switching_functions()[f].is_crossing(before_[f], behind_[f])) share = std::min(share, before_[f] / (before_[f] - behind_[f]));
    return share;
  }
  void find(const State& at, std::vector<double>& value) {
    system_.motions(at.q, at.v, m_);
    system_.evaluate_switching_functions(at.t, m_, at.gap, at.gap_rate, at.law_state, at.sliding, value.data());
  }

  const System& system_;
  std::vector<double> before_, behind_;  // values at the step's start and at its end
  std::vector<Planar::Motion> m_;
  std::vector<LawCrossing> crossings_;
  State before_event_;  // the end of the last step before laws set their states there, if they did
  bool crossed_ = false;
  int n_shortened_ = 0;
  double longest_ = 0;  // first attempt at a step [s]
};

}  // namespace pintle

// Locates the first event (border, kink or jump) on a step's polynomial. theory/time section 7.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "integrators/radau/radau_table.h"
#include "system/switching_function.h"

namespace pintle {

/// Shares of the step just before and just after an event; 2: no event.
struct SwitchingEvent {
  double before = 2, after = 2;
  int function = -1;    // which switching function
  bool rising = false;  // it turns positive
  double t = 0;         // [s]
};

/// Fills the values of all switching functions at a share of a step: a reference to any callable (double share, double* value).
class SwitchingValues {
 public:
  template <class F>
    requires(!std::same_as<std::remove_cvref_t<F>, SwitchingValues>)
  SwitchingValues(const F& find) : object_(&find), call_([](const void* object, double x, double* value) { (*static_cast<const F*>(object))(x, value); }) {}
  void operator()(double share, double* value) const { call_(object_, share, value); }

 private:
  const void* object_;
  void (*call_)(const void*, double, double*);
};

/// Finds events and steps over them. Keeps the values at the start of the step.
class EventSearch {
 public:
  /// Keeps a reference to `functions`.
  explicit EventSearch(const std::vector<SwitchingFunction>& functions);

  /// The values at the start of the step, to be filled in at the end of the previous one.
  double* start() { return start_.data(); }
  std::span<const double> start() const { return start_; }
  /// The values at the end of the step, or just beyond the event that step_over has crossed; they are compared with those at the start.
  double* end() { return row(kMostSamples); }
  /// The next step begins where this one ends.
  void restart() { std::copy_n(end(), start_.size(), start_.data()); }

  /// Evaluates the nodes and the points half-way between them, and points where parabolas through the values suggest that a function
  /// crosses zero and returns; then locates the first event found.
  SwitchingEvent first(const RadauTable& table, SwitchingValues values_at);

  /// Moves by `distance` and a little `beyond` by move(d, value), which moves by d and fills in the values there; farther while the sign
  /// of the event's function has not changed. False if it still has not.
  template <class Move>
  bool step_over(const SwitchingEvent& event, double distance, double beyond, const Move& move);

 private:
  static constexpr int kMostSamples = 2 * RadauTable::kMaxStages + 1;
  static constexpr int kLevels = 3;       // how many times an interval may be split at an extremum
  static constexpr int kTrials = 3;       // points of the bracket around an event: its two ends and the trial between them
  static constexpr int kMoves = 5;        // moves to get past an event, at most
  static constexpr double kFarther = 10;  // largest ratio of a move to the previous one

  struct Sample {
    double share;
    double* value;
  };
  double* row(int i) { return values_.data() + static_cast<std::size_t>(i) * start_.size(); }
  bool has_event(const Sample& from, const Sample& to) const;
  double extremum(const Sample* before, const Sample& left, const Sample& right, const Sample* beyond) const;
  bool search(const Sample* before, const Sample& left, const Sample& right, const Sample* beyond, int level, SwitchingValues values_at, SwitchingEvent& event);
  int first_crossing(const Sample& low, const Sample& high, double& share) const;
  SwitchingEvent locate(const Sample& left, const Sample& right, SwitchingValues values_at);

  const std::vector<SwitchingFunction>& functions_;
  std::vector<double> start_;
  std::vector<double> values_;  // a row each for the samples, the end, the extrema of each level and the trials
};

template <class Move>
bool EventSearch::step_over(const SwitchingEvent& event, double distance, double beyond, const Move& move) {
  double* const now = end();
  const double before = start_[event.function];
  double gone = 0, next = distance + beyond;
  for (int i = 0; i < kMoves; ++i) {
    move(next, now);
    gone += next;
    const double value = now[event.function];
    if ((value > 0) == event.rising) return true;
    const double left = gone * value / (before - value);  // to zero, by linear extrapolation
    beyond *= kFarther;
    next = left > 0 && left < beyond ? left + beyond / kFarther : beyond;
  }
  return false;
}

}  // namespace pintle

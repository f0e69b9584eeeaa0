// Steps look at what they pass: a notch, a bump of an edge or the lift of a cam may be shorter than the way between two stages, and a blow
// shorter than the time. theory/time section 3.4.
#pragma once

#include <array>
#include <vector>

#include "base/bends.h"
#include "integrators/load_scale.h"
#include "system/system.h"

namespace pintle {

/// The bends of all loads, motors and driven lengths that are functions of time alone, each at 2000 intervals of the time between two instants [s].
template <class S>
std::vector<Bends> bends_in_time(const BasicSystem<S>& system, double from, double to);

template <class S>
class BasicBendWatch {
 public:
  explicit BasicBendWatch(const BasicSystem<S>& system);

  /// The share of a step of h from t that leads to the second bend on the way of a joint, with the motions at its start and its end, or of what a load or a motor does in
  /// the time up to `t_end`, or over the places that it reads; 1: none passes two. What is shorter than a thousandth of the run may be missed.
  double share_of_step(double t, double h, double t_end, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end);
  /// What the curve through as many instants as forces are sampled at in a step misses of its loads between them, over the load scale: of loads that are functions of time,
  /// of efforts over the straight way from what they read at the start to what they read at the end, and of friction over that of its speed. theory/time Eq. (3.25).
  double missed_between_samples(double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end, const BasicLoadScale<S>& scale);

 private:
  struct Way {
    int joint, component;  // component: of the gap; -1: along the profile of the joint's edge or cam
    Bends bends;
  };
  /// A component of a force that varies.
  struct Applied {
    const Expression* f;  // of time
    int body, component;
  };
  double missed_friction(int j, double t, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end, const BasicLoadScale<S>& scale) const;
  double place(const Way& way, const std::vector<typename S::Motion>& m) const;
  double place_at_end(const Way& way, double from, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const;

  /// How far the bodies turn of which a load reads places, at most [rad].
  double turn_of(const BasicLoadData<S>& load, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const;
  /// What a load reads at the part x of a step: over the straight way from its start to its end, or, where bodies turn far, over cubic ways of their coordinates.
  std::array<double, kMaxSignals> read_on_way(const BasicLoadData<S>& load, double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end, double x);
  double share_of_effort(const BasicLoadData<S>& load, double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end);

  const BasicSystem<S>& system_;
  std::vector<Way> ways_;
  std::vector<Bends> in_time_;  // found when they are first asked for
  std::vector<Applied> applied_;
  std::vector<int> placed_;     // loads that are efforts which read places or speeds ...
  std::vector<int> timed_;      // ... and those that read anything
  std::vector<int> rubbing_;    // joints whose friction is a function of speed
  std::vector<typename S::Motion> on_way_;
  SampledGraph samples_;
  double apart_ = 0;            // instants at which they are looked at [s]; 0: not known yet
};
using BendWatch = BasicBendWatch<Planar>;

}  // namespace pintle

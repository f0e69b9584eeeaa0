// Steps check what they pass: a notch, a bump of an edge or the lift of a cam may be shorter than the distance between two stages, and a
// blow shorter than the time between them. theory/time section 3.4.
#pragma once

#include <array>
#include <vector>

#include "base/bends.h"
#include "integrators/load_scale.h"
#include "system/system.h"

namespace pintle {

/// The bends of all loads, motors and driven lengths that are functions of time alone, each sampled at 2000 intervals of the time between two instants [s].
template <class S>
std::vector<Bends> bends_in_time(const BasicSystem<S>& system, double from, double to);

/// The kinks and jumps of these functions, ascending, each separated from the next by more than rounding [s].
template <class S>
std::vector<double> kinks_in_time(const BasicSystem<S>& system, double from, double to);

template <class S>
class BasicBendWatch {
 public:
  explicit BasicBendWatch(const BasicSystem<S>& system);

  /// The share of a step of h from t up to the second bend on the way of a joint, given the motions at its start and its end, or of the values of a load or a motor in the
  /// time up to `t_end`, or over the positions that it reads; or to a point between two kinks in time; 1: it does not pass two. What is shorter than a thousandth of the
  /// run and has no kinks may be missed.
  double share_of_step(double t, double h, double t_end, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end);
  /// The error, between the force samples of a step, of the curve through its loads at these samples, over the load scale: for loads that are functions of time, for
  /// efforts along the straight way from what they read at the start to what they read at the end, and for friction along that of its speed. theory/time Eq. (3.25).
  double missed_between_samples(double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end, const BasicLoadScale<S>& scale);

 private:
  struct Way {
    int joint, component;  // component: of the gap; -1: along the profile of the joint's edge or cam
    Bends bends;
  };
  /// A varying component of a force.
  struct Applied {
    const Expression* f;  // of time
    int body, component;
  };
  double missed_friction(int j, double t, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end, const BasicLoadScale<S>& scale) const;
  double place(const Way& way, const std::vector<typename S::Motion>& m) const;
  double place_at_end(const Way& way, double from, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const;

  /// What a load reads in a step of h from t.
  struct ReadInStep {
    const BasicLoadData<S>& load;
    double t, h;
    const std::vector<typename S::Motion>&start, &end;
    std::array<double, kMaxSignals> from, to;  // its readings at the start and at the end
    double turn;                               // largest rotation of the bodies whose positions it reads [rad]

    bool is_straight() const;
    bool jumps() const;
    bool stays() const;
  };
  ReadInStep read_in_step(const BasicLoadData<S>& load, double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const;
  /// The effort at the share x of the step: along the straight way between its readings at both ends or, where bodies rotate far, cubic ways of their coordinates.
  double effort_at(const ReadInStep& read, double x);
  double share_of_effort(const BasicLoadData<S>& load, double t, double h, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end);

  const BasicSystem<S>& system_;
  std::vector<Way> ways_;
  std::vector<Bends> in_time_;  // found when first needed
  std::vector<double> kinks_;   // in time, too
  std::vector<Applied> applied_;
  std::vector<int> placed_;     // loads that are efforts and read positions or speeds ...
  std::vector<int> timed_;      // ... and those that read anything
  std::vector<int> rubbing_;    // joints whose friction is a function of speed
  std::vector<typename S::Motion> on_way_;
  SampledGraph samples_;
  double apart_ = 0;            // interval at which they are sampled [s]; 0: not known yet
};
using BendWatch = BasicBendWatch<Planar>;

}  // namespace pintle

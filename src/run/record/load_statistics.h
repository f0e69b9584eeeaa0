// Peaks, means and root mean squares of all loads over a run, the heat of every joint and the duty of every pin: from curves through samples inside every step, so that
// they do not depend on the output rows. theory/time section 5.1.
#pragma once

#include <limits>
#include <vector>

#include "integrators/stepper.h"
#include "run/record/duty_tally.h"
#include "run/record/sampled_curve.h"
#include "run/record/wear_tally.h"

namespace pintle {

/// Over the whole run.
struct LoadStatistics {
  double peak = 0, peak_time = 0, mean = 0, rms = 0;  // of the magnitude; for a scalar, peak and mean have their signs; [s]
};

/// At how many instants loads are sampled (see CurveGrid), and how finely.
struct LoadSampling {
  int n = 3;              // instants of a step or of a part of it
  double accuracy = CurveGrid::kFinest;  // of integrals of magnitudes, relative
  double resolution = 0;  // upper limit, as a fraction of the peak, on what curves through the samples leave out. Steps in which they leave more are halved; 0: none are
  double longest_part = std::numeric_limits<double>::infinity();  // into which such a step is divided at first [s]
};

template <class S>
class BasicLoadRecorder {
 public:
  /// Scalars in addition to the joint loads: efforts of motors, their powers, forces of springs.
  class Signals {
   public:
    virtual ~Signals() = default;
    virtual int n_signals() const = 0;
    virtual void put_signals(const BasicState<S>& state, const std::vector<typename S::Motion>& m, double* out) const = 0;
  };

  /// `with_heat`: also records losses of joints, wear, and the duty of pins. `signals`, if any, must outlive the recorder.
  BasicLoadRecorder(const BasicSystem<S>& system, const LoadSampling& sampling, bool with_heat, const Signals* signals);

  void start(const BasicState<S>& state);
  void add_step(BasicStepper<S>& stepper);

  LoadStatistics force(int joint) const { return over_run(force_[static_cast<std::size_t>(joint)]); }
  LoadStatistics couple(int joint) const { return over_run(couple_[static_cast<std::size_t>(joint)]); }
  LoadStatistics signal(int i) const { return over_run(signal_[static_cast<std::size_t>(i)]); }
  double span() const { return end_ - begin_; }  // [s]
  /// Heat that the law of a joint has produced from the start up to `state`, the end of the last step [J]. theory/time Eq. (5.5)
  double heat(int joint, const BasicState<S>& state) const;
  const BasicWearTally<S>& wear() const { return wear_; }
  const BasicDutyTally<S>& duty() const { return duty_; }

 private:
  static constexpr int kForce = S::kDim, kCouple = S::kDof - S::kDim;
  double stored(int joint, const BasicState<S>& state) const;
  double power_on_gap(int j, const BasicState<S>& state) const;
  void remember_lengths(const BasicState<S>& end);
  void add_work_of_length_jumps(const BasicState<S>& begin);
  void sample(int i, const BasicState<S>& state);
  void add_resolved(BasicStepper<S>& stepper, double t0, double t1, int halvings);
  void take_samples(BasicStepper<S>& stepper, double t0, double t1);
  bool is_resolved(const BasicLoadScale<S>& scale) const;
  void add_samples(double t0, double h, bool resolved);
  template <int n, Sums kind = Sums::kOfSize>
  CurveGrid::AtPoints add_load(const double* samples, double t0, double h, bool resolved, CurveSums& sums) const;
  void add_wear(BasicStepper<S>& stepper, double t0, double t1);
  LoadStatistics over_run(const CurveSums& sums) const;

  const BasicSystem<S>& system_;
  CurveGrid grid_;
  LoadSampling sampling_;
  bool with_heat_;
  const Signals* signals_;
  int n_signals_, stride_;
  std::vector<double> samples_;  // for each instant: the loads of all joints, the powers on their gaps, the signals
  std::vector<typename S::Motion> m_;
  std::vector<CurveSums> force_, couple_, signal_;
  std::vector<bool> has_couple_;
  std::vector<double> work_, stored_;  // work of each joint's force on its gap since the start, less the supply to its law; energy stored at the start [J]
  /// A joint with a length that is a function of time, as the last step left it.
  struct DrivenLength {
    int joint = 0;
    double gap = 0, rate = 0, stored = 0;
  };
  std::vector<DrivenLength> lengths_;
  double begin_ = 0, end_ = 0;
  int jumps_ = 0;  // in this part of a step, as far as it has been added
  BasicWearTally<S> wear_;
  BasicDutyTally<S> duty_;
};
using LoadRecorder = BasicLoadRecorder<Planar>;

}  // namespace pintle

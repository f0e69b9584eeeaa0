// The interface of an integration method during a run.
#pragma once

#include <string>
#include <vector>

#include "integrators/law_crossings.h"
#include "integrators/load_scale.h"
#include "pintle/trajectory.h"
#include "system/state.h"

namespace pintle {

template <class S>
struct BasicStepNodes;

template <class S>
class BasicStepper {
 public:
  virtual ~BasicStepper() = default;

  virtual void set_max_step(double h) = 0;
  /// Loads known from an earlier integration, for methods that measure errors by them.
  virtual void set_load_scale(const BasicLoadScale<S>& scale) = 0;
  virtual const BasicLoadScale<S>& load_scale() const = 0;

  /// Starts at `state` (with all members filled in) with a first step of about h.
  virtual void start(const BasicState<S>& state, double h) = 0;
  /// One accepted step, not beyond t_end. False when no step succeeded; `failure` says why.
  virtual bool step(double t_end) = 0;

  virtual const BasicState<S>& state() const = 0;
  virtual const BasicState<S>& previous() const = 0;
  /// The state at a time inside the last step.
  virtual const BasicState<S>& interpolate(double t) = 0;
  /// The end of the last step before laws have set their states there; `state` is the one after.
  virtual const BasicState<S>& state_before_event() const { return state(); }
  /// The interior of the last step, for methods that keep it; otherwise null.
  virtual const BasicStepNodes<S>* nodes() const { return nullptr; }
  virtual const Counters& counters() const = 0;
  virtual const std::string& failure() const = 0;
  /// The last event, if the method locates events and it came after `since`: its owner and its time. Otherwise empty.
  virtual std::string last_event(double) const { return {}; }
  /// The borders at which laws have set their states, in the order of time.
  virtual const std::vector<LawCrossing>& crossings() const {
    static const std::vector<LawCrossing> none;
    return none;
  }
  /// Whether it ends its steps so that they pass over nothing shorter (BendWatch).
  virtual bool watches_bends() const { return false; }
  /// Remarks of the method on the run, for the user.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// The first load in a sliding mode, held where its expression jumps; negative: there was none. The lag of its ramp need not shrink with the tolerance.
  virtual int sliding_load() const { return -1; }
  /// The largest estimated error of the steps taken, in units of the tolerance [-]; 1 if the method keeps no account of it.
  virtual double largest_step_error() const { return 1; }
  /// The time at which reactions without a bound first occurred, as those of ideal joints may have at singular positions [s]; negative: never.
  virtual double unbounded_reactions() const { return -1; }
};
using Stepper = BasicStepper<Planar>;

}  // namespace pintle

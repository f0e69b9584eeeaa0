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

  /// Starts at `state` (all of it filled in) with a first step of about h.
  virtual void start(const BasicState<S>& state, double h) = 0;
  /// One accepted step, not beyond t_end. False when no step could be made; `failure` says why.
  virtual bool step(double t_end) = 0;

  virtual const BasicState<S>& state() const = 0;
  virtual const BasicState<S>& previous() const = 0;
  /// The state at a time inside the last step.
  virtual const BasicState<S>& interpolate(double t) = 0;
  /// The end of the last step before laws have set their states there, which `state` comes after.
  virtual const BasicState<S>& state_before_event() const { return state(); }
  /// The inside of the last step, of methods that keep it; otherwise null.
  virtual const BasicStepNodes<S>* nodes() const { return nullptr; }
  virtual const Counters& counters() const = 0;
  virtual const std::string& failure() const = 0;
  /// The last event, if the method locates events and it came after `since`: whose it is, and when. Otherwise empty.
  virtual std::string last_event(double) const { return {}; }
  /// The borders at which laws have set their states, in the order of time.
  virtual const std::vector<LawCrossing>& crossings() const {
    static const std::vector<LawCrossing> none;
    return none;
  }
  /// Whether it ends its steps so that it passes nothing that is shorter (BendWatch).
  virtual bool watches_bends() const { return false; }
  /// What the method noticed on its way, for the user.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// The first load in a sliding mode, held where its expression jumps; negative: none has been. What its ramp lags behind need not shrink with the tolerance.
  virtual int sliding_load() const { return -1; }
  /// When reactions have been met first that have no bound, as those of ideal joints at singular positions may [s]; negative: never.
  virtual double unbounded_reactions() const { return -1; }
};
using Stepper = BasicStepper<Planar>;

}  // namespace pintle

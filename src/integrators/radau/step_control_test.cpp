#include "integrators/radau/step_control.h"

#include <gtest/gtest.h>

namespace pintle {
namespace {

// Equations without a solution, and a function that changes sign at every start of a step.
class Flickering {
 public:
  int crossings = 0, attempts = 0;
  double t() const { return t_; }
  void begin_at_end() {}
  bool attempt(double) { return ++attempts, false; }
  double contraction() const { return 0; }
  bool sets_states(const SwitchingEvent&) const { return false; }
  bool rests(double) const { return false; }
  bool motion_is_below_rounding(double) const { return false; }
  SwitchingEvent locate_event(double, bool) const {
    SwitchingEvent event;
    event.function = 0;
    event.before = 0;
    event.after = 1e-9;
    return event;
  }
  bool forces_stay_constant(double) { return true; }
  void cross_event(double, const SwitchingEvent&) { ++crossings; }
  void taylor_step(double) {}
  void rebalance_end() {}
  void balance_end() {}
  double share_of_step(double, double) { return 1; }
  bool error_estimate(double, double&) { return false; }
  void finish_step(double) {}

 private:
  double t_ = 0;
};

TEST(StepControl, GivesUpAStepWhoseStartFlickersAndThatNoNewtonSolves) {
  Flickering method;
  StepControl control;
  control.start(1e-3);
  Counters counters;
  EXPECT_FALSE(control.advance(method, 1.0, 1e-5, 4, counters));
  EXPECT_GT(method.crossings, 0);
  EXPECT_LE(method.crossings, 24);
  EXPECT_LT(method.attempts, 24 * 81);
  EXPECT_EQ(counters.events, static_cast<std::uint64_t>(method.crossings));
}

// A function changes its sign just before the end of the run; steps have no errors.
class OneEvent {
 public:
  OneEvent(double begin, double event) : t_(begin), at_(event) {}

  int crossings = 0, attempts = 0;
  double t() const { return t_; }
  void begin_at_end() {}
  bool attempt(double) { return ++attempts, true; }
  double contraction() const { return 0; }
  bool sets_states(const SwitchingEvent&) const { return false; }
  bool rests(double) const { return false; }
  bool motion_is_below_rounding(double) const { return false; }
  SwitchingEvent locate_event(double h, bool) const {
    SwitchingEvent event;
    if (crossings > 0 || t_ + h < at_) return event;
    event.function = 0;
    event.before = (at_ - t_) / h;
    event.after = event.before + 1e-15;
    return event;
  }
  bool forces_stay_constant(double) { return true; }
  void cross_event(double distance, const SwitchingEvent&) {
    t_ += distance;
    ++crossings;
  }
  void taylor_step(double) {}
  void rebalance_end() {}
  void balance_end() {}
  double share_of_step(double, double) { return 1; }
  bool error_estimate(double, double& error) { return error = 0, true; }
  void finish_step(double h) { t_ += h; }

 private:
  double t_, at_;
};

TEST(StepControl, StopsAtAnEventJustBeforeTheEndOfTheRun) {
  constexpr double kEvent = 1 - 5e-4;
  OneEvent method(0, kEvent);
  StepControl control;
  control.start(1.0);
  Counters counters;
  ASSERT_TRUE(control.advance(method, 1.0, 1e-5, 4, counters));
  EXPECT_EQ(method.crossings, 0);
  EXPECT_LT(method.t(), kEvent);
  EXPECT_GT(method.t(), kEvent - 1e-5);
  ASSERT_TRUE(control.advance(method, 1.0, 1e-5, 4, counters));
  EXPECT_EQ(method.crossings, 1);
  EXPECT_EQ(method.t(), 1.0);
  EXPECT_LT(method.attempts, 8);
}

// The step to it is shorter than the last bits of the end time, but longer than those of the present time.
TEST(StepControl, ReachesAnEventSoonHoweverFarTheEndIs) {
  constexpr double kBegin = 0.0118, kEvent = kBegin + 4e-9, kFarEnd = 2e6;
  OneEvent method(kBegin, kEvent);
  StepControl control;
  control.start(1e-4);
  Counters counters;
  ASSERT_TRUE(control.advance(method, kFarEnd, 1e-5, 4, counters));
  EXPECT_EQ(method.crossings, 0);
  ASSERT_TRUE(control.advance(method, kFarEnd, 1e-5, 4, counters));
  EXPECT_EQ(method.crossings, 1);
  EXPECT_GT(method.t(), kEvent);
}

// A body at rest, its position rounded: a step's curve leads part of the way to an event, Taylor's series all the way.
class Resting {
 public:
  explicit Resting(double event) : at_(event) {}

  int taylor_steps = 0, crossings = 0;
  double crossed_at = 0;
  double t() const { return t_; }
  void begin_at_end() {}
  bool attempt(double) { return true; }
  double contraction() const { return 0; }
  bool sets_states(const SwitchingEvent&) const { return false; }
  bool rests(double) const { return false; }
  bool motion_is_below_rounding(double) const { return true; }
  SwitchingEvent locate_event(double h, bool solved) const {
    SwitchingEvent event;
    const double ahead = (solved ? 0.6 : 1) * (at_ - t_);
    if (crossings > 0 || ahead > h) return event;
    event.function = 0;
    event.before = ahead / h;
    event.after = event.before + 1e-15;
    return event;
  }
  bool forces_stay_constant(double) { return true; }
  void cross_event(double distance, const SwitchingEvent&) {
    t_ += distance;
    crossed_at = t_;
    ++crossings;
  }
  void taylor_step(double h) {
    t_ += h;
    ++taylor_steps;
  }
  void rebalance_end() {}
  void balance_end() {}
  double share_of_step(double, double) { return 1; }
  bool error_estimate(double, double& error) { return error = 0, true; }
  void finish_step(double h) { t_ += h; }

 private:
  double t_ = 0, at_;
};

// A friction stay at rest whose cord goes taut: output rows on the way were those of the taut cord.
TEST(StepControl, LeadsUpToAnEventByAStepOfItsOwn) {
  constexpr double kEvent = 0.9;
  Resting method(kEvent);
  StepControl control;
  control.start(1.0);
  Counters counters;
  while (method.t() < 1.0) ASSERT_TRUE(control.advance(method, 1.0, 1e-5, 4, counters));
  EXPECT_EQ(method.taylor_steps, 1);
  EXPECT_EQ(method.crossings, 1);
  EXPECT_NEAR(method.crossed_at, kEvent, 1e-12);
}

}  // namespace
}  // namespace pintle

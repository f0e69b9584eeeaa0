#include "integrators/radau/step_control.h"

#include <gtest/gtest.h>

namespace pintle {
namespace {

// Its equations have no solution, and a function changes its sign at every start of a step.
class Flickering {
 public:
  int crossings = 0, attempts = 0;
  double t() const { return t_; }
  void begin_at_end() {}
  bool attempt(double) { return ++attempts, false; }
  double contraction() const { return 0; }
  SwitchingEvent locate_event(double, bool) const {
    SwitchingEvent event;
    event.function = 0;
    event.before = 0;
    event.after = 1e-9;
    return event;
  }
  bool forces_stay_constant(double) { return true; }
  void cross_event(double, const SwitchingEvent&) { ++crossings; }
  void balance_end() {}
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
class EventNearTheEnd {
 public:
  static constexpr double kEvent = 1 - 5e-4;
  int crossings = 0, attempts = 0;
  double t() const { return t_; }
  void begin_at_end() {}
  bool attempt(double) { return ++attempts, true; }
  double contraction() const { return 0; }
  SwitchingEvent locate_event(double h, bool) const {
    SwitchingEvent event;
    if (crossings > 0 || t_ + h < kEvent) return event;
    event.function = 0;
    event.before = (kEvent - t_) / h;
    event.after = event.before + 1e-15;
    return event;
  }
  bool forces_stay_constant(double) { return true; }
  void cross_event(double distance, const SwitchingEvent&) {
    t_ += distance;
    ++crossings;
  }
  void balance_end() {}
  bool error_estimate(double, double& error) { return error = 0, true; }
  void finish_step(double h) { t_ += h; }

 private:
  double t_ = 0;
};

TEST(StepControl, StopsAtAnEventJustBeforeTheEndOfTheRun) {
  EventNearTheEnd method;
  StepControl control;
  control.start(1.0);
  Counters counters;
  ASSERT_TRUE(control.advance(method, 1.0, 1e-5, 4, counters));
  EXPECT_EQ(method.crossings, 0);
  EXPECT_LT(method.t(), EventNearTheEnd::kEvent);
  EXPECT_GT(method.t(), EventNearTheEnd::kEvent - 1e-5);
  ASSERT_TRUE(control.advance(method, 1.0, 1e-5, 4, counters));
  EXPECT_EQ(method.crossings, 1);
  EXPECT_EQ(method.t(), 1.0);
  EXPECT_LT(method.attempts, 8);
}

}  // namespace
}  // namespace pintle

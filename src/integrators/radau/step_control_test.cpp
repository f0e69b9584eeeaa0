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

}  // namespace
}  // namespace pintle

// Kinks and jumps of forces: a step ends on each of them, and the forces before and after are as accurate as those of a run
// that is stopped and restarted at the known time.
#include <gtest/gtest.h>

#include <cmath>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/general/dopri5.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

using sample::expression;

constexpr double kCrossingTolerance = 1e-6;

// The pendulum with a vertical force at its middle.
Model pushed_pendulum(const std::string& force) {
  Model model = sample::pendulum(1e8, 3000);
  model.bodies[0].markers.push_back({"C", {0, 0}, 0});
  AppliedForce push;
  push.name = "F";
  push.on = {"rod", "C"};
  push.force = {Expression::constant(0), expression(force)};
  model.forces = {push};
  return model;
}

State run_up_to(const System& system, const State& from, double end, double tolerance, int stages) {
  RadauStepper stepper(system, tolerance, stages);
  stepper.start(from, 1e-5);
  while (stepper.state().t < end)
    if (!stepper.step(end)) throw std::runtime_error(stepper.failure());
  return stepper.state();
}

struct Ends {
  double nearest = 1e9;         // distance of the nearest end of a step from the event
  std::uint64_t steps = 0, rejected = 0;
  State last;
};
Ends follow_steps(const System& system, const State& from, double end, double event, int stages) {
  Ends ends;
  RadauStepper stepper(system, kCrossingTolerance, stages);
  stepper.start(from, 1e-4);
  while (stepper.state().t < end) {
    if (!stepper.step(end)) throw std::runtime_error(stepper.failure());
    ends.nearest = std::min(ends.nearest, std::abs(stepper.state().t - event));
  }
  ends.steps = stepper.counters().steps;
  ends.rejected = stepper.counters().rejected;
  ends.last = stepper.state();
  return ends;
}

struct KnownEvent {
  const char* force;
  const char* before;
  const char* after;
  double time;
};
const KnownEvent kInTime[] = {{"if(t < 0.123, 0, 30)", "0", "30", 0.123},
                             {"min(200*t, 24.6)", "200*t", "24.6", 0.123},
                             {"max(0, 400*(t - 0.17))", "0", "400*(t - 0.17)", 0.17},
                             {"abs(20 - 100*t)", "20 - 100*t", "100*t - 20", 0.2},
                             {"30*step(t - 0.123)", "0", "30", 0.123}};

// The peak of the pin force is about 40 N. Times after the kink: during the vibration that a jump excites, and later.
TEST(EventLocation, ForcesAreThoseOfARunSplitAtTheKnownTime) {
  for (const KnownEvent& event : kInTime)
    for (const int stages : {3, 5}) {
      const Model whole = pushed_pendulum(event.force), before = pushed_pendulum(event.before), after = pushed_pendulum(event.after);
      const System system = build_system(whole), first = build_system(before), second = build_system(after);
      const State start = sample::settled_start(before, first, 0.05);
      const State middle = run_up_to(first, start, event.time, 1e-11, 5);
      // From the middle on with the forces of the second half: the accelerations jump, the gaps do not.
      State there = middle;
      Dopri5(second, 1).complete(there);
      there.gap = middle.gap;
      there.force = middle.force;
      for (const double later : {3e-4, 2e-3, 0.2}) {
        const State exact = run_up_to(second, there, event.time + later, 1e-11, 5);
        const State found = run_up_to(system, start, event.time + later, kCrossingTolerance, stages);
        EXPECT_LT(sample::largest_difference(found.force, exact.force), 10 * 40 * kCrossingTolerance) << event.force << " " << stages << " " << later;
        EXPECT_LT(sample::largest_difference(found.q, exact.q), kCrossingTolerance) << event.force << " " << stages << " " << later;
      }
    }
}

TEST(EventLocation, AStepEndsOnTheEvent) {
  for (const KnownEvent& event : kInTime)
    for (const int stages : {3, 5}) {
      const Model whole = pushed_pendulum(event.force), before = pushed_pendulum(event.before);
      const System system = build_system(whole), first = build_system(before);
      const Ends ends = follow_steps(system, sample::settled_start(before, first, 0.05), 0.4, event.time, stages);
      EXPECT_LT(ends.nearest, 3e-7) << event.force << " " << stages;
      EXPECT_LE(ends.rejected, 15 + ends.steps / 3) << event.force << " " << stages;
    }
}

// A block of 2 kg in a guide on a spring of 50 N/m with dry friction of 3 N: a jump in the rate at every turning point,
// equal half periods, the amplitude reduced by twice 3/50 m each time.
struct DryFriction {
  static constexpr double kShift = 3.0 / 50, kRate = 5, kHalf = std::numbers::pi / kRate;
  Model model;

  DryFriction() {
    model.ground = {{"O", {0, 0}, 0}};
    model.bodies = {sample::body("block", 2, 0.1, {{"C", {0, 0}, 0}})};
    sample::put_at(model.bodies[0], 1.5, 0, 0);
    model.joints = {sample::joint("guide", "prismatic", {"ground", "O"}, {"block", "C"}, 1e8, 3000)};
    model.springs = {sample::spring("S", false, {"ground", "O"}, {"block", "C"}, 50, 0)};
    model.springs[0].free_length = 1;
    model.motors = {sample::motor("friction", "guide", MotorKind::kEffort, expression("if(rate > 0, -3, 3)", {"rate"}))};
  }
  static double position(double t) {
    const int n = static_cast<int>(t / kHalf);
    const double side = n % 2 == 0 ? 1 : -1;
    return 1 + side * kShift + side * (0.5 - (2 * n + 1) * kShift) * std::cos(kRate * (t - n * kHalf));
  }
};

TEST(EventLocation, DryFrictionTurnsWhereItShould) {
  const DryFriction friction;
  const System system = build_system(friction.model);
  for (const int stages : {3, 5}) {
    RadauStepper stepper(system, kCrossingTolerance, stages);
    stepper.start(sample::loaded_start(friction.model, system), 1e-4);
    double nearest[3] = {1, 1, 1};
    while (stepper.state().t < 2.2) {
      ASSERT_TRUE(stepper.step(2.2)) << stepper.failure();
      const State& s = stepper.state();
      for (int n = 0; n < 3; ++n) nearest[n] = std::min(nearest[n], std::abs(s.t - (n + 1) * DryFriction::kHalf));
      // The shift of a kink by dt shifts what follows by at most kRate * 0.5 * dt.
      EXPECT_NEAR(s.q[0][0], DryFriction::position(s.t), 3 * kCrossingTolerance) << s.t << " " << stages;
      EXPECT_NEAR(s.force[0][0] + s.force[0][1], 2 * 9.80665, 1e-4) << s.t << " " << stages;
    }
    for (const double distance : nearest) EXPECT_LT(distance, 3 * kCrossingTolerance) << stages;
    EXPECT_LE(stepper.counters().steps, 150u) << stages;
  }
}

// A kink in a rate without a jump: drag that acts in one direction only.
TEST(EventLocation, OneWayDragIsThatOfASplitRun) {
  Model one_way = DryFriction().model, both = one_way, none = one_way;
  one_way.motors[0].law = expression("-8*max(rate, 0)", {"rate"});
  both.motors[0].law = expression("-8*rate", {"rate"});
  none.motors.clear();
  const System system = build_system(one_way), with = build_system(both), without = build_system(none);
  const State start = sample::loaded_start(none, without);
  // Without drag the first half period is pi/5; then back with drag.
  const State turn = run_up_to(without, start, DryFriction::kHalf, 1e-11, 5);
  EXPECT_NEAR(turn.v[0][0], 0, 1e-9);
  const State exact = run_up_to(with, turn, 1.1, 1e-11, 5);
  for (const int stages : {3, 5}) {
    const State found = run_up_to(system, start, 1.1, kCrossingTolerance, stages);
    EXPECT_NEAR(found.q[0][0], exact.q[0][0], 3 * kCrossingTolerance);
    EXPECT_LT(sample::largest_difference(found.force, exact.force), 20 * 10 * kCrossingTolerance);
    EXPECT_LT(follow_steps(system, start, 1.1, DryFriction::kHalf, stages).nearest, 3 * kCrossingTolerance);
  }
}

// Where there is no kink none is crossed, however far a step falls short of the first guess.
TEST(EventLocation, AFirstStepFarTooLongIsOnlyShortened) {
  const Model model = sample::pendulum(1e8, 10);  // starts without its load: vibrates at 20 000 rad/s
  const System system = build_system(model);
  const State start = sample::plain_start(model, system), exact = run_up_to(system, start, 1e-3, 1e-9, 5);
  for (const double first_step : {1e-2, 1.0, 100.0}) {
    RadauStepper stepper(system, 1e-4);
    stepper.start(start, first_step);
    bool going = true;
    while (going && stepper.state().t < 1e-3) going = stepper.step(1e-3 + (stepper.counters().steps == 0 ? 1e4 : 0));
    ASSERT_TRUE(going) << stepper.failure();
    EXPECT_LT(sample::largest_difference(stepper.state().force, exact.force), 20 * 1e-4 * 10) << first_step;
  }
}

// A rod in free fall until its rope is taut, again and again: every attempt across that instant fails, and the shorter one,
// which is all free fall, needs no correction at all.
TEST(EventLocation, ARopePassesFromSlackToTaut) {
  Model model = sample::pendulum(1e6, 200);
  model.ground[0].position = {0, 1.5};
  model.joints[0].type = "rope";
  model.joints[0].geometry = {{"length", 2}};
  const System system = build_system(model);
  for (const int stages : {3, 5}) {
    RadauStepper stepper(system, 1e-5, stages);
    stepper.start(sample::plain_start(model, system), 1e-3);
    while (stepper.state().t < 2) ASSERT_TRUE(stepper.step(2)) << stages << " stages: " << stepper.failure();
  }
}

}  // namespace
}  // namespace pintle

// Borders of a law that the program does not know, in whole runs: events at the times of the closed form, in the stated direction only.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/constants.h"
#include "integrators/absolute/radau_stepper.h"
#include "laws/catalog.h"
#include "laws/law_math.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

// A one-sided spring in the free coordinate of a slider, and a border that only marks where the motion turns upwards.
struct PadLaw {
  static constexpr std::string_view kWord = "pad";
  double k = 0;

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const T depth = law_math::where_positive(in.gap[0], T(0.0), T(0.0) - in.gap[0]);
    out.force[0] = k * depth;
    out.energy = 0.5 * k * (depth * depth);
  }
  int n_borders() const { return 2; }
  void borders(const LawInput<double>& in, double* value) const {
    value[0] = -in.gap[0];
    value[1] = in.rate[0];
  }
  std::array<int, 2> border_directions() const { return {0, 1}; }
};

constexpr std::array<KeyInfo, 1> kPadKeys{{{.key = "pad_stiffness", .unit = "N/m", .fallback = 4e3, .minimum_exclusive = true, .meaning = "of a test"}}};
void make_pad(const LawSetting& at, Law& law) {
  law.set_linear({{0, 1e7, 1e5}, {0, 1e3, 10}});
  law.add(std::make_unique<LawPartOf<PadLaw>>(PadLaw{at.number("pad_stiffness")}));
}
void register_events() {
  static const bool done = [] {
    register_law({.word = "pad", .meaning = "of a test", .keys = kPadKeys, .make = make_pad});
    return true;
  }();
  static_cast<void>(done);
}

constexpr double kFallingMass = 2, kHeight = 0.3, kFloorStiffness = 4e3;

Model bouncing() {
  register_events();
  return parse_model(R"toml(
format = 1
name = "Bouncing block"
[simulate]
duration = "2 s"
output_step = "10 ms"
start = "raw"
[ground.markers]
o = { x = 0, y = 0, axis = "90 deg" }
[body.block]
mass = 2
inertia = 0.01
position = [0, 0.3]
velocity = [0, 0]
angle = 0
spin = 0
markers.c = { x = 0, y = 0, axis = "90 deg" }
[joint.guide]
type = "prismatic"
between = ["ground.o", "block.c"]
law = "pad"
)toml", "bouncing.toml");
}

// Falls, is on the pad from `touch` on for `contact`, and flies for `flight`; this repeats, as nothing is lost.
struct Bounces {
  double speed = std::sqrt(2 * kStandardGravity * kHeight), w = std::sqrt(kFloorStiffness / kFallingMass);
  double touch = speed / kStandardGravity, flight = 2 * touch, contact = 2 * (std::numbers::pi - std::atan(speed * w / kStandardGravity)) / w;

  // Touch, turning point, release, touch ..
  double event(int i) const { return touch + i / 3 * (contact + flight) + 0.5 * contact * (i % 3); }
};

TEST(Events, ABlockTouchesTurnsAndLetsGoWhenItShould) {
  const Model model = bouncing();
  const Assembly assembly = start_of_run(model);
  const System& system = assembly.system;
  const State& start = assembly.state;
  ASSERT_EQ(system.switching_functions().size(), 2u);
  const Bounces exact;
  for (const int stages : {3, 5})
    for (const double tolerance : {1e-5, 1e-9}) {
      RadauStepper stepper(system, tolerance, stages);
      stepper.start(start, 1e-4);
      std::vector<SwitchingEvent> events;
      std::uint64_t seen = 0;
      while (stepper.state().t < 1.9) {
        ASSERT_TRUE(stepper.step(1.9)) << stepper.failure();
        ASSERT_LE(stepper.counters().events, seen + 1);
        if (stepper.counters().events > seen) events.push_back(stepper.event());
        seen = stepper.counters().events;
      }
      // A free fall is exact; after it the solution's own error adds up.
      ASSERT_EQ(events.size(), 9u) << stages;  // of three bounces; the highest points are no events
      for (int i = 0; i < 9; ++i) {
        EXPECT_NEAR(events[i].t, exact.event(i), i == 0 ? 1e-10 : 3 * tolerance) << i << ' ' << stages << ' ' << tolerance;
        EXPECT_EQ(events[i].function, i % 3 == 1 ? 1 : 0) << i;
        EXPECT_EQ(events[i].rising, i % 3 != 2) << i;
      }
    }
}

TEST(Events, ARunCountsThemAndKeepsItsTolerance) {
  Model model = bouncing();
  const Bounces exact;
  for (const Equations equations : {Equations::kNewtonian, Equations::kRelative}) {
    model.simulate.equations = equations;
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    EXPECT_EQ(run.counters.events, 11 * run.counters.passes);  // up to the fourth turning point
    const int y = run.column("body.block.y");
    for (std::size_t i = 0; i < run.n_rows(); ++i) {
      const double since = std::fmod(run.at(i, 0) + 0.5 * exact.flight, exact.contact + exact.flight);  // since the last release
      if (since < exact.flight) EXPECT_NEAR(run.at(i, y), kHeight - 0.5 * kStandardGravity * std::pow(since - 0.5 * exact.flight, 2), 2e-5) << run.at(i, 0);
      else EXPECT_LT(run.at(i, y), 1e-6);
    }
    EXPECT_LT(run.energy.drift, 1e-5 * run.energy.kinetic_peak);
  }
}

// A joint that the equations keep closed has no friction: one note for each says so.
TEST(Events, FrictionOfAnIdealJointIsMissedAloud) {
  Model model = reference::rubbing_four_bar();
  model.simulate.duration = 0.01;
  const auto lost = [](const Trajectory& run) {
    std::vector<std::string> notes;
    for (const std::string& note : run.notes)
      if (note.find("its friction is not in these equations") != std::string::npos) notes.push_back(note);
    return notes;
  };
  EXPECT_TRUE(lost(simulate(model)).empty());
  std::vector<std::string> all;
  for (const Joint& joint : model.joints) all.push_back("joint " + joint.name + " is ideal: its friction is not in these equations");
  model.simulate.equations = Equations::kIdeal;
  EXPECT_EQ(lost(simulate(model)), all);
  model.simulate.equations = Equations::kRelative;
  model.joints[0].ideal = true;
  EXPECT_EQ(lost(simulate(model)), std::vector{all[0]});
}

// A pin comes to stick where the force that holds it depends on how far the step goes beyond: each trial comes nearer to the event by a twelfth.
TEST(Events, AStepThatNearsAnEventSlowlyGoesWhereItsTrialsLead) {
  Model model = reference::test_model("toggle_clamp_of_rubbing_pins");
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << tolerance << ": " << run.message;
  }
}

// Nothing moves until a cord goes taut. Steps that end before it used to skip the time up to it: rows there were those of the taut cord, a thousand times the peak, and no mean
// included them.
TEST(Events, WhatRestsUntilAnEventIsAtRestInTheRowsBeforeIt) {
  constexpr double kTaut = 2.11811496879912;  // from the cord's length, 0.6 m - 0.1 m/s t
  Model model = reference::test_model("friction_stay_with_cord");
  for (const Equations equations : {Equations::kNewtonian, Equations::kRelative}) {
    model.simulate.equations = equations;
    std::vector<double> rms;
    for (const double tolerance : {1e-3, 1e-4, 5e-6, 1e-6}) {
      model.simulate.tolerance = tolerance;
      model.simulate.output_step = 5e-4;
      const Trajectory run = simulate(model);
      ASSERT_EQ(run.outcome, Outcome::kCompleted) << tolerance << ": " << run.message;
      EXPECT_LT(run.counters.steps, 12000u) << tolerance;
      const auto force = static_cast<std::size_t>(run.column("joint.cord.force"));
      for (std::size_t row = 0; row < run.n_rows() && run.at(row, 0) < kTaut; ++row) EXPECT_EQ(run.at(row, force), 0) << run.at(row, 0);
      rms.push_back(run.joints.at(0).rms);
      EXPECT_NEAR(rms.back(), rms.front(), 1e-4 * rms.front()) << tolerance;
      EXPECT_LT(run.energy.drift, 1e-5 * run.energy.kinetic_peak);
    }
  }
}

// With v^2 = 4 g l at its lowest point a string goes slack at cos a = -2/3, after ln(tan(pi/4 + a/4)) sqrt(l/g), and is taut again after a flight of 4/3 sqrt(10 l/(3 g)).
TEST(Events, RopesTellWhenTheyAreSlackAndTaut) {
  const Trajectory run = reference::completed(reference::test_model("string_pendulum_goes_slack"));
  const std::vector<JointEvent>& events = run.events.at(0).events;
  ASSERT_GE(events.size(), 2U);
  const double slack = std::sqrt(0.1) * std::log(std::tan(kTurn / 8 + std::acos(-2.0 / 3) / 4));
  EXPECT_EQ(events[0].what, "slack");
  EXPECT_NEAR(events[0].t, slack, 1e-4);
  EXPECT_EQ(events[1].what, "taut");
  EXPECT_NEAR(events[1].t, slack + 4.0 / 3 * std::sqrt(1.0 / 3), 1e-4);
}

// The jump of atan2 at the negative axis, and the poles of tan: steps across them found peaks of 1.3 times the largest value.
TEST(Jumps, OfAnglesAreLocated) {
  for (const auto& [angle, largest] : {std::pair{"atan2(sin(30 rad/s*t), cos(30 rad/s*t))", kTurn / 2}, std::pair{"atan(tan(30 rad/s*t))", kTurn / 4}}) {
    const Trajectory run = completed(parse_model(std::string(R"toml(
format = 1
gravity = [0, 0]
simulate.duration = "0.3 s"
ground.markers.O = [0, 0]
body.disc = { mass = 5, inertia = 0.1, markers = { O = [0, 0] } }
joint.O = { type = "revolute", between = ["ground.O", "disc.O"] }
motor.m = { joint = "O", torque = ")toml") + angle + "*(1 N*m/rad)\" }\n", "saw.toml"));
    EXPECT_NEAR(std::abs(run.motors[0].peak_effort), largest, 1e-6) << angle;
  }
}

// The explicit method passes over the jump in a step so short that no curve through it means anything: its peaks are those of the rows. The servo pulls with
// 1e6 N*m/rad times 0.3 rad.
TEST(Jumps, PeaksOfTheExplicitMethodAreThoseAfterTheJump) {
  Model model = reference::test_model("crank_rocker_jump");
  for (const Equations equations : {Equations::kNewtonian, Equations::kRelative}) {
    model.simulate.equations = equations;
    model.simulate.method = "dopri5";
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    EXPECT_NEAR(run.motors.front().peak_effort, 3e5, 0.02 * 3e5) << to_word(equations);
  }
}

}  // namespace
}  // namespace pintle

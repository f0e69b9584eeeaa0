// Energy that appears from nowhere or disappears is noticed; energy that the account explains is not.
#include "run/energy_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "start/start.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

using Alarm = EnergyWatch::Alarm;

struct Pendulum {
  Model model = sample::pendulum(1e8, 1000);
  const Assembly start = start_of_run(model);
  const System& system = start.system;
  State state = start.state;
};

Alarm after_steps(EnergyWatch& watch, const State& state, int steps) {
  for (int i = 0; i < steps; ++i)
    if (const Alarm alarm = watch.see_step(state, 1e-3); alarm != Alarm::kNone) return alarm;
  return Alarm::kNone;
}

TEST(EnergyWatch, WorkThatIsInNoEnergyIsNoticedAtOnce) {
  for (const double missing : {0.1, -0.1}) {
    Pendulum p;
    EnergyWatch watch(p.system, 2, 1e-5, true, true);
    watch.start(p.state);
    EXPECT_EQ(after_steps(watch, p.state, 100), Alarm::kNone);
    p.state.dissipated += missing;
    EXPECT_EQ(after_steps(watch, p.state, 8), Alarm::kOpen);
    EXPECT_NE(watch.message().find(missing > 0 ? "0.1 J too many" : "0.1 J too few"), std::string::npos) << watch.message();
  }
}

// The likely cause is inferred from the elements of the mechanism, and from whether the energy disappeared suddenly.
TEST(EnergyWatch, ALikelyCauseIsNamed) {
  struct Case {
    bool ideal, loaded, sudden;
    const char* cause;
  };
  for (const Case& c : {Case{true, false, true, "likely a singular position of ideal joints"}, {true, false, false, "likely ideal joints near a singular position"}, {true, true, true, "likely a load or motor that changes"},
                        {false, true, true, "likely a load or motor that changes"}, {false, false, true, "likely values of very different magnitude"}, {false, false, false, "likely values of very different magnitude"},
                        {false, true, false, "likely values of very different magnitude"}, {true, true, false, "likely ideal joints near a singular position"}}) {
    Model model = sample::pendulum(1e8, 1000);
    if (c.loaded) {
      AppliedForce load;
      load.on = {"rod", "O"};
      load.torque = sample::expression("0");
      model.forces = {load};
    }
    const Assembly start = start_of_run(model);
    const System system = c.ideal ? sample::with_ideal(start.system, {"pin"}) : start.system;
    State state = start.state;
    EnergyWatch watch(system, 2, 1e-5, true, true);
    watch.start(state);
    Alarm alarm = Alarm::kNone;
    for (int i = 0; i < 100000 && alarm == Alarm::kNone; ++i) {
      state.dissipated += c.sudden ? 1 : 2e-6;
      alarm = after_steps(watch, state, 1);
    }
    EXPECT_EQ(alarm, Alarm::kOpen);
    EXPECT_NE(watch.message().find(c.cause), std::string::npos) << c.ideal << c.loaded << c.sudden << watch.message();
    EXPECT_EQ(watch.message().find("motors that contradict"), std::string::npos);
  }
}

TEST(EnergyWatch, TwoMotorsMayContradictEachOther) {
  Model model = sample::pendulum(1e8, 1000);
  model.motors = {sample::motor("one", "pin", MotorKind::kSpeed, sample::expression("1")), sample::motor("two", "pin", MotorKind::kSpeed, sample::expression("2"))};
  const Assembly start = start_of_run(model);
  EnergyWatch watch(start.system, 2, 1e-5, true, true);
  watch.start(start.state);
  State state = start.state;
  state.dissipated += 1e3;
  EXPECT_EQ(after_steps(watch, state, 1000), Alarm::kOpen);
  EXPECT_NE(watch.message().find("motors that contradict each other"), std::string::npos) << watch.message();
}

TEST(EnergyWatch, TheEndIsJudgedToo) {
  Pendulum p;
  EnergyWatch watch(p.system, 2, 1e-5, true, true);
  watch.start(p.state);
  EXPECT_EQ(watch.see_end(p.state), Alarm::kNone);
  p.state.supplied += 0.1;
  EXPECT_EQ(watch.see_end(p.state), Alarm::kOpen);
}

// The account closes, but elements that can only dissipate have supplied energy.
TEST(EnergyWatch, HeatBelowZeroIsNoticedAtTheEnd) {
  for (const double given : {1e-3, 5.0}) {
    Pendulum p;
    EnergyWatch watch(p.system, 2, 1e-5, true, true);
    watch.start(p.state);
    p.state.dissipated -= given;
    p.state.supplied -= given;
    EXPECT_EQ(watch.see_end(p.state), given > 1 ? Alarm::kOpen : Alarm::kNone) << given;
    EXPECT_EQ(watch.message().find("have delivered 5 J") != std::string::npos, given > 1) << watch.message();
  }
}

TEST(EnergyWatch, WhatErrorsWithinTheToleranceExplainIsNoAlarm) {
  Pendulum p;
  EnergyWatch loose(p.system, 2, 1e-3, true, true), tight(p.system, 2, 1e-6, true, true), of_coarse_work(p.system, 2, 1e-6, false, true);
  for (EnergyWatch* watch : {&loose, &tight, &of_coarse_work}) watch->start(p.state);
  p.state.supplied += 0.05;
  EXPECT_EQ(loose.see_end(p.state), Alarm::kNone);
  EXPECT_EQ(tight.see_end(p.state), Alarm::kOpen);
  EXPECT_EQ(of_coarse_work.see_end(p.state), Alarm::kNone);
  p.state.supplied += 0.1 * of_coarse_work.turnover();
  EXPECT_EQ(of_coarse_work.see_end(p.state), Alarm::kOpen);
}

// A drive that lifts a weight gives what the weight takes: their sum is almost zero, but the error of each is relative to what it turns over.
TEST(EnergyWatch, WhatOneForceGivesAndAnotherTakesIsTurnedOver) {
  Model model = sample::pendulum(1e8, 1000);
  for (const char* torque : {"5e5", "-5e5"}) {
    AppliedForce load;
    load.on = {"rod", "O"};
    load.torque = sample::expression(torque);
    model.forces.push_back(load);
  }
  const Assembly start = start_of_run(model);
  State state = start.state;
  for (auto& v : state.v) v[2] = 2;
  EnergyWatch watch(start.system, 2, 1e-6, true, true);
  watch.start(state);
  watch.see_step(state, 1e-3);
  EXPECT_NEAR(watch.turnover(), 2e3, 30);
}

// Errors of a motion that begins quietly are measured against the later loads once these are known.
TEST(EnergyWatch, AQuietBeginningIsJudgedByWhatAnEarlierPassHasTurnedOver) {
  Pendulum p;
  EnergyWatch whole(p.system, 2, 1e-6, true, true), again(p.system, 2, 1e-6, true, true);
  whole.start(p.state);
  State later = p.state;
  later.supplied = later.dissipated = 1e4;
  later.supply_power = later.loss_power = 1e7;
  whole.see_step(later, 1e-3);
  EXPECT_GT(whole.turnover(), 1e3);
  again.start(p.state);
  EXPECT_LT(again.turnover(), 1e3);
  again.expect(whole.turnover());
  p.state.supplied += 0.05;
  EXPECT_EQ(again.see_end(p.state), Alarm::kNone);
  p.state.supplied += 100 * whole.turnover();
  EXPECT_EQ(again.see_end(p.state), Alarm::kOpen);
}

// Work that is supplied and lost again: only the growth of what is supplied counts.
TEST(EnergyWatch, ExponentialFeedingIsARunawayAndAPowerOfTimeIsNot) {
  const auto alarm = [](const auto& fed) {
    Pendulum p;
    EnergyWatch watch(p.system, 100, 1e-5, false, true);
    watch.start(p.state);
    for (int i = 1; i <= 10000; ++i) {
      p.state.t = 0.01 * i;
      p.state.supplied = p.state.dissipated = fed(p.state.t);
      if (const Alarm now = watch.see_step(p.state, 0.01); now != Alarm::kNone) return now;
    }
    return Alarm::kNone;
  };
  EXPECT_EQ(alarm([](double t) { return std::exp(t); }), Alarm::kRunaway);
  EXPECT_EQ(alarm([](double t) { return t < 50 ? 1e20 / std::pow(50.01 - t, 12) * 1e-20 : 1e24; }), Alarm::kRunaway);  // in finite time
  for (const double power : {1.0, 2.0, 4.0, 8.0}) EXPECT_EQ(alarm([power](double t) { return 1e6 * std::pow(t, power); }), Alarm::kNone) << power;
  EXPECT_EQ(alarm([](double t) { return t < 50 ? 0 : 1e20; }), Alarm::kNone);
  EXPECT_EQ(alarm([](double t) { return t < 50 ? 1 : 1e12 * (t - 50) * (t - 50); }), Alarm::kNone);
}

}  // namespace
}  // namespace pintle

// Lives, pressures and their errors against closed forms and values calculated by hand. theory/bearing_life
#include "pintle/bearings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/constants.h"

namespace pintle {
namespace {

/// A run of one pin that turns steadily under a steady load.
struct PinRun {
  Model model;
  Trajectory run;

  PinRun(Bearing bearing, double force, double rate, double time = 1) {
    Joint joint;
    joint.name = "B";
    joint.type = "revolute";
    joint.bearing = std::move(bearing);
    model.joints.push_back(joint);
    run.t_end = time;
    run.joints.push_back({.name = "B", .type = "revolute", .first_body = "ground", .second_body = "rod", .peak = force, .mean = force});
    const double path = rate * time;
    run.duty.push_back({"B", path, path, rate, force * path, std::pow(force, 3) * path, std::pow(force, 10.0 / 3) * path, force * rate});
  }

  BearingSummary summary() const {
    const auto all = bearing_summaries(model, run);
    return all.size() == 1 ? all.front() : BearingSummary{};
  }
};

Bearing ball(double dynamic, double stationary = 5000) { return {.type = "ball", .dynamic_load_rating = dynamic, .static_load_rating = stationary}; }
Bearing plain(double diameter, double length) { return {.type = "", .pin_diameter = diameter, .pin_length = length}; }

// A film of 40 um on a journal of 24 mm x 14 mm, with a film thickness of `thinnest` in one of its eleven rows.
BearingSummary in_oil(double thinnest, bool recorded = true) {
  PinRun pin({}, 1000, 100);
  Joint& joint = pin.model.joints.front();
  joint.bearing.reset();
  joint.law = {"journal-bearing", {{"journal_radius", {0.012}}, {"bearing_length", {0.014}}, {"roughness", {1e-6}}}};
  if (!recorded) return pin.summary();
  pin.run.columns = {{"t", "s", ""}, {"joint.B.film_thickness", "m", ""}, {"joint.B.eccentricity", "-", ""}};
  for (int row = 0; row < 11; ++row) {
    const double film = row == 3 ? thinnest : 20e-6;
    for (const double x : {0.1 * row, film, 1 - film / 40e-6}) pin.run.values.push_back(x);
  }
  return pin.summary();
}

// Only if the motion is chaotic, and only for forces that are not valid to the end.
TEST(Bearings, ChaosIsSaid) {
  for (const auto& [outcome, horizon, said] : {std::tuple{Outcome::kHorizon, 0.4, true}, {Outcome::kHorizon, 1.0, false}, {Outcome::kCompleted, 0.4, false}}) {
    PinRun pin(ball(10000), 1000, 100);
    pin.run.outcome = outcome;
    pin.run.t_end = 1;
    LoadSummary& load = pin.run.joints.front();
    load.horizon = horizon;
    load.rms_after = load.mean_after = 100;
    load.rms_scatter = 20;
    load.mean_scatter = 10;
    const BearingSummary summary = pin.summary();
    const std::vector<std::string>& remarks = summary.remarks;
    if (said) {
      EXPECT_NEAR(summary.equivalent_load_error, 0.2 * summary.equivalent_load, 1e-9 * summary.equivalent_load);
      EXPECT_NEAR(summary.life_error, 0.6, 1e-9);
    } else {
      EXPECT_LT(summary.equivalent_load_error, 0.1 * summary.equivalent_load);
    }
    EXPECT_EQ(std::any_of(remarks.begin(), remarks.end(), [](const std::string& text) { return text.find("chaotic") != std::string::npos; }), said) << horizon;
  }
}

// Less than a turn in one direction is not a swing; values missing in the bearing's table are not invented.
TEST(Bearings, AShortTurnWithoutARating) {
  const BearingSummary one = PinRun({.type = "ball"}, 1000, 3).summary();
  EXPECT_TRUE(one.remarks.empty());
  EXPECT_NEAR(one.equivalent_load, 1000, 1e-9);
  EXPECT_TRUE(std::isnan(one.life) && std::isnan(one.life_hours) && std::isnan(one.static_safety));
}

TEST(Bearings, NoTimeIsNoSpeed) {
  const BearingSummary one = PinRun(ball(10000), 1000, 5, 0).summary();
  EXPECT_EQ(one.path, 0);
  EXPECT_EQ(one.mean_speed, 0);
}

// Four sectors of a pin of 20 mm x 10 mm; the second has the most friction work, 0.4 N*m.
TEST(Bearings, ALittleWearHasItsDepth) {
  Bearing bearing = plain(0.02, 0.01);
  bearing.wear_coefficient = 1e-15;
  PinRun pin(bearing, 1000, 3);
  pin.run.wear = {{"B", {0.1, 0.4, 0, 0}, {}}};
  EXPECT_NEAR(pin.summary().bush_depth, 1e-15 * 0.4 / (0.01 * 0.5 * std::numbers::pi * 0.01), 1e-18);
  pin.run.wear.front().bush = {0, 0, 0, 0};
  EXPECT_TRUE(std::isnan(pin.summary().bush_depth));
}

TEST(Bearings, SmallForcesHaveASafetyToo) { EXPECT_NEAR(PinRun(ball(10000, 50), 0.5, 100).summary().static_safety, 100, 1e-9); }

TEST(Bearings, AnOilFilmIsMeasuredByItsLaw) {
  const BearingSummary one = in_oil(5e-6);
  EXPECT_NEAR(one.mean_pressure, 1000 / (0.024 * 0.014), 1e-6);
  EXPECT_NEAR(one.peak_sliding, 1.2, 1e-12);
  ASSERT_EQ(one.remarks.size(), 1u);
  EXPECT_EQ(one.remarks[0], "its oil film is thinnest at t = 0.3 s: 5 um, at an eccentricity of 0.875");
  EXPECT_TRUE(in_oil(5e-6, false).remarks.empty());
}

TEST(Bearings, AFilmThatIsTooThinIsSaid) {
  for (const auto& [film, words] : {std::pair{0.5e-6, "leave 0.5 um"}, {-2e-6, "press into each other by 2 um"}}) {
    const BearingSummary one = in_oil(film);
    ASSERT_EQ(one.remarks.size(), 1u);
    EXPECT_EQ(one.remarks[0], std::string("its oil film is too thin: rough surfaces touch in 9.09 % of the rows, most at t = 0.3 s, where smooth ones would ") + words + " (roughness 1 um)");
  }
}

TEST(Bearings, SteadyLoadAndSpeed) {
  const BearingSummary one = PinRun(ball(10000), 1000, 100).summary();
  EXPECT_NEAR(one.path, 100, 1e-10);
  EXPECT_NEAR(one.mean_speed, 100, 1e-10);
  EXPECT_NEAR(one.equivalent_load, 1000, 1e-9);
  EXPECT_NEAR(one.life, 1000, 1e-8);
  EXPECT_NEAR(one.life_hours, 17453.2925, 1e-3);  // 1e9 turns at 954.93 turns per minute
  EXPECT_NEAR(one.static_safety, 5, 1e-12);
  EXPECT_NEAR(one.equivalent_load_error, 0, 1e-9);
  EXPECT_TRUE(one.wants.empty() && one.remarks.empty());
}

// ISO 281 with catalogue values: a 6204 with C = 13.5 kN under 2 kN at 1000 turns per minute; 6.75^3 = 307.546875 million turns.
TEST(Bearings, LifeByHand) {
  const BearingSummary one = PinRun(ball(13500), 2000, 1000 * 2 * kPi / 60).summary();
  EXPECT_NEAR(one.life, 307.546875, 1e-8);
  EXPECT_NEAR(one.life_hours, 5125.78125, 1e-6);
}

TEST(Bearings, RollersHaveTenThirds) {
  Bearing bearing = ball(10000);
  bearing.type = "roller";
  EXPECT_NEAR(PinRun(bearing, 1000, 10).summary().life, 2154.4346900, 1e-6);  // 10^(10/3)
}

// Minkowski: the error of P is no larger than the error of the force. theory/bearing_life Eq. (2.4)
TEST(Bearings, ForceErrorPassesToLoadAndLife) {
  PinRun pin(ball(10000), 1000, 100);
  pin.run.joints.front().error_estimate = 30;
  EXPECT_EQ(pin.summary().equivalent_load_error, 30);
  EXPECT_NEAR(pin.summary().life_error, 0.09, 1e-12);
}

TEST(Bearings, ASwingIsSaid) {
  PinRun pin(ball(10000), 1000, 1.6);
  pin.run.duty.front().swing = 0.8;
  const BearingSummary one = pin.summary();
  ASSERT_EQ(one.remarks.size(), 1U);
  EXPECT_EQ(one.remarks[0], "it swings back and forth by 45.84 deg: its path counts as turns");
  EXPECT_NEAR(one.mean_speed, 1.6, 1e-12);
}

TEST(Bearings, PlainBearingByHand) {
  const BearingSummary one = PinRun(plain(0.020, 0.025), 1000, 30).summary();
  EXPECT_NEAR(one.mean_pressure, 2e6, 1e-6);  // 1000 N on 500 mm^2
  EXPECT_NEAR(one.peak_pressure, 2e6, 1e-6);
  EXPECT_NEAR(one.mean_sliding, 0.3, 1e-12);
  EXPECT_NEAR(one.peak_sliding, 0.3, 1e-12);
  EXPECT_NEAR(one.mean_pv, 0.6e6, 1e-4);
  EXPECT_NEAR(one.peak_pv, 0.6e6, 1e-6);
  EXPECT_TRUE(std::isnan(one.equivalent_load) && std::isnan(one.life) && std::isnan(one.static_safety));
}

TEST(Bearings, SaysWhatItWants) {
  const auto wants = [](Bearing bearing) { return PinRun(bearing, 1000, 10).summary().wants; };
  EXPECT_EQ(wants({}).size(), 1U);
  EXPECT_EQ(wants({.type = "ball"}), (std::vector<std::string>{"state dynamic_load_rating (C) for a life", "state static_load_rating (C0) for a static safety"}));
  EXPECT_EQ(wants({.type = "", .dynamic_load_rating = 1e4, .static_load_rating = 1e4}), std::vector<std::string>{"state type (ball or roller) for an equivalent load and a life"});
  EXPECT_EQ(wants(plain(0.02, 0.02)).size(), 0U);
  EXPECT_EQ(wants({.type = "", .pin_diameter = 0.02}), std::vector<std::string>{"state pin_length for a pressure"});
}

TEST(Bearings, RemarksWhereTheFormulasEnd) {
  const auto remark = [](const BearingSummary& one, const char* part) {
    return std::any_of(one.remarks.begin(), one.remarks.end(), [part](const std::string& text) { return text.find(part) != std::string::npos; });
  };
  EXPECT_TRUE(remark(PinRun(ball(1900), 1000, 10).summary(), "ISO 281"));
  EXPECT_FALSE(remark(PinRun(ball(2100), 1000, 10).summary(), "ISO 281"));
  EXPECT_TRUE(remark(PinRun(ball(1e4, 900), 1000, 10).summary(), "dents"));
  const BearingSummary still = PinRun(ball(1e4), 1000, 0).summary();
  EXPECT_TRUE(remark(still, "does not turn"));
  EXPECT_TRUE(std::isnan(still.life));
  EXPECT_NEAR(still.static_safety, 5, 1e-12);
  PinRun old(ball(1e4), 1000, 10);
  old.run.duty.clear();
  EXPECT_TRUE(remark(old.summary(), "run it again"));
  EXPECT_TRUE(std::isnan(old.summary().path) && std::isnan(old.summary().life));
  EXPECT_NEAR(old.summary().static_safety, 5, 1e-12);
}

TEST(Bearings, FatigueLimitBesideTheLoad) {
  Bearing bearing = ball(1e4);
  bearing.fatigue_load_limit = 250;
  EXPECT_NEAR(PinRun(bearing, 1000, 10).summary().fatigue_ratio, 0.25, 1e-12);
}

TEST(Bearings, OnlyStatedOnesUnlessAllAreAskedFor) {
  PinRun pin(ball(1e4), 1000, 10);
  pin.model.joints.front().bearing.reset();
  EXPECT_TRUE(bearing_summaries(pin.model, pin.run).empty());
  ASSERT_EQ(bearing_summaries(pin.model, pin.run, BearingsOf::kEveryPin).size(), 1U);
  pin.model.joints.front().type = "prismatic";
  EXPECT_TRUE(bearing_summaries(pin.model, pin.run, BearingsOf::kEveryPin).empty());
}

}  // namespace
}  // namespace pintle

// Lives, pressures and their errors against closed forms and numbers calculated by hand. theory/bearing_life
#include "pintle/bearings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "bearings/duty.h"

namespace pintle {
namespace {

/// A run of one pin, row by row: t, fx, fy, angle, rate.
struct PinRun {
  Model model;
  Trajectory run;

  explicit PinRun(Bearing bearing, double force_error = 0) {
    Joint joint;
    joint.name = "B";
    joint.type = "revolute";
    joint.bearing = std::move(bearing);
    model.joints.push_back(joint);
    run.columns = {{"t", "s", ""}, {"joint.B.on_rod.fx[world]", "N", ""}, {"joint.B.on_rod.fy[world]", "N", ""}, {"joint.B.angle", "rad", ""}, {"joint.B.angle_rate", "rad/s", ""}};
    run.joints.push_back({.name = "B", .type = "revolute", .first_body = "ground", .second_body = "rod", .error_estimate = force_error});
  }

  PinRun& add(double t, double fx, double fy, double angle, double rate) {
    for (const double x : {t, fx, fy, angle, rate}) run.values.push_back(x);
    LoadSummary& load = run.joints.front();
    load.peak = std::max(load.peak, std::hypot(fx, fy));
    return *this;
  }

  BearingSummary summary() const {
    const auto all = bearing_summaries(model, run);
    return all.size() == 1 ? all.front() : BearingSummary{};
  }
};

Bearing ball(double dynamic, double stationary = 5000) { return {.type = "ball", .dynamic_load_rating = dynamic, .static_load_rating = stationary}; }
Bearing plain(double diameter, double length) { return {.type = "", .pin_diameter = diameter, .pin_length = length}; }

/// Steady turning under a steady load.
PinRun steady_run(const Bearing& bearing, double force, double rate, double time = 1, int rows = 11) {
  PinRun pin(bearing);
  for (int i = 0; i < rows; ++i) {
    const double t = time * i / (rows - 1);
    pin.add(t, 0, -force, rate * t, rate);
  }
  pin.run.joints.front().mean = force;
  return pin;
}

// A film of 40 um over a journal of 24 mm x 14 mm, whose pin comes as near to the bush as `thinnest` in one of its eleven rows.
BearingSummary in_oil(double thinnest, bool recorded = true) {
  PinRun pin = steady_run({}, 1000, 100);
  Joint& joint = pin.model.joints.front();
  joint.bearing.reset();
  joint.law = {"journal-bearing", {{"journal_radius", {0.012}}, {"bearing_length", {0.014}}, {"roughness", {1e-6}}}};
  if (!recorded) return pin.summary();
  const std::size_t before = pin.run.columns.size();
  pin.run.columns.push_back({"joint.B.film_thickness", "m", ""});
  pin.run.columns.push_back({"joint.B.eccentricity", "-", ""});
  std::vector<double> values;
  for (std::size_t row = 0; row < 11; ++row) {
    values.insert(values.end(), pin.run.values.begin() + static_cast<std::ptrdiff_t>(row * before), pin.run.values.begin() + static_cast<std::ptrdiff_t>((row + 1) * before));
    const double film = row == 3 ? thinnest : 20e-6;
    values.push_back(film);
    values.push_back(1 - film / 40e-6);
  }
  pin.run.values = values;
  return pin.summary();
}

// Only where the motion is chaotic, and only of a force that is not promised to the end.
TEST(Bearings, ChaosIsSaid) {
  for (const auto& [outcome, horizon, said] : {std::tuple{Outcome::kHorizon, 0.4, true}, {Outcome::kHorizon, 1.0, false}, {Outcome::kCompleted, 0.4, false}}) {
    PinRun pin = steady_run(ball(10000), 1000, 100);
    pin.run.outcome = outcome;
    pin.run.t_end = 1;
    pin.run.joints.front().horizon = horizon;
    const std::vector<std::string> remarks = pin.summary().remarks;
    EXPECT_EQ(std::any_of(remarks.begin(), remarks.end(), [](const std::string& text) { return text.find("chaotic") != std::string::npos; }), said) << horizon;
  }
}

// Less than a turn in one direction is no swing; what the bearing's table leaves out is not made up.
TEST(Bearings, AShortTurnWithoutARating) {
  const BearingSummary one = steady_run({.type = "ball"}, 1000, 3).summary();
  EXPECT_TRUE(one.remarks.empty());
  EXPECT_NEAR(one.equivalent_load, 1000, 1e-9);
  EXPECT_TRUE(std::isnan(one.life) && std::isnan(one.life_hours) && std::isnan(one.static_safety));
}

TEST(Bearings, OneRowIsNoPath) {
  const BearingSummary one = PinRun(ball(10000)).add(0, 100, 0, 1, 5).summary();
  EXPECT_EQ(one.path, 0);
  EXPECT_EQ(one.mean_speed, 0);
}

// Four sectors of a pin of 20 mm x 10 mm; the second has rubbed most, by 0.4 N*m.
TEST(Bearings, ALittleWearHasItsDepth) {
  Bearing bearing = plain(0.02, 0.01);
  bearing.wear_coefficient = 1e-15;
  PinRun pin = steady_run(bearing, 1000, 3);
  pin.run.wear = {{"B", {0.1, 0.4, 0, 0}, {}}};
  EXPECT_NEAR(pin.summary().bush_depth, 1e-15 * 0.4 / (0.01 * 0.5 * std::numbers::pi * 0.01), 1e-18);
  pin.run.wear.front().bush = {0, 0, 0, 0};
  EXPECT_TRUE(std::isnan(pin.summary().bush_depth));
}

TEST(Bearings, SmallForcesHaveASafetyToo) { EXPECT_NEAR(steady_run(ball(10000, 50), 0.5, 100).summary().static_safety, 100, 1e-9); }

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
  const BearingSummary one = steady_run(ball(10000), 1000, 100).summary();
  EXPECT_NEAR(one.path, 100, 1e-10);
  EXPECT_NEAR(one.mean_speed, 100, 1e-10);
  EXPECT_NEAR(one.equivalent_load, 1000, 1e-9);
  EXPECT_NEAR(one.life, 1000, 1e-8);
  EXPECT_NEAR(one.life_hours, 17453.2925, 1e-3);  // 1e9 turns at 954.93 turns a minute
  EXPECT_NEAR(one.static_safety, 5, 1e-12);
  EXPECT_NEAR(one.equivalent_load_error, 0, 1e-9);
  EXPECT_TRUE(one.wants.empty() && one.remarks.empty());
}

// ISO 281 with the figures of a catalogue: a 6204 with C = 13.5 kN under 2 kN at 1000 turns a minute; 6.75^3 = 307.546875 million turns.
TEST(Bearings, LifeByHand) {
  const BearingSummary one = steady_run(ball(13500), 2000, 1000 * 2 * kPi / 60).summary();
  EXPECT_NEAR(one.life, 307.546875, 1e-8);
  EXPECT_NEAR(one.life_hours, 5125.78125, 1e-6);
}

TEST(Bearings, RollersHaveTenThirds) {
  Bearing bearing = ball(10000);
  bearing.type = "roller";
  EXPECT_NEAR(steady_run(bearing, 1000, 10).summary().life, 2154.4346900, 1e-6);  // 10^(10/3)
}

// 1 kN at 50 rad/s, then 2 kN at 100 rad/s, as long: the path weighs, not the time.
TEST(Bearings, TwoLevelsOfLoad) {
  PinRun pin(ball(10000));
  pin.add(0, 1000, 0, 0, 50).add(0.5, 1000, 0, 25, 50).add(1, 1000, 0, 50, 50).add(1, 2000, 0, 50, 100).add(1.5, 2000, 0, 100, 100).add(2, 2000, 0, 150, 100);
  const BearingSummary one = pin.summary();
  EXPECT_NEAR(one.path, 150, 1e-10);
  EXPECT_NEAR(one.mean_speed, 75, 1e-10);
  EXPECT_NEAR(one.equivalent_load, 1000 * std::cbrt((50 + 100 * 8) / 150.0), 1e-9);
}

/// One period of angle a sin(w t) with a force made of the phase.
PinRun swinging(const Bearing& bearing, int rows, double amplitude, double w, const std::function<std::pair<double, double>(double)>& force, double force_error = 0) {
  PinRun pin(bearing, force_error);
  for (int i = 0; i < rows; ++i) {
    const double phase = 2 * kPi * i / (rows - 1);
    const auto [fx, fy] = force(phase);
    pin.add(phase / w, fx, fy, amplitude * std::sin(phase), amplitude * w * std::cos(phase));
  }
  return pin;
}

// The rows miss the turning points: the path is found all the same.
TEST(Bearings, SwingsCountTheirPath) {
  const double amplitude = 0.4, w = 20;
  const BearingSummary one = swinging(ball(10000), 52, amplitude, w, [](double) { return std::pair(1000.0, 0.0); }).summary();
  EXPECT_NEAR(one.path, 4 * amplitude, 2e-6 * amplitude);
  EXPECT_NEAR(one.mean_speed, 4 * amplitude * w / (2 * kPi), 2e-5);
  EXPECT_NEAR(one.equivalent_load, 1000, 1e-8);
  ASSERT_EQ(one.remarks.size(), 1U);
  EXPECT_NE(one.remarks[0].find("its path counts as turns"), std::string::npos);
}

// |F| = F0 |cos|, and so is the speed: the integral of cos^4 gives P = F0 (3 pi / 16)^(1/3). The stated error covers the true one, and is not idle.
TEST(Bearings, LoadInPhaseWithTheSpeedAndItsStatedError) {
  const double exact = 1000 * std::cbrt(3 * kPi / 16);
  for (const int rows : {41, 101, 401}) {
    const BearingSummary one = swinging(ball(10000), rows, 0.4, 20, [](double phase) { return std::pair(1000 * std::cos(phase), 0.0); }).summary();
    const double error = std::abs(one.equivalent_load - exact);
    EXPECT_LE(error, one.equivalent_load_error) << rows;
    EXPECT_GE(error, 0.1 * one.equivalent_load_error) << rows;
    EXPECT_LE(std::abs(one.life - std::pow(10000 / exact, 3)), one.life_error * one.life) << rows;
  }
}

// Between two rows the load goes straight from one to the other, in both directions.
TEST(Bearings, LoadsGoStraightBetweenRows) {
  const BearingSummary one = PinRun(ball(10000)).add(0, 900, -200, 0, 1).add(1, -100, 700, 1, 1).summary();
  constexpr int kParts = 1000;
  double cubes = 0;
  for (int i = 0; i < kParts; ++i) {
    const double x = (i + 0.5) / kParts;
    cubes += std::pow(std::hypot(900 - 1000 * x, -200 + 900 * x), 3) / kParts;
  }
  EXPECT_NEAR(one.equivalent_load, std::cbrt(cubes), 1e-3 * one.equivalent_load);
}

// A load that goes round with the pin is cut short between rows: the stated error says by how much.
TEST(Bearings, TurningLoad) {
  PinRun pin(ball(10000));
  for (int i = 0; i <= 180; ++i) {
    const double angle = 2 * kPi * i / 180;
    pin.add(angle, 500 * std::cos(angle), 500 * std::sin(angle), angle, 1);
  }
  const BearingSummary one = pin.summary();
  EXPECT_NEAR(one.equivalent_load, 500, one.equivalent_load_error);
  EXPECT_LT(one.equivalent_load_error, 1e-3 * 500);
}

// Minkowski: whatever the rows are off by, P is off by no more.
TEST(Bearings, ForceErrorPassesToTheLoad) {
  const double off = 30;
  const auto force = [](double phase) { return std::pair(700 + 300 * std::cos(phase), 200 * std::sin(2 * phase)); };
  const auto wrong = [&](double phase) {
    const auto [fx, fy] = force(phase);
    return std::pair(fx + off * std::cos(5 * phase), fy + off * std::sin(5 * phase));
  };
  const BearingSummary right = swinging(ball(10000), 201, 0.4, 20, force, off).summary(), changed = swinging(ball(10000), 201, 0.4, 20, wrong, off).summary();
  EXPECT_LE(std::abs(right.equivalent_load - changed.equivalent_load), off);
  EXPECT_GE(right.equivalent_load_error, off);
}

TEST(Bearings, PlainBearingByHand) {
  const BearingSummary one = steady_run(plain(0.020, 0.025), 1000, 30).summary();
  EXPECT_NEAR(one.mean_pressure, 2e6, 1e-6);  // 1000 N on 500 mm^2
  EXPECT_NEAR(one.peak_pressure, 2e6, 1e-6);
  EXPECT_NEAR(one.mean_sliding, 0.3, 1e-12);
  EXPECT_NEAR(one.peak_sliding, 0.3, 1e-12);
  EXPECT_NEAR(one.mean_pv, 0.6e6, 1e-4);
  EXPECT_NEAR(one.peak_pv, 0.6e6, 1e-6);
  EXPECT_TRUE(std::isnan(one.equivalent_load) && std::isnan(one.life) && std::isnan(one.static_safety));
}

// pv of |F| = F0 |cos| and |rate| = a w |cos|: its mean is half its peak, not the product of the means, 4/pi^2 of it.
TEST(Bearings, MeanPvIsOfTheProduct) {
  const BearingSummary one = swinging(plain(0.020, 0.025), 401, 0.4, 20, [](double phase) { return std::pair(1000 * std::cos(phase), 0.0); }).summary();
  EXPECT_NEAR(one.peak_pv, 2e6 * 0.01 * 0.4 * 20, 1);
  EXPECT_NEAR(one.mean_pv, 0.5 * one.peak_pv, 1e-4 * one.peak_pv);
}

TEST(Bearings, SaysWhatItWants) {
  const auto wants = [](Bearing bearing) { return steady_run(bearing, 1000, 10).summary().wants; };
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
  EXPECT_TRUE(remark(steady_run(ball(1900), 1000, 10).summary(), "ISO 281"));
  EXPECT_FALSE(remark(steady_run(ball(2100), 1000, 10).summary(), "ISO 281"));
  EXPECT_TRUE(remark(steady_run(ball(1e4, 900), 1000, 10).summary(), "dents"));
  const BearingSummary still = steady_run(ball(1e4), 1000, 0).summary();
  EXPECT_TRUE(remark(still, "does not turn"));
  EXPECT_TRUE(std::isnan(still.life));
  EXPECT_NEAR(still.static_safety, 5, 1e-12);
  PinRun unrecorded = steady_run(ball(1e4), 1000, 10);
  unrecorded.run.columns[3].name = "joint.C.angle";
  EXPECT_TRUE(remark(unrecorded.summary(), "simulate.record"));
  EXPECT_NEAR(unrecorded.summary().static_safety, 5, 1e-12);
}

TEST(Bearings, FatigueLimitBesideTheLoad) {
  Bearing bearing = ball(1e4);
  bearing.fatigue_load_limit = 250;
  EXPECT_NEAR(steady_run(bearing, 1000, 10).summary().fatigue_ratio, 0.25, 1e-12);
}

TEST(Bearings, OnlyStatedOnesUnlessAllAreAskedFor) {
  PinRun pin = steady_run(ball(1e4), 1000, 10);
  pin.model.joints.front().bearing.reset();
  EXPECT_TRUE(bearing_summaries(pin.model, pin.run).empty());
  ASSERT_EQ(bearing_summaries(pin.model, pin.run, BearingsOf::kEveryPin).size(), 1U);
  pin.model.joints.front().type = "prismatic";
  EXPECT_TRUE(bearing_summaries(pin.model, pin.run, BearingsOf::kEveryPin).empty());
}

// The path of a cubic with both turning points inside one interval: 0 to 1 with rates -6 at both ends goes down, up and down again.
TEST(Bearings, TurningPointsBetweenRows) {
  const Duty duty({{0, 0, -6, {1, 0}}, {1, 1, -6, {1, 0}}});
  // angle = x (-6 + 21 x - 14 x^2), which turns where 42 x^2 - 42 x + 6 = 0.
  const auto angle = [](double x) { return x * (-6 + 21 * x - 14 * x * x); };
  const double root = std::sqrt(42.0 * 42 - 4 * 42 * 6) / 84, low = 0.5 - root, high = 0.5 + root;
  EXPECT_NEAR(duty.path(), -angle(low) + (angle(high) - angle(low)) + (angle(high) - 1), 1e-12);
}

}  // namespace
}  // namespace pintle

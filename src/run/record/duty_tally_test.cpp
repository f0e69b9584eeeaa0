// The duty of pins against closed forms. theory/bearing_life section 1
#include "run/record/duty_tally.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/constants.h"

namespace pintle {
namespace {

using Function = std::function<double(double)>;
using Force = std::function<std::pair<double, double>(double)>;

struct Turning {
  Function angle, rate;
  Force force;
};

/// Adds `steps` equal steps of seven samples from t0 to t1.
void add(const Turning& pin, double t0, double t1, int steps, DutySums& sums) {
  const CurveGrid grid(CurveGrid::kMost);
  const double h = (t1 - t0) / steps;
  for (int step = 0; step < steps; ++step) {
    TurnSamples turn;
    std::vector<double> force;
    for (int i = 0; i < grid.n(); ++i) {
      const double t = t0 + (step + grid.instant(i)) * h;
      turn.angle[static_cast<std::size_t>(i)] = pin.angle(t);
      turn.rate[static_cast<std::size_t>(i)] = pin.rate(t);
      const auto [x, y] = pin.force(t);
      force.insert(force.end(), {x, y});
    }
    CurveGrid::AtPoints squares;
    for (std::size_t p = 0; p < squares.size(); ++p) squares[p] = weighted_square(grid, grid.at_point(static_cast<int>(p)), force.data(), 2, 2);
    add_duty(grid, {force.data(), 2, 2}, squares, turn, h, sums);
  }
}

DutySums over(const Turning& pin, double t0, double t1, int steps) {
  DutySums sums;
  add(pin, t0, t1, steps, sums);
  return sums;
}

/// Angle a sin t.
Turning swinging(double a, Force force) {
  return {[a](double t) { return a * std::sin(t); }, [a](double t) { return a * std::cos(t); }, std::move(force)};
}

// Loads are weighted by path, not by time: 1 kN at 50 rad/s, then 2 kN at 100 rad/s for the same time.
TEST(DutyTally, TwoLevelsOfLoad) {
  DutySums sums;
  for (const double level : {1.0, 2.0})
    add({[=](double t) { return 50 * level * t; }, [=](double) { return 50 * level; }, [=](double) { return std::pair(600 * level, -800 * level); }}, 0, 1, 3, sums);
  EXPECT_NEAR(sums.path, 150, 1e-12 * 150);
  EXPECT_NEAR(sums.load, 1e3 * (50 + 100 * 2), 1e-12 * 250e3);
  EXPECT_NEAR(sums.load_3, 1e9 * (50 + 100 * 8), 1e-12 * 850e9);
  EXPECT_NEAR(sums.load_10_3, 1e10 * (50 + 100 * std::pow(2, 10.0 / 3)), 1e-12 * 1100e10);
  EXPECT_NEAR(sums.peak_rate, 100, 1e-12);
  EXPECT_NEAR(sums.peak_power, 2e5, 1e-9);
}

// No step ends at a turning point: each lies inside a step.
TEST(DutyTally, SwingsCountTheirPath) {
  const double a = 0.4;
  const DutySums sums = over(swinging(a, [](double) { return std::pair(1000.0, 0.0); }), 0, kTurn, 7);
  EXPECT_NEAR(sums.path, 4 * a, 1e-6 * a);
  EXPECT_NEAR(sums.load_3, 4e9 * a, 1e3 * a);
  EXPECT_NEAR(sums.most - sums.least, 2 * a, 1e-6 * a);
  EXPECT_NEAR(sums.peak_rate, a, 1e-6 * a);
}

// |F| = F0 |cos t|, and |rate| = a |cos t|: integrals of |cos|^(p + 1).
TEST(DutyTally, LoadInPhaseWithTheSpeed) {
  const double a = 0.4;
  const DutySums sums = over(swinging(a, [](double t) { return std::pair(0.0, 1000 * std::cos(t)); }), 0, kTurn, 11);
  EXPECT_NEAR(sums.load, 1e3 * a * kPi, 1e-7 * 1e3);
  EXPECT_NEAR(sums.load_3, 1e9 * a * 0.75 * kPi, 1e-7 * 1e9);
  // Integral of |cos|^(13/3) over a turn: 2 sqrt(pi) Gamma(8/3) / Gamma(19/6).
  EXPECT_NEAR(sums.load_10_3, 1e10 * a * 2 * std::sqrt(kPi) * std::tgamma(8.0 / 3) / std::tgamma(19.0 / 6), 1e-7 * 1e10);
  EXPECT_NEAR(sums.peak_power, 1e3 * a, 1e-5 * 1e3);
}

// The load passes through zero where the pin does not reverse: its magnitude has a kink in the middle of a step.
TEST(DutyTally, LoadThroughZero) {
  const DutySums sums = over({[](double t) { return 0.3 * t; }, [](double) { return 0.3; }, [](double t) { return std::pair(1000 * std::sin(t), 0.0); }}, 0.4, 0.4 + kTurn, 20);
  EXPECT_NEAR(sums.load, 0.3 * 4e3, 1e-8 * 1e3);
  EXPECT_NEAR(sums.load_3, 0.3 * 1e9 * 8 / 3, 1e-8 * 1e9);
  EXPECT_NEAR(sums.load_10_3, 0.3 * 1e10 * 2 * std::sqrt(kPi) * std::tgamma(13.0 / 6) / std::tgamma(8.0 / 3), 1e-8 * 1e10);
}

// A load that rotates with the pin keeps its magnitude between samples.
TEST(DutyTally, TurningLoad) {
  const DutySums sums = over({[](double t) { return t; }, [](double) { return 1.0; }, [](double t) { return std::pair(500 * std::cos(t), 500 * std::sin(t)); }}, 0, kTurn, 8);
  EXPECT_NEAR(std::cbrt(sums.load_3 / sums.path), 500, 1e-6 * 500);
}

// Both turning points of a cubic in one step: from 0 to 1 with a rate of -6 at both ends, it goes down, up and down again.
TEST(DutyTally, TwoTurningPointsInAStep) {
  const auto angle = [](double x) { return x * (-6 + 21 * x - 14 * x * x); };
  const DutySums sums = over({angle, [](double x) { return -6 + 42 * x - 42 * x * x; }, [](double) { return std::pair(1.0, 0.0); }}, 0, 1, 1);
  const double off = std::sqrt(42.0 * 42 - 4 * 42 * 6) / 84, low = 0.5 - off, high = 0.5 + off;
  EXPECT_NEAR(sums.path, -angle(low) + (angle(high) - angle(low)) + (angle(high) - 1), 1e-9);
  EXPECT_NEAR(sums.least, angle(low), 1e-3);
}

TEST(DutyTally, AJointThatStandsStillHasNone) {
  const DutySums sums = over({[](double) { return 0.3; }, [](double) { return 0.0; }, [](double t) { return std::pair(t, 1.0); }}, 0, 1, 2);
  EXPECT_EQ(sums.path, 0);
  EXPECT_EQ(sums.load_3, 0);
  EXPECT_NEAR(sums.most - sums.least, 0, 1e-15);
}

}  // namespace
}  // namespace pintle

// Peaks, means and RMS are those of the forces' curves, regardless of the output step; heat is the loss of each joint.
#include "run/record/load_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "integrators/dense/force_samples.h"
#include "integrators/start_states_for_tests.h"
#include "integrators/stepper.h"
#include "pintle/simulate.h"
#include "run/record/sampled_curve.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

// Sums over a curve in the plane, in `steps` equal steps over 1 s.
template <class Curve>
CurveSums sums_of(const Curve& curve, int steps, int n_samples) {
  const CurveGrid grid(n_samples);
  CurveSums sums;
  std::vector<double> samples(static_cast<std::size_t>(2 * n_samples));
  const double h = 1.0 / steps;
  for (int step = 0; step < steps; ++step) {
    for (int i = 0; i < n_samples; ++i) {
      const auto [x, y] = curve((step + grid.instant(i)) * h);
      samples[static_cast<std::size_t>(2 * i)] = x;
      samples[static_cast<std::size_t>(2 * i + 1)] = y;
    }
    add_curve<2>(grid, samples.data(), 2, step * h, h, sums);
  }
  return sums;
}

TEST(CurveGrid, SamplesWhereDenseOutputFindsTheForces) {
  const CurveGrid grid(CurveGrid::kMost);
  ASSERT_EQ(CurveGrid::kMost, ForceSamples::kAll);
  for (int i = 0; i < CurveGrid::kMost; ++i) EXPECT_EQ(grid.instant(i), ForceSamples::of(RadauTable::of(3)).x[static_cast<std::size_t>(i)]);
}

TEST(CurveGrid, MeetsPolynomialsAndTheirIntegrals) {
  for (const int n : {2, 3, 7}) {
    const CurveGrid grid(n);
    for (int power = 0; power < n; ++power) {
      double integral = 0;
      for (int i = 0; i < n; ++i) integral += grid.integral()[static_cast<std::size_t>(i)] * std::pow(grid.instant(i), power);
      EXPECT_NEAR(integral, 1.0 / (power + 1), 1e-14);
      for (const double x : {0.0, 0.1, 0.5, 0.77, 1.0}) {
        const CurveGrid::Weights weight = grid.weights(x);
        double value = 0;
        for (int i = 0; i < n; ++i) value += weight[static_cast<std::size_t>(i)] * std::pow(grid.instant(i), power);
        EXPECT_NEAR(value, std::pow(x, power), 1e-14) << n << " samples, power " << power;
      }
    }
  }
}

// An ellipse with the half axes 3 and 1, traversed once: the magnitude is largest at its ends, and the mean of its square is 5.
TEST(CurveSums, OfAnEllipse) {
  const auto ellipse = [](double t) { return std::pair{3 * std::cos(2 * std::numbers::pi * (t - 0.28)), std::sin(2 * std::numbers::pi * (t - 0.28))}; };
  const double mean = 12 * std::comp_ellint_2(std::sqrt(8.0 / 9)) / (2 * std::numbers::pi);
  for (const int steps : {5, 7, 16}) {
    const CurveSums sums = sums_of(ellipse, steps, 7);
    EXPECT_NEAR(sums.peak, 3, 1e-5) << steps;
    EXPECT_LT(std::min(std::abs(sums.peak_time - 0.28), std::abs(sums.peak_time - 0.78)), 1e-4) << steps;
    EXPECT_NEAR(sums.square, 5, 1e-5) << steps;
    EXPECT_NEAR(sums.integral, mean, 1e-5) << steps;
  }
  EXPECT_NEAR(sums_of(ellipse, 100, 3).peak, 3, 1e-5);
}

TEST(CurveSums, PeaksAtEndsAndJustInside) {
  for (const double top : {0.0, 0.003, 0.031, 0.5, 0.96, 0.999, 1.0}) {
    const CurveSums sums = sums_of([top](double t) { return std::pair{2 - (t - top) * (t - top), 0.0}; }, 1, 7);
    EXPECT_NEAR(sums.peak, 2, 1e-12) << top;
    EXPECT_NEAR(sums.peak_time, top, 1e-6) << top;
  }
}

// The pin's force is largest when the rod hangs down, at 0.4833 s: rows 0.01 s apart miss it. (Far fewer rows show less of the difference of two passes, and a run that takes
// a pass less has other steps.)
TEST(LoadStatistics, DoNotDependOnTheRows) {
  Model model = sample::pendulum(2e8, 3500);
  model.simulate.duration = 0.9;
  const auto with = [&](double output_step) {
    model.simulate.output_step = output_step;
    return simulate(model).joints.at(0);
  };
  const LoadSummary few = with(0.01), many = with(1e-4);
  EXPECT_NEAR(few.peak, many.peak, 1e-9 * many.peak);
  EXPECT_NEAR(few.mean, many.mean, 1e-9 * many.mean);
  EXPECT_NEAR(few.rms, many.rms, 1e-9 * many.rms);
  EXPECT_NEAR(few.peak_time, many.peak_time, 1e-9);
}

// Compared with values from the rows alone, 10^5 of them.
TEST(LoadStatistics, AreThoseOfVeryManyRows) {
  Model model = sample::four_bar(1e8, 3000);
  model.simulate.duration = 0.6;
  model.simulate.output_step = 6e-6;
  const Trajectory run = simulate(model);
  for (const LoadSummary& joint : run.joints) {
    const std::string on = "joint." + joint.name + ".on_" + joint.second_body;
    const int x = run.column(on + ".fx[world]"), y = run.column(on + ".fy[world]");
    ASSERT_GE(std::min(x, y), 0);
    double peak = 0, mean = 0, square = 0;
    const auto size = [&](std::size_t row) { return std::hypot(run.at(row, static_cast<std::size_t>(x)), run.at(row, static_cast<std::size_t>(y))); };
    for (std::size_t row = 1; row < run.n_rows(); ++row) {
      const double h = (run.at(row, 0) - run.at(row - 1, 0)) / run.t_end, a = size(row - 1), b = size(row);
      peak = std::max({peak, a, b});
      mean += 0.5 * h * (a + b);
      square += 0.5 * h * (a * a + b * b);
    }
    EXPECT_NEAR(joint.peak, peak, 1e-6 * peak) << joint.name;
    EXPECT_NEAR(joint.mean, mean, 1e-6 * mean) << joint.name;
    EXPECT_NEAR(joint.rms, std::sqrt(square), 1e-6 * joint.rms) << joint.name;
  }
}

// Path, cubed load over it, swing and speed of each pin, compared with values from the rows alone.
TEST(LoadStatistics, DutyIsThatOfVeryManyRows) {
  Model model = sample::four_bar(1e8, 3000);
  model.simulate.duration = 0.6;
  const auto with = [&](double output_step) {
    model.simulate.output_step = output_step;
    return simulate(model);
  };
  const Trajectory run = with(6e-6), few = with(0.2);
  ASSERT_EQ(run.duty.size(), run.joints.size());
  ASSERT_EQ(few.duty.size(), run.joints.size());
  for (std::size_t j = 0; j < run.duty.size(); ++j) {
    const PinDuty& pin = run.duty[j];
    const std::string of = "joint." + pin.joint + ".", on = of + "on_" + run.joints[j].second_body;
    std::vector<std::size_t> place;
    for (const std::string& name : {of + "angle", of + "angle_rate", on + ".fx[world]", on + ".fy[world]"}) place.push_back(static_cast<std::size_t>(run.column(name)));
    double least = 1e9, most = -1e9, fastest = 0, path = 0, cubes = 0;
    for (std::size_t row = 0; row < run.n_rows(); ++row) {
      const double angle = run.at(row, place[0]), load = std::hypot(run.at(row, place[2]), run.at(row, place[3]));
      least = std::min(least, angle);
      most = std::max(most, angle);
      fastest = std::max(fastest, std::abs(run.at(row, place[1])));
      if (row == 0) continue;
      const double before = std::hypot(run.at(row - 1, place[2]), run.at(row - 1, place[3])), way = std::abs(angle - run.at(row - 1, place[0]));
      path += way;
      cubes += 0.5 * (std::pow(before, 3) + std::pow(load, 3)) * way;
    }
    EXPECT_NEAR(pin.path, path, 1e-6 * path) << pin.joint;
    EXPECT_NEAR(pin.swing, most - least, 1e-6 * pin.swing) << pin.joint;
    EXPECT_NEAR(pin.peak_rate, fastest, 1e-6 * fastest) << pin.joint;
    EXPECT_NEAR(pin.load_3, cubes, 1e-6 * cubes) << pin.joint;
    EXPECT_NEAR(few.duty[j].load_3, pin.load_3, 1e-9 * pin.load_3) << pin.joint;
    EXPECT_NEAR(few.duty[j].load_10_3, pin.load_10_3, 1e-9 * pin.load_10_3) << pin.joint;
    EXPECT_NEAR(few.duty[j].peak_power, pin.peak_power, 1e-9 * pin.peak_power) << pin.joint;
  }
}

// The losses of all joints add up to those of the run: nothing else dissipates here.
TEST(LoadStatistics, HeatAddsUpToWhatIsLost) {
  Model model = sample::four_bar(1e6, 300);
  model.simulate.duration = 0.6;
  const Trajectory run = simulate(model);
  double heat = 0;
  for (const LoadSummary& joint : run.joints) heat += joint.heat;
  ASSERT_GT(run.energy.dissipated, 0);
  EXPECT_NEAR(heat, run.energy.dissipated, 1e-3 * run.energy.dissipated);
}

// A step of 1 s in which the force of every joint is a function of time; counts how often it is asked for.
class ForcesInAStep final : public Stepper {
 public:
  ForcesInAStep(const System& system, const State& start, std::function<double(double)> force)
      : force_(std::move(force)), previous_(start), end_(start), inside_(start), scale_{} {
    scale_.body.resize(system.bodies.size(), Planar::Vec::Constant(1));
    previous_.t = 0;
    end_.t = 1;
    put(previous_);
    put(end_);
  }
  void set_max_step(double) override {}
  void set_load_scale(const LoadScale&) override {}
  const LoadScale& load_scale() const override { return scale_; }
  void start(const State&, double) override {}
  bool step(double) override { return true; }
  const State& state() const override { return end_; }
  const State& previous() const override { return previous_; }
  const State& interpolate(double t) override {
    ++n_interpolated;
    inside_.t = t;
    put(inside_);
    return inside_;
  }
  const Counters& counters() const override { return counters_; }
  const std::string& failure() const override { return failure_; }
  int n_interpolated = 0;

 private:
  void put(State& state) const {
    for (auto& f : state.force) f = Planar::Vec(force_(state.t), 0, 0);
  }
  std::function<double(double)> force_;
  State previous_, end_, inside_;
  LoadScale scale_;
  Counters counters_;
  std::string failure_;
};

// Forces that are noise, as those of ideal joints next to a singular position, are not sampled again and again; three jumps in a step are followed to the end.
TEST(LoadStatistics, FollowJumpsButNotNoise) {
  const Model model = sample::pendulum(2e8, 3500);
  const System system = build_system(model);
  const State start = sample::plain_start(model, system);
  const auto recorded = [&](const std::function<double(double)>& force, int& n) {
    ForcesInAStep step(system, start, force);
    LoadRecorder recorder(system, {.n = CurveGrid::kMost, .resolution = 1e-8}, false, nullptr);
    recorder.start(step.previous());
    recorder.add_step(step);
    n = step.n_interpolated;
    return recorder.force(0);
  };
  int n = 0;
  const LoadStatistics jumps = recorded([](double t) { return 1.0 + (t > 0.21) + (t > 0.54) - (t > 0.83); }, n);
  EXPECT_NEAR(jumps.mean, 1 + 0.79 + 0.46 - 0.17, 1e-3);
  EXPECT_LT(n, 80 * CurveGrid::kMost);
  recorded([](double t) { return 1 + 1e-3 * std::sin(1e9 * t); }, n);
  EXPECT_LT(n, 80 * CurveGrid::kMost);
}

}  // namespace
}  // namespace pintle

#include "run/record/duty_tally.h"

#include <algorithm>
#include <cmath>

namespace pintle {
namespace {

CurveGrid::AtPoints product(const CurveGrid::AtPoints& a, const CurveGrid::AtPoints& b) {
  CurveGrid::AtPoints out;
  for (std::size_t p = 0; p < out.size(); ++p) out[p] = a[p] * b[p];
  return out;
}

// A pin that turns only one way has its smallest and largest angle at the ends of the step.
void add_swing(const CurveGrid& grid, const CurveGrid::Weights& samples, bool turns_round, DutySums& sums) {
  const auto see = [&sums](double angle) {
    sums.most = std::max(sums.most, angle);
    sums.least = std::min(sums.least, angle);
  };
  see(samples[0]);
  see(samples[static_cast<std::size_t>(grid.n()) - 1]);
  if (!turns_round) return;
  CurveGrid::AtPoints angle;
  along_grid(grid, samples.data(), 1, angle);
  see(largest_on_grid(angle));
  for (double& x : angle) x = -x;
  see(-largest_on_grid(angle));
}

// Raises `peak` to the largest |f|. A parabola through the largest point and two others, none of them negative, exceeds that point by at most an eighth.
void raise_peak(CurveGrid::AtPoints f, double& peak) {
  double largest = 0;
  for (double& x : f) largest = std::max(largest, x = std::abs(x));
  if (1.125 * largest > peak) peak = std::max(peak, largest_on_grid(f));
}

// A part of a step, in fractions of it, in which the pin turns one way, and the curves at the points of a grid over this part.
struct Part {
  double from, to;
  CurveGrid::AtPoints speed, squares;
};

void add_part(const CurveGrid& grid, const ForceSamplesOfStep& force, const TurnSamples& turn, const Part& part, double h, DutySums& sums) {
  const double length = part.to - part.from, time = h * length;
  const auto speed_at = [&](double x) { return std::abs(value_at(grid, turn.rate.data(), 1, part.from + length * x)); };
  const auto square_at = [&](double x) { return weighted_square(grid, grid.weights(part.from + length * x), force.first, force.stride, force.n); };
  // Adds the integral of f(square of the load) over the path.
  const auto add = [&](const CurveGrid::AtPoints& over_path, double& sum, bool every_second, auto f) {
    sum += time * integral_over_step(over_path, sum / time, grid.accuracy(), [&](double x) { return f(square_at(x)) * speed_at(x); }, every_second);
  };
  CurveGrid::AtPoints load;
  for (std::size_t p = 0; p < load.size(); ++p) load[p] = std::sqrt(part.squares[p]);
  sums.path += time * integral_over_step(part.speed, sums.path / time, grid.accuracy(), speed_at);
  CurveGrid::AtPoints over_path = product(load, part.speed);
  add(over_path, sums.load, false, [](double f2) { return std::sqrt(f2); });
  over_path = product(over_path, part.squares);
  add(over_path, sums.load_3, false, [](double f2) { return f2 * std::sqrt(f2); });
  for (std::size_t p = 0; p < load.size(); p += 2) over_path[p] *= std::cbrt(load[p]);  // with a cube root at every point it takes most of the time of this function
  add(over_path, sums.load_10_3, true, [](double f2) { return f2 * std::cbrt(f2 * f2); });
}

// Adds the part from x = from to x = to of a step in which the pin reverses.
void add_between_reversals(const CurveGrid& grid, const ForceSamplesOfStep& force, const TurnSamples& turn, double from, double to, double h, DutySums& sums) {
  Part part{from, to, {}, {}};
  for (std::size_t p = 0; p < part.speed.size(); ++p) {
    const CurveGrid::Weights weight = grid.weights(from + (to - from) * static_cast<double>(p) / CurveGrid::kIntervals);
    part.speed[p] = std::abs(weighted_sum(grid, weight, turn.rate.data(), 1));
    part.squares[p] = weighted_square(grid, weight, force.first, force.stride, force.n);
  }
  add_part(grid, force, turn, part, h, sums);
}

}  // namespace

void add_duty(const CurveGrid& grid, const ForceSamplesOfStep& force, const CurveGrid::AtPoints& squares, const TurnSamples& turn, double h, DutySums& sums) {
  CurveGrid::AtPoints rate, power;
  along_grid(grid, turn.rate.data(), 1, rate);
  const auto [slowest, fastest] = std::minmax_element(rate.begin(), rate.end());
  const bool turns_round = *slowest < 0 && *fastest > 0;
  add_swing(grid, turn.angle, turns_round, sums);
  raise_peak(rate, sums.peak_rate);
  Part whole{0, 1, {}, squares};
  for (std::size_t p = 0; p < power.size(); ++p) power[p] = std::sqrt(squares[p]) * (whole.speed[p] = std::abs(rate[p]));
  raise_peak(power, sums.peak_power);
  if (!turns_round) return add_part(grid, force, turn, whole, h, sums);
  for_each_sign(grid, turn.rate.data(), 1, rate, [&](double from, double to) { add_between_reversals(grid, force, turn, from, to, h, sums); });
}

template <class S>
BasicDutyTally<S>::BasicDutyTally(const BasicSystem<S>& system) : system_(system), pin_of_(system.joints.size(), -1) {
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[static_cast<std::size_t>(j)];
    if (joint.servo >= 0 || joint.free_mask[S::kTurn] == 0 || !joint.free_mask.template head<S::kDim>().isZero()) continue;
    pin_of_[static_cast<std::size_t>(j)] = static_cast<int>(pins_.size());
    pins_.push_back({j, {}, {}});
  }
}

template <class S>
void BasicDutyTally<S>::sample(int i, const BasicState<S>& state) {
  for (Pin& pin : pins_) {
    const auto j = static_cast<std::size_t>(pin.joint), at = static_cast<std::size_t>(i);
    pin.samples.angle[at] = state.gap[j][S::kTurn];
    pin.samples.rate[at] = state.gap_rate[j][S::kTurn];
  }
}

template <class S>
void BasicDutyTally<S>::add_curve(int joint, const CurveGrid& grid, const ForceSamplesOfStep& force, const CurveGrid::AtPoints& squares, double h) {
  const int at = pin_of_[static_cast<std::size_t>(joint)];
  if (at < 0) return;
  Pin& pin = pins_[static_cast<std::size_t>(at)];
  add_duty(grid, force, squares, pin.samples, h, pin.sums);
}

template <class S>
std::vector<PinDuty> BasicDutyTally<S>::result() const {
  std::vector<PinDuty> all;
  for (const Pin& pin : pins_) {
    const DutySums& sums = pin.sums;
    all.push_back({system_.joints[static_cast<std::size_t>(pin.joint)].name, sums.path, std::max(sums.most - sums.least, 0.0), sums.peak_rate, sums.load, sums.load_3, sums.load_10_3, sums.peak_power});
  }
  return all;
}

template class BasicDutyTally<Planar>;
PINTLE_IN_SPACE(template class BasicDutyTally<Spatial>;)

}  // namespace pintle

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

}  // namespace

void add_duty(const CurveGrid& grid, const ForceSamplesOfStep& force, const CurveGrid::AtPoints& squares, const TurnSamples& turn, double h, DutySums& sums) {
  CurveGrid::AtPoints rate, load, speed;
  along_grid(grid, turn.rate.data(), 1, rate);
  const auto [slowest, fastest] = std::minmax_element(rate.begin(), rate.end());
  for (std::size_t p = 0; p < load.size(); ++p) {
    load[p] = std::sqrt(squares[p]);
    speed[p] = std::abs(rate[p]);
  }
  add_swing(grid, turn.angle, *slowest < 0 && *fastest > 0, sums);
  raise_peak(rate, sums.peak_rate);
  const auto speed_at = [&](double x) { return std::abs(value_at(grid, turn.rate.data(), 1, x)); };
  const auto square = [&](double x) { return square_at(grid, force.first, force.stride, force.n, x); };
  // Adds the integral of f(square of the load) over the path.
  const auto add = [&](const CurveGrid::AtPoints& over_path, double& sum, bool every_second, auto f) {
    sum += h * integral_over_step(over_path, sum / h, [&](double x) { return f(square(x)) * speed_at(x); }, every_second);
  };
  sums.path += h * integral_over_step(speed, sums.path / h, speed_at);
  CurveGrid::AtPoints over_path = product(load, speed);
  raise_peak(over_path, sums.peak_power);
  add(over_path, sums.load, false, [](double f2) { return std::sqrt(f2); });
  over_path = product(over_path, squares);
  add(over_path, sums.load_3, false, [](double f2) { return f2 * std::sqrt(f2); });
  for (std::size_t p = 0; p < load.size(); p += 2) over_path[p] *= std::cbrt(load[p]);  // with a cube root at every point it takes most of the time of this function
  add(over_path, sums.load_10_3, true, [](double f2) { return std::pow(f2, 5.0 / 3); });
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

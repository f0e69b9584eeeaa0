#include "run/record/duty_tally.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pintle {
namespace {

/// Integral of the absolute value of the parabola through three equidistant values, in units of their distance. It is split where the sign changes.
double integral_of_size(double before, double here, double after) {
  const double slope = 0.5 * (after - before), bend = 0.5 * (before - 2 * here + after);  // here + slope x + bend x^2
  const double q = -0.5 * (slope + std::copysign(std::sqrt(std::max(slope * slope - 4 * bend * here, 0.0)), slope));
  const auto inside = [](double numerator, double denominator) {
    const double x = numerator / denominator;
    return x > -1 && x < 1 ? x : -1;
  };
  std::array<double, 4> ends{-1, inside(q, bend), inside(here, q), 1};
  std::sort(ends.begin(), ends.end());
  const auto antiderivative = [&](double x) { return x * (here + x * (0.5 * slope + x * bend / 3)); };
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) sum += std::abs(antiderivative(ends[i + 1]) - antiderivative(ends[i]));
  return sum;
}

// Integral of the absolute value of f, which may change its sign: Simpson's rule over pairs of intervals with an end at every `every`th point. Eq. (1.1)
double integral_of_size(const CurveGrid::AtPoints& f, bool changes_sign, std::size_t every = 1) {
  double sum = 0;
  if (changes_sign)
    for (std::size_t p = every; p + every < f.size(); p += 2 * every) sum += integral_of_size(f[p - every], f[p], f[p + every]);
  else
    for (std::size_t p = every; p + every < f.size(); p += 2 * every) sum += (f[p - every] + 4 * f[p] + f[p + every]) / 3;
  return std::abs(sum) * static_cast<double>(every) / CurveGrid::kIntervals;
}

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

void add_duty(const CurveGrid& grid, const CurveGrid::AtPoints& squares, const TurnSamples& turn, double h, DutySums& sums) {
  CurveGrid::AtPoints rate, load;
  along_grid(grid, turn.rate.data(), 1, rate);
  const auto [slowest, fastest] = std::minmax_element(rate.begin(), rate.end());
  const bool turns_round = *slowest < 0 && *fastest > 0;
  for (std::size_t p = 0; p < load.size(); ++p) load[p] = std::sqrt(squares[p]);
  add_swing(grid, turn.angle, turns_round, sums);
  raise_peak(rate, sums.peak_rate);
  sums.path += h * integral_of_size(rate, turns_round);
  CurveGrid::AtPoints over_path = product(load, rate);
  raise_peak(over_path, sums.peak_power);
  sums.load += h * integral_of_size(over_path, turns_round);
  over_path = product(over_path, squares);
  sums.load_3 += h * integral_of_size(over_path, turns_round);
  constexpr std::size_t kEvery = 2;  // a cube root is taken at every such point: with 1, it takes most of the time of this function
  for (std::size_t p = 0; p < load.size(); p += kEvery) over_path[p] *= std::cbrt(load[p]);
  sums.load_10_3 += h * integral_of_size(over_path, turns_round, kEvery);
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
void BasicDutyTally<S>::add_curve(int joint, const CurveGrid& grid, const CurveGrid::AtPoints& squares, double h) {
  const int at = pin_of_[static_cast<std::size_t>(joint)];
  if (at < 0) return;
  Pin& pin = pins_[static_cast<std::size_t>(at)];
  add_duty(grid, squares, pin.samples, h, pin.sums);
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

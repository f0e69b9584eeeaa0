#include "run/record/duty_tally.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pintle {
namespace {

/// Integral of the size of the parabola through three values an even distance apart, in units of that distance. It is cut where it changes its sign.
double integral_of_size(double before, double here, double after) {
  if ((before >= 0 && here >= 0 && after >= 0) || (before <= 0 && here <= 0 && after <= 0)) return std::abs(before + 4 * here + after) / 3;
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

// Simpson's rule over pairs of intervals. Eq. (1.1)
double integral_of_size(const CurveGrid::AtPoints& f) {
  double sum = 0;
  for (std::size_t p = 1; p + 1 < f.size(); p += 2) sum += integral_of_size(f[p - 1], f[p], f[p + 1]);
  return sum / CurveGrid::kIntervals;
}

CurveGrid::AtPoints product(const CurveGrid::AtPoints& a, const CurveGrid::AtPoints& b) {
  CurveGrid::AtPoints out;
  for (std::size_t p = 0; p < out.size(); ++p) out[p] = a[p] * b[p];
  return out;
}

CurveGrid::AtPoints size_of(CurveGrid::AtPoints f) {
  for (double& x : f) x = std::abs(x);
  return f;
}

}  // namespace

template <int n>
void add_duty(const CurveGrid& grid, const double* force, int stride, const TurnSamples& turn, double h, DutySums& sums) {
  CurveGrid::AtPoints angle, rate, component, load{};
  along_grid(grid, turn.angle.data(), 1, angle);
  along_grid(grid, turn.rate.data(), 1, rate);
  for (int c = 0; c < n; ++c) {
    along_grid(grid, force + c, stride, component);
    for (std::size_t p = 0; p < load.size(); ++p) load[p] += component[p] * component[p];
  }
  for (double& x : load) x = std::sqrt(x);
  sums.most = std::max(sums.most, largest_on_grid(angle));
  for (double& x : angle) x = -x;
  sums.least = std::min(sums.least, -largest_on_grid(angle));
  sums.peak_rate = std::max(sums.peak_rate, largest_on_grid(size_of(rate)));
  sums.path += h * integral_of_size(rate);
  CurveGrid::AtPoints over_path = product(load, rate);
  sums.peak_power = std::max(sums.peak_power, largest_on_grid(size_of(over_path)));
  sums.load += h * integral_of_size(over_path);
  over_path = product(product(over_path, load), load);
  sums.load_3 += h * integral_of_size(over_path);
  for (double& x : load) x = std::cbrt(x);
  sums.load_10_3 += h * integral_of_size(product(over_path, load));
}

template void add_duty<2>(const CurveGrid& grid, const double* force, int stride, const TurnSamples& turn, double h, DutySums& sums);
PINTLE_IN_SPACE(template void add_duty<3>(const CurveGrid& grid, const double* force, int stride, const TurnSamples& turn, double h, DutySums& sums);)

template <class S>
BasicDutyTally<S>::BasicDutyTally(const BasicSystem<S>& system) : system_(system) {
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[static_cast<std::size_t>(j)];
    if (joint.servo < 0 && joint.free_mask[S::kTurn] != 0 && joint.free_mask.template head<S::kDim>().isZero()) pins_.push_back({j, {}, {}});
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
void BasicDutyTally<S>::add_curve(const CurveGrid& grid, const double* loads, int stride, double h) {
  for (Pin& pin : pins_) add_duty<S::kDim>(grid, loads + static_cast<std::ptrdiff_t>(pin.joint) * S::kDof, stride, pin.samples, h, pin.sums);
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

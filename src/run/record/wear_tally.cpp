#include "run/record/wear_tally.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/constants.h"

namespace pintle {
namespace {

// Distributes the work done while a contact moves from one angle to another, the shorter way, over the sectors that it passes.
void spread(double from, double to, double work, std::vector<double>& sectors) {
  const auto n = static_cast<double>(sectors.size());
  const double begin = from * n / kTurn, way = std::remainder(to - from, kTurn) * n / kTurn, end = begin + way;
  const double low = std::min(begin, end), high = std::max(begin, end);
  for (double sector = std::floor(low); sector <= high; ++sector) {
    const double share = high > low ? (std::min(high, sector + 1) - std::max(low, sector)) / (high - low) : 1;
    const double turns = std::floor(sector / n);
    sectors[static_cast<std::size_t>(sector - n * turns)] += share * work;
  }
}

}  // namespace

template <class S>
BasicWearTally<S>::BasicWearTally(const BasicSystem<S>& system) : system_(system) {
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[static_cast<std::size_t>(j)];
    const std::vector<LawColumn> columns = joint.law.columns();
    const auto place = [&columns](std::string_view name) { return std::find_if(columns.begin(), columns.end(), [name](const LawColumn& column) { return column.name == name; }) - columns.begin(); };
    const auto n = static_cast<std::ptrdiff_t>(columns.size()), power = place("wear_power"), angle = place("contact_angle");
    if (power == n || angle == n || joint.free_mask[S::kTurn] == 0 || !(joint.law.engaged_stiffness()[0] > 0)) continue;
    worn_.push_back({j, static_cast<std::size_t>(power), static_cast<std::size_t>(angle), {joint.name, std::vector<double>(kSectors), std::vector<double>(kSectors)}, std::vector<Sample>(CurveGrid::kMost)});
  }
}

template <class S>
const std::vector<double>& BasicWearTally<S>::observe(const Worn& worn, const BasicState<S>& state) const {
  const auto j = static_cast<std::size_t>(worn.joint);
  observed_.clear();
  system_.joints[j].law.observe(law_point(system_, worn.joint, state), state.force[j], observed_);
  return observed_;
}

template <class S>
void BasicWearTally<S>::sample(int i, const BasicState<S>& state) {
  for (Worn& worn : worn_) {
    const std::vector<double>& observed = observe(worn, state);
    if (worn.samples.size() <= static_cast<std::size_t>(i)) worn.samples.resize(static_cast<std::size_t>(i) + 1);
    worn.samples[static_cast<std::size_t>(i)] = {observed[worn.power], observed[worn.angle], observed[worn.angle] - state.gap[static_cast<std::size_t>(worn.joint)][S::kTurn]};
  }
}

template <class S>
int BasicWearTally<S>::finer_parts(const CurveGrid& grid) const {
  constexpr int kPerSector = 4;  // samples in each sector that a pin passes: the wear of the sectors of a swing (test Wear) is right to 2.5e-4; with 2, to 1e-3
  constexpr int kAtKink = 32;    // parts of a curve with a kink: the wear of the last sector of that swing is right to 1.1e-3; with 16, to 1.1e-2; with none, to 0.09
  int parts = 0;
  for (const Worn& worn : worn_) {
    std::array<double, CurveGrid::kMost> power{};
    for (int i = 0; i < grid.n(); ++i) power[static_cast<std::size_t>(i)] = worn.samples[static_cast<std::size_t>(i)].power;
    if (power == decltype(power){}) continue;  // nothing touches
    const Sample &first = worn.samples.front(), &last = worn.samples[static_cast<std::size_t>(grid.n() - 1)];
    const double contact = std::remainder(last.on_bush - first.on_bush, kTurn), pin = (last.on_bush - last.on_pin) - (first.on_bush - first.on_pin);
    const double sectors = std::max(std::abs(pin), std::abs(contact)) * kSectors / kTurn;
    if (sectors > 1) parts = std::max(parts, kPerSector * static_cast<int>(std::ceil(sectors)));
    if (2 * kAtKink * grid.chebyshev_tail(power.data(), 1) > *std::max_element(power.begin(), power.end())) parts = std::max(parts, kAtKink);
  }
  return parts;
}

template <class S>
void BasicWearTally<S>::add(Worn& worn, int after, double work) {
  if (!(work > 0)) return;
  const Sample &from = worn.samples[static_cast<std::size_t>(after)], &to = worn.samples[static_cast<std::size_t>(after) + 1];
  spread(from.on_bush, to.on_bush, work, worn.wear.bush);
  spread(from.on_pin, to.on_pin, work, worn.wear.pin);
}

template <class S>
void BasicWearTally<S>::add_curve(const CurveGrid& grid, double h) {
  for (Worn& worn : worn_)
    for (int i = 0; i + 1 < grid.n(); ++i) {
      const CurveGrid::Weights& weight = grid.integral_after(i);
      double work = 0;
      for (int k = 0; k < grid.n(); ++k) work += h * weight[static_cast<std::size_t>(k)] * worn.samples[static_cast<std::size_t>(k)].power;
      add(worn, i, work);
    }
}

template <class S>
void BasicWearTally<S>::add_trapezoids(int n, double h) {
  for (Worn& worn : worn_)
    for (int i = 0; i < n; ++i) add(worn, i, 0.5 * h / n * (worn.samples[static_cast<std::size_t>(i)].power + worn.samples[static_cast<std::size_t>(i) + 1].power));
}

template <class S>
std::vector<JointWear> BasicWearTally<S>::result() const {
  std::vector<JointWear> all;
  for (const Worn& worn : worn_) all.push_back(worn.wear);
  return all;
}

template class BasicWearTally<Planar>;
PINTLE_IN_SPACE(template class BasicWearTally<Spatial>;)

}  // namespace pintle

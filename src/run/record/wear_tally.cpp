#include "run/record/wear_tally.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace pintle {
namespace {

std::size_t sector_of(double angle, int n) {
  const double turns = angle / kTurn, share = turns - std::floor(turns);
  return std::min(static_cast<std::size_t>(n * share), static_cast<std::size_t>(n - 1));
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
    worn_.push_back({j, static_cast<std::size_t>(power), static_cast<std::size_t>(angle), {joint.name, std::vector<double>(kSectors), std::vector<double>(kSectors)}});
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
int BasicWearTally<S>::parts(const BasicState<S>& begin, const BasicState<S>& end) const {
  constexpr int kPerSector = 4;
  double most = 0;  // [sectors]
  for (const Worn& worn : worn_) {
    const auto j = static_cast<std::size_t>(worn.joint);
    const double pin = end.gap[j][S::kTurn] - begin.gap[j][S::kTurn], first = observe(worn, begin)[worn.angle], contact = std::remainder(observe(worn, end)[worn.angle] - first, kTurn);
    most = std::max({most, std::abs(pin) * kSectors / kTurn, std::abs(contact) * kSectors / kTurn});
  }
  return most > 1 ? kPerSector * static_cast<int>(std::ceil(most)) : 0;
}

template <class S>
void BasicWearTally<S>::add(const BasicState<S>& state, double seconds) {
  for (Worn& worn : worn_) {
    const std::vector<double>& observed = observe(worn, state);
    const double work = seconds * observed[worn.power], angle = observed[worn.angle];
    if (!(work > 0)) continue;
    worn.wear.bush[sector_of(angle, kSectors)] += work;
    worn.wear.pin[sector_of(angle - state.gap[static_cast<std::size_t>(worn.joint)][S::kTurn], kSectors)] += work;
  }
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

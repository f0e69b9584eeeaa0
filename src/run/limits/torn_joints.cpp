#include "run/limits/torn_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/constants.h"
#include "system/size_about_origin.h"

namespace pintle {
namespace {

// Fraction of the mechanism's size: a joint that deflects by more is torn, if the weight of the whole mechanism deflects it by less than this fraction of that; softer
// joints are meant to deflect. No stiff joint of the collection deflects by a twentieth of it; with double it a rod that is shorter than its crank by a tenth is not reported.
constexpr double kTorn = 0.02;

// Ropes, contacts and pads stretch and yield along one line, as they are made to. And the peak of a joint with stops may be the force of a stop.
template <class S>
bool is_made_to_yield(const BasicLaw<S>& law) {
  const auto held = (law.engaged_stiffness().template head<S::kDim>().array() > 0).count();
  return (law.starts_free() && held <= 1) || std::any_of(law.parts().begin(), law.parts().end(), [](const auto& part) { return part->stops(); });
}

// The largest stiffness of a joint against displacements, as of a blade pulled lengthwise [N/m]; infinite if it holds none, is ideal, or is made to yield.
template <class S>
double largest_stiffness(const BasicJointData<S>& joint) {
  if (is_made_to_yield(joint.law)) return std::numeric_limits<double>::infinity();
  const double largest = joint.servo >= 0 || joint.ideal ? 0 : joint.law.engaged_stiffness().template head<S::kDim>().maxCoeff();
  return largest > 0 ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace

template <class S>
BasicDeflectionScale<S>::BasicDeflectionScale(const BasicSystem<S>& system, const BasicState<S>& start) : size_(size_about_origin(system, start.q)) {
  double weight = 0;
  for (const auto& body : system.bodies) weight += kStandardGravity * body.mass[0];
  for (const BasicJointData<S>& joint : system.joints) {
    const double stiffness = largest_stiffness(joint);
    compliance_.push_back(weight / stiffness < kTorn * kTorn * size_ ? 1 / stiffness : 0);
  }
}

template <class S>
std::string note_on_torn_joint(const BasicSystem<S>& system, const BasicState<S>& start, const std::vector<LoadSummary>& joints) {
  const BasicDeflectionScale<S> deflection(system, start);
  double farthest = kTorn;
  const LoadSummary* torn = nullptr;
  for (std::size_t j = 0, row = 0; j < system.joints.size() && row < joints.size(); ++j) {
    if (system.joints[j].servo >= 0) continue;
    const LoadSummary& joint = joints[row++];
    if (!(deflection.of(j, joint.peak) > farthest)) continue;
    farthest = deflection.of(j, joint.peak);
    torn = &joint;
  }
  if (torn == nullptr) return "";
  return fmt::format("joint {} is torn open by {:.2g} m, {:.0f} % of the mechanism's size, at t = {:.4g} s (its peak of {:.4g} N over its stiffness): no machine survives that. Check the signs and units of what drives it, "
                     "and whether the mechanism can make the prescribed motion",
                     torn->name, farthest * deflection.size(), 100 * farthest, torn->peak_time, torn->peak);
}

template class BasicDeflectionScale<Planar>;
PINTLE_IN_SPACE(template class BasicDeflectionScale<Spatial>;)
template std::string note_on_torn_joint(const BasicSystem<Planar>& system, const BasicState<Planar>& start, const std::vector<LoadSummary>& joints);
PINTLE_IN_SPACE(template std::string note_on_torn_joint(const BasicSystem<Spatial>& system, const BasicState<Spatial>& start, const std::vector<LoadSummary>& joints);)

}  // namespace pintle

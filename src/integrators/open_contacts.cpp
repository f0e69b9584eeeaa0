#include "integrators/open_contacts.h"

#include <numeric>

namespace pintle {

template <class S>
std::vector<int> all_joints(const BasicSystem<S>& system) {
  std::vector<int> all(system.joints.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

template <class S>
BasicOpenContacts<S>::BasicOpenContacts(const BasicSystem<S>& system) : BasicOpenContacts(system, all_joints(system)) {}

template <class S>
BasicOpenContacts<S>::BasicOpenContacts(const BasicSystem<S>& system, const std::vector<int>& joints) : system_(system) {
  const auto may_be_apart = [](const auto& part) { return part->n_borders() > 0 && !part->closed_stiffness().isZero(0); };
  for (const int j : joints) {
    const BasicJointData<S>& joint = system.joints[j];
    if (!joint.ideal && std::any_of(joint.law.parts().begin(), joint.law.parts().end(), may_be_apart)) joints_.push_back(j);
  }
}

template std::vector<int> all_joints(const System& system);
PINTLE_IN_SPACE(template std::vector<int> all_joints(const BasicSystem<Spatial>& system);)
template class BasicOpenContacts<Planar>;
PINTLE_IN_SPACE(template class BasicOpenContacts<Spatial>;)

}  // namespace pintle

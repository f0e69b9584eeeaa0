#include "integrators/open_contacts.h"

namespace pintle {

template <class S>
BasicOpenContacts<S>::BasicOpenContacts(const BasicSystem<S>& system) : system_(system) {
  const auto may_be_apart = [](const auto& part) { return part->n_borders() > 0 && !part->closed_stiffness().isZero(0); };
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[j];
    if (!joint.ideal && std::any_of(joint.law.parts().begin(), joint.law.parts().end(), may_be_apart)) joints_.push_back(j);
  }
}

template class BasicOpenContacts<Planar>;
PINTLE_IN_SPACE(template class BasicOpenContacts<Spatial>;)

}  // namespace pintle

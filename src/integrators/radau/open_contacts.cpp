#include "integrators/radau/open_contacts.h"

namespace pintle {

template <class S>
BasicOpenContacts<S>::BasicOpenContacts(const BasicSystem<S>& system) : system_(system) {
  for (int j = 0; j < system.n_joints(); ++j)
    for (const auto& part : system.joints[j].law.parts())
      if (part->n_borders() > 0 && !part->meeting_stiffness().isZero(0)) {
        joints_.push_back(j);
        break;
      }
}

template <class S>
double BasicOpenContacts<S>::error_of(int j, const std::vector<typename S::Motion>& m, const BasicLawPoint<S>& at, double rounding, const BasicLoadScale<S>& scale) const {
  const BasicJointData<S>& joint = system_.joints[j];
  const typename S::Vec stiffness = joint.law.stiffness_of_what_is_apart(at);
  if (stiffness.isZero(0)) return 0;
  const typename S::Vec missed = ((system_.kinematics(j, at.t, m).gap - at.gap).cwiseAbs().array() - rounding).cwiseMax(0);
  return stiffness.cwiseProduct(missed).cwiseQuotient(load_on(joint.at, scale)).maxCoeff();
}

template class BasicOpenContacts<Planar>;
PINTLE_IN_SPACE(template class BasicOpenContacts<Spatial>;)

}  // namespace pintle

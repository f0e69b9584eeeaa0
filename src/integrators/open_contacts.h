// Joints that are apart, and how accurately a step knows their distance. theory/time section 3.4.
#pragma once

#include <algorithm>
#include <vector>

#include "integrators/load_scale.h"
#include "integrators/thresholds.h"

namespace pintle {

/// The joints of a system that may be apart: contacts, stops, ropes, bearings with play.
template <class S>
class BasicOpenContacts {
 public:
  explicit BasicOpenContacts(const BasicSystem<S>& system);

  bool empty() const { return joints_.empty(); }
  /// The uncertainty of the gaps at the end of a step of h, less the rounding of positions up to `far`, as a force once the bodies have met, over the load
  /// scale: the largest of the joints that are apart there. carried(j): joint j as the step has integrated it; kinematics(j): from the bodies' poses;
  /// last_coefficient(b): the last Legendre coefficient of body b's acceleration. theory/time Eq. (3.23).
  template <class Carried, class Kinematics, class LastCoefficient>
  double error(double h, const Carried& carried, const Kinematics& kinematics, const LastCoefficient& last_coefficient, double far, const BasicLoadScale<S>& scale) const {
    constexpr double kOfBend = 0.1;  // fraction of the displacement by the last coefficient over a step: the unresolved part for a spring on the bodies with half a period in the step. With 0 a shift fork strikes its stop late, and its forces are wrong by 38 times the tolerance
    double largest = 0;
    for (const int j : joints_) {
      const BasicJointData<S>& joint = system_.joints[j];
      const BasicLawPoint<S> at = carried(j);
      const typename S::Vec stiffness = joint.law.open_contact_stiffness(at);
      if (stiffness.isZero(0)) continue;
      BasicJointKinematics<S> r = kinematics(j);
      count_turns(joint.displacement, at.gap[0], r.gap);
      typename S::Vec bend = S::Vec::Zero();
      if (joint.at.a != kGround) bend += r.GA() * last_coefficient(joint.at.a);
      if (joint.at.b != kGround) bend += r.GB() * last_coefficient(joint.at.b);
      const typename S::Vec missed = ((r.gap - at.gap).cwiseAbs().cwiseMax(kOfBend * h * h * bend.cwiseAbs()).array() - kLastBits * far).cwiseMax(0);
      largest = std::max(largest, stiffness.cwiseProduct(missed).cwiseQuotient(load_in_gap_axes(joint.at, scale)).maxCoeff());
    }
    return largest;
  }

 private:
  const BasicSystem<S>& system_;
  std::vector<int> joints_;
};
using OpenContacts = BasicOpenContacts<Planar>;

}  // namespace pintle

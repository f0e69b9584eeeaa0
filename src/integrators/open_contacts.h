// Joints that are apart, and how accurately a step knows their distance. theory/time section 3.4.
#pragma once

#include <algorithm>
#include <vector>

#include "integrators/load_scale.h"
#include "integrators/thresholds.h"

namespace pintle {

template <class S>
std::vector<int> all_joints(const BasicSystem<S>& system);

/// The joints of a system that may be apart: contacts, stops, ropes, bearings with play.
template <class S>
class BasicOpenContacts {
 public:
  explicit BasicOpenContacts(const BasicSystem<S>& system);
  /// Those of `joints` alone.
  BasicOpenContacts(const BasicSystem<S>& system, const std::vector<int>& joints);

  bool empty() const { return joints_.empty(); }
  /// The uncertainty of the bodies' positions at the end of a step of h, less the rounding of positions up to `far`, as a force once the bodies have met, over the load
  /// scale: the largest of the joints that are apart there. carried(j): joint j as the step has integrated it; kinematics(j): from the bodies' poses;
  /// last_coefficient(b): the last Legendre coefficient of body b's acceleration. theory/time Eq. (3.23).
  template <class Carried, class Kinematics, class LastCoefficient>
  double error(double h, const Carried& carried, const Kinematics& kinematics, const LastCoefficient& last_coefficient, double far, const BasicLoadScale<S>& scale) const {
    constexpr double kOfBend = 0.1;  // fraction of the displacement by the last coefficient over a step: the unresolved part for a spring on the bodies with half a period in the step. With 0 a shift fork strikes its stop late, and its forces are wrong by 38 times the tolerance
    double largest = 0;
    for (const int j : joints_) {
      const BasicJointData<S>& joint = system_.joints[j];
      const typename S::Vec stiffness = joint.law.open_contact_stiffness(carried(j));
      if (stiffness.isZero(0)) continue;
      const BasicJointKinematics<S> r = kinematics(j);
      typename S::Vec bend = S::Vec::Zero();
      if (joint.at.a != kGround) bend += r.GA() * last_coefficient(joint.at.a);
      if (joint.at.b != kGround) bend += r.GB() * last_coefficient(joint.at.b);
      const typename S::Vec missed = (kOfBend * h * h * bend.cwiseAbs().array() - kLastBits * far).cwiseMax(0);
      largest = std::max(largest, stiffness.cwiseProduct(missed).cwiseQuotient(load_in_gap_axes(joint.at, scale)).maxCoeff());
    }
    return largest;
  }

  /// Within a step a gap that carries no force need not be integrated: that of the bodies' positions replaces it, with its rate, where the two differ by more than the rounding
  /// of positions up to `far`. start(j): joint j at the start of the step, which decides whether it is apart; kinematics(j): from the bodies' poses within the step;
  /// replace(j, r): sets the gap and its rate, given the kinematics.
  template <class Start, class Kinematics, class Gap, class Replace>
  void follow_positions(const Start& start, const Kinematics& kinematics, const Gap& gap, double far, const Replace& replace) const {
    for (const int j : joints_) {
      const BasicJointData<S>& joint = system_.joints[j];
      if (joint.law.open_contact_stiffness(start(j)).isZero(0)) continue;
      BasicJointKinematics<S> r = kinematics(j);
      const typename S::Vec carried = gap(j);
      count_turns(joint.displacement, carried[0], r.gap);
      if (has_slip(joint.displacement)) r.gap[kSlip] = carried[kSlip];
      if ((r.gap - carried).cwiseAbs().maxCoeff() > kLastBits * far) replace(j, r);
    }
  }

 private:
  const BasicSystem<S>& system_;
  std::vector<int> joints_;
};
using OpenContacts = BasicOpenContacts<Planar>;

}  // namespace pintle

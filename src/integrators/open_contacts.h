// Joints that are apart, and how well a step knows how far. theory/time section 3.4.
#pragma once

#include <algorithm>
#include <vector>

#include "integrators/load_scale.h"

namespace pintle {

/// The joints of a system that may be apart: contacts, stops, ropes, bearings with play.
template <class S>
class BasicOpenContacts {
 public:
  explicit BasicOpenContacts(const BasicSystem<S>& system);

  bool empty() const { return joints_.empty(); }
  /// What the difference between the gap that a step has integrated and that of its bodies' poses at its end, less their `rounding`, would be as a force once
  /// the bodies have met, over the load scale: the largest of the joints that are apart there. carried(j): joint j as integrated; gap_from_geometry(j).
  /// theory/time Eq. (3.23).
  template <class Carried, class GapFromGeometry>
  double error(const Carried& carried, const GapFromGeometry& gap_from_geometry, double rounding, const BasicLoadScale<S>& scale) const {
    double largest = 0;
    for (const int j : joints_) {
      const BasicJointData<S>& joint = system_.joints[j];
      const BasicLawPoint<S> at = carried(j);
      const typename S::Vec stiffness = joint.law.open_contact_stiffness(at);
      if (stiffness.isZero(0)) continue;
      const typename S::Vec missed = ((gap_from_geometry(j) - at.gap).cwiseAbs().array() - rounding).cwiseMax(0);
      largest = std::max(largest, stiffness.cwiseProduct(missed).cwiseQuotient(load_across(joint.at, scale)).maxCoeff());
    }
    return largest;
  }

 private:
  const BasicSystem<S>& system_;
  std::vector<int> joints_;
};
using OpenContacts = BasicOpenContacts<Planar>;

}  // namespace pintle

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
  /// What the difference between the gaps that a step has integrated and those of its bodies' poses at its end, less their `rounding`, would be as a force once the bodies
  /// have met, over the load scale: the largest of the joints that are apart there. m: the bodies' motions at the end; gap_of(j), rate_of(j): of joint j there. theory/time Eq. (3.23).
  template <class Gap, class Rate>
  double error(double t, const std::vector<typename S::Motion>& m, const Gap& gap_of, const Rate& rate_of, const double* law_state, double rounding, const BasicLoadScale<S>& scale) const {
    double largest = 0;
    for (const int j : joints_) largest = std::max(largest, error_of(j, m, {t, gap_of(j), rate_of(j), law_state + system_.joints[j].first_state}, rounding, scale));
    return largest;
  }

 private:
  double error_of(int j, const std::vector<typename S::Motion>& m, const BasicLawPoint<S>& at, double rounding, const BasicLoadScale<S>& scale) const;

  const BasicSystem<S>& system_;
  std::vector<int> joints_;
};
using OpenContacts = BasicOpenContacts<Planar>;

}  // namespace pintle

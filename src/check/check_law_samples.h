// Gaps and rates at which a joint's law is checked: as assembled, and about as far on either side.
#pragma once

#include "check/check_links.h"

namespace pintle {

struct LawSample {
  Planar::Vec gap, rate;            // [m, m, rad] and per second
  Planar::Vec gap_size, rate_size;  // typical of this joint
  Planar::Vec loaded;               // a gap of this size on the side on which the law acts: surfaces that press do so below 0
};

/// `state` 0 gives what the assembled state has; others are disturbed, with elastic and damping forces alike.
LawSample law_sample(const JointData& joint, const State& assembled, int j, const CheckState& state);

}  // namespace pintle

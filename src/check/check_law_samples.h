// Gaps and rates at which a joint's law is checked: as assembled, and disturbed by about as much to either
// side.
#pragma once

#include "check/check_links.h"

namespace pintle {

struct LawSample {
  Planar::Vec gap, rate;            // [m, m, rad] and per second
  Planar::Vec gap_size, rate_size;  // typical of this joint
  Planar::Vec loaded;               // a gap of this size on the side on which the law acts: surfaces press at negative gaps
};

/// `state` 0 gives the assembled values; others are disturbed so that elastic and damping forces are about
/// equal.
LawSample law_sample(const JointData& joint, const State& assembled, int j, const CheckState& state);

}  // namespace pintle

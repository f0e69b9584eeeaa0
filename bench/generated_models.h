// A mechanism of arbitrary size, made without a file; others are in tests/large_models.h.
#pragma once

#include "pintle/model.h"

namespace pintle::bench {

/// 2n equal bars in n crossed pairs, folded into a steep lattice that opens: one pin on the ground, one on a slider.
Model scissor_chain(int n);

}  // namespace pintle::bench

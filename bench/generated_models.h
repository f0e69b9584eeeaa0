// Mechanisms of any size, made without a file.
#pragma once

#include "pintle/model.h"

namespace pintle::bench {

/// A chain of n links that hangs from the ground and starts level.
Model chain(int n);

/// N four-bars side by side, as mechanisms/n_four_bar.py makes them: problem A02 of the IFToMM library with bearings.
Model n_four_bar(int n);

/// 2n equal bars in n crossed pairs, folded to a steep lattice that opens: one pin on the ground, one on a slider.
Model scissor_chain(int n);

}  // namespace pintle::bench

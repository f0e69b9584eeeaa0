// The high frequencies due to joint stiffness, and their damping. theory/checks.
#pragma once

#include "pintle/check.h"
#include "system/state.h"

namespace pintle {

/// `n_free`: number of motions that no joint or servo resists; that many of the slowest modes are not vibrations and
/// are omitted. Negative: not known; then only the fastest mode is computed.
CheckFrequencies check_frequencies(const System& system, const State& assembled, int n_free);

/// The longest stable step of Dormand-Prince 5(4) for y'' + 2 ratio frequency y' + frequency^2 y = 0 [s].
double dormand_prince_step(double frequency, double damping_ratio);

}  // namespace pintle

// The loads that relative errors refer to. theory/time section 3.5.
#pragma once

#include "system/state.h"

namespace pintle {

/// How large the forces are that a relative tolerance refers to: per body the sum of the magnitudes of the loads on it.
struct LoadScale {
  Vecs body;  // [N, N, N*m]
};

/// At least this much per mass, where nothing acts [m/s^2].
inline constexpr double kLeastLoad = 1e-9;

/// Raises `scale` to what acts on each body of `state`: r are the joints' readings there, Q the external forces. `load` is
/// scratch, one per body.
void grow_load_scale(const System& system, const std::vector<Reading>& r, const Vecs& Q, const State& state, Vecs& load, LoadScale& scale);

/// The same where nothing has been read yet: m are the motions of `state`.
void grow_load_scale(const System& system, const std::vector<Planar::Motion>& m, const Vecs& Q, const State& state, LoadScale& scale);

}  // namespace pintle

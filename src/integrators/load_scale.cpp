#include "integrators/load_scale.h"

namespace pintle {

using S = Planar;

void grow_load_scale(const System& system, const std::vector<S::Motion>& m, const Vecs& Q, const State& state, LoadScale& scale) {
  const std::size_t n = system.bodies.size();
  Vecs load(n + 1, S::Vec::Zero());  // and on the ground
  for (std::size_t i = 0; i < n; ++i) load[i] = Q[i].cwiseAbs() + system.bodies[i].mass.cwiseProduct(state.a[i]).cwiseAbs();
  for (int j = 0; j < system.n_joints(); ++j) {
    const Placement& at = system.joints[j].at;
    add_magnitudes(system.reading(j, state.t, m).map, state.force[j], load[at.a == kGround ? n : at.a], load[at.b == kGround ? n : at.b]);
  }
  for (std::size_t i = 0; i < n; ++i) raise_scale(system.bodies[i], load[i], scale.body[i]);
}

}  // namespace pintle

#include "integrators/load_scale.h"

#include <cmath>

namespace pintle {

using S = Planar;

void grow_load_scale(const System& system, const std::vector<S::Motion>& m, const Vecs& Q, const State& state, LoadScale& scale) {
  Vecs load(system.bodies.size());
  for (std::size_t i = 0; i < load.size(); ++i) load[i] = Q[i].cwiseAbs() + system.bodies[i].mass.cwiseProduct(state.a[i]).cwiseAbs();
  for (int j = 0; j < system.n_joints(); ++j) {
    const Placement& at = system.joints[j].at;
    const auto on = system.kinematics(j, state.t, m).map.spread(state.force[j].data());
    const double fx = std::abs(on.fx), fy = std::abs(on.fy);
    if (at.a != kGround) load[at.a] += S::Vec(fx, fy, std::abs(on.ma));
    if (at.b != kGround) load[at.b] += S::Vec(fx, fy, std::abs(on.mb));
  }
  for (std::size_t i = 0; i < load.size(); ++i) raise_scale(system.bodies[i], load[i], scale.body[i]);
}

}  // namespace pintle

#include "integrators/tree_load_scale.h"

#include <algorithm>
#include <cmath>

namespace pintle {

using S = Planar;

void grow_load_scale(const System& system, const std::vector<S::Motion>& m, const Vecs& Q, const State& state, LoadScale& scale) {
  Vecs load(system.bodies.size());
  for (std::size_t i = 0; i < load.size(); ++i) load[i] = Q[i].cwiseAbs() + system.bodies[i].mass.cwiseProduct(state.a[i]).cwiseAbs();
  for (int j = 0; j < system.n_joints(); ++j) {
    const Placement& at = system.joints[j].at;
    const Reading r = system.reading(j, state.t, m);
    if (at.a != kGround) load[at.a] += (r.GA.transpose() * state.force[j]).cwiseAbs();
    if (at.b != kGround) load[at.b] += (r.GB.transpose() * state.force[j]).cwiseAbs();
  }
  for (std::size_t i = 0; i < load.size(); ++i) {
    const S::Vec& mass = system.bodies[i].mass;
    const double radius = std::sqrt(mass[2] / mass[0]);
    double force = std::max({scale.body[i][0], load[i][0], load[i][1], 1e-9 * mass[0]});
    double moment = std::max(scale.body[i][2], load[i][2]);
    force = std::max(force, 1e-3 * moment / radius);
    moment = std::max(moment, 1e-3 * force * radius);
    scale.body[i] << force, force, moment;
  }
}

}  // namespace pintle

#include "integrators/load_scale.h"

#include <algorithm>
#include <cmath>

namespace pintle {

using S = Planar;

void grow_load_scale(const System& system, const std::vector<Reading>& r, const Vecs& Q, const State& state, Vecs& load, LoadScale& scale) {
  for (std::size_t i = 0; i < load.size(); ++i) load[i] = Q[i].cwiseAbs() + system.bodies[i].mass.cwiseProduct(state.a[i]).cwiseAbs();
  for (int j = 0; j < system.n_joints(); ++j) {
    const Placement& at = system.joints[j].at;
    const auto on = r[j].map.spread(state.force[j].data());
    const double fx = std::abs(on.fx), fy = std::abs(on.fy);
    if (at.a != kGround) load[at.a] += S::Vec(fx, fy, std::abs(on.ma));
    if (at.b != kGround) load[at.b] += S::Vec(fx, fy, std::abs(on.mb));
  }
  for (std::size_t i = 0; i < load.size(); ++i) {
    const S::Vec& mass = system.bodies[i].mass;
    const double radius = system.bodies[i].radius_of_gyration();
    double force = std::max({scale.body[i][0], load[i][0], load[i][1], kLeastLoad * mass[0]});
    double moment = std::max(scale.body[i][2], load[i][2]);
    force = std::max(force, 1e-3 * moment / radius);
    moment = std::max(moment, 1e-3 * force * radius);
    scale.body[i] << force, force, moment;
  }
}

void grow_load_scale(const System& system, const std::vector<S::Motion>& m, const Vecs& Q, const State& state, LoadScale& scale) {
  std::vector<Reading> r;
  system.readings(state.t, m, r);
  Vecs load(system.bodies.size());
  grow_load_scale(system, r, Q, state, load, scale);
}

}  // namespace pintle

#include "integrators/load_scale.h"

#include <cmath>

namespace pintle {

template <class S>
void grow_load_scale(const BasicSystem<S>& system, const std::vector<typename S::Motion>& m, const VecsOf<S>& Q, const BasicState<S>& state, BasicLoadScale<S>& scale) {
  VecsOf<S> load(system.bodies.size());
  for (std::size_t i = 0; i < load.size(); ++i) load[i] = Q[i].cwiseAbs() + system.bodies[i].mass.cwiseProduct(state.a[i]).cwiseAbs();
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicPlacement<S>& at = system.joints[j].at;
    typename S::Vec on_ground;
    system.kinematics(j, state.t, m).map.push_magnitudes(state.force[j].data(), at.a != kGround ? load[at.a] : on_ground, at.b != kGround ? load[at.b] : on_ground);
  }
  for (std::size_t i = 0; i < load.size(); ++i) raise_scale(system.bodies[i], load[i], scale.body[i]);
}

template void grow_load_scale(const BasicSystem<Planar>& system, const std::vector<Planar::Motion>& m, const VecsOf<Planar>& Q, const BasicState<Planar>& state, BasicLoadScale<Planar>& scale);
PINTLE_IN_SPACE(template void grow_load_scale(const BasicSystem<Spatial>& system, const std::vector<Spatial::Motion>& m, const VecsOf<Spatial>& Q, const BasicState<Spatial>& state, BasicLoadScale<Spatial>& scale);)

}  // namespace pintle

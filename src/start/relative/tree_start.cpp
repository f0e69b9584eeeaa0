#include "start/relative/tree_start.h"

#include <algorithm>

#include "start/locks.h"
#include "start/relative/tree_gaps.h"

namespace pintle {

using S = Planar;

namespace {

constexpr double kStiffAtLeast = 1e12;    // lower limit on the stiffness of a tree joint's law during assembly, which is also at least that of every other joint [N/m]
constexpr double kRelaxation = 1e-5;      // ratio of such a law's damping to its stiffness [s]

}  // namespace

System with_stiff_tree(System system, const JointTree& tree) {
  double stiffest = kStiffAtLeast, size = 0;
  for (const int j : tree.laws())
    stiffest = std::max(stiffest, system.joints[j].law.engaged_stiffness().head<2>().maxCoeff());
  for (const BodyData& body : system.bodies) size = std::max(size, body.mass[2] / body.mass[0]);
  for (int j = 0; j < system.n_joints(); ++j) {
    if (!tree.in_tree(j)) continue;
    JointData& joint = system.joints[j];
    LinearLaw law;
    law.k = stiffest * S::Vec(1, 1, size).cwiseProduct(S::Vec::Ones() - joint.free_mask);
    law.c = kRelaxation * law.k;
    const int states = joint.law.n_states();
    joint.law = law;
    if (states > 0) joint.law.add(inert_states(states));
  }
  system.finish(&system);
  return system;
}

void convert_to_tree(const System& system, bool preloaded, State& state) {
  const JointTree tree(system);
  TreeState start;
  TreeGaps gaps(system, tree);
  read_coordinates(tree, state, start);
  gaps.set_gaps_from_bodies(start);
  if (preloaded) {
    for (std::size_t l = 0; l < tree.laws().size(); ++l) {
      const auto j = static_cast<std::size_t>(tree.laws()[l]);
      const auto i = 3 * static_cast<Eigen::Index>(l);
      start.gap.segment<3>(i) = state.gap[j];
      start.rate.segment<3>(i) = state.gap_rate[j];
      start.accel.segment<3>(i) = state.gap_accel[j];
      start.force.segment<3>(i) = state.force[j];
    }
    start.law_state = state.law_state;
    gaps.move_onto_gaps(start);
  }
  gaps.balance(start);
  gaps.instant().place(start.t, start.y, start.u);
  gaps.instant().write(start, start.w, state);
}

}  // namespace pintle

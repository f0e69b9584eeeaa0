#include "start/relative/tree_start.h"

#include <algorithm>
#include <utility>

#include "integrators/relative/tree_radau.h"
#include "start/preload.h"
#include "start/relative/tree_preload.h"
#include "start/seat.h"
#include "start/settle_joints.h"
#include "start/slow_manifold.h"
#include "start/touching.h"

namespace pintle {
namespace {

using S = Planar;

constexpr double kStiffAtLeast = 1e12;    // lower limit on the stiffness of a tree joint's law during assembly, which is also at least that of every other joint [N/m]
constexpr double kRelaxation = 1e-5;      // ratio of such a law's damping to its stiffness [s]

// With laws for the tree's joints that are stiff enough for their deflection to be negligible.
System stiffened(System system, const JointTree& tree) {
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
    joint.law = law;
  }
  return system;
}

System with_laws_of(System system, const System& other) {
  for (int j = 0; j < system.n_joints(); ++j) system.joints[j].law = other.joints[j].law;
  return system;
}

void write(TreeInverseDynamics& forces, const TreeState& from, State& to) {
  forces.instant().place(from.t, from.y, from.u);
  forces.instant().write(from, from.w, to);
}

// As for free bodies: a start from sweeps that have not converged is rejected, and joints may ring.
bool put_onto_slow_manifold(const JointTree& tree, const System& system, double span, TreeState& start) {
  for (int i = 0; i < kSpans && span > 0; ++i, span *= 0.25) {
    TreeState attempt = start;
    if (!(move_tree_onto_slow_manifold(system, tree, span, attempt) < kSettledSweep)) continue;
    start = std::move(attempt);
    return true;
  }
  return false;
}

void take_over(const JointTree& tree, const System& system, const SimulateSettings& settings, Assembly& assembly) {
  State& state = assembly.state;
  TreeState start;
  TreeInverseDynamics forces(system, tree);
  read_coordinates(tree, state, start);
  const bool preload = is_preloaded(settings.start) && !tree.laws().empty();
  start_tree_forces(forces, preload, start);
  write(forces, start, state);
  if (!preload) return;
  if (put_onto_slow_manifold(tree, system, 0.5 * natural_step<TreeRadau>(system, state, settings.duration), start)) write(forces, start, state);
  else note_not_settled(system, state, assembly.notes);
}

}  // namespace

Assembly start_over_tree(const Model& model, const System& system) {
  Assembly assembly = assemble_unloaded(model, stiffened(system, JointTree(system)));
  if (model.simulate.start == Start::kSeated) note_seated(assembly);
  if (is_preloaded(model.simulate.start)) press_touching_surfaces(assembly);
  start_forces(assembly.system, is_preloaded(model.simulate.start), assembly.state);
  assembly.system = with_laws_of(std::move(assembly.system), system);
  take_over(JointTree(assembly.system), assembly.system, model.simulate, assembly);
  return assembly;
}

}  // namespace pintle

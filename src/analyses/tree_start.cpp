#include "analyses/tree_start.h"

#include <algorithm>
#include <cmath>

#include "integrators/tree_projector.h"

namespace pintle {
namespace {

using S = Planar;
using Eigen::VectorXd;

constexpr double kStiffer = 1e4, kStiffAtLeast = 1e12;  // over the stiffest other joint; [N/m]
constexpr double kRelaxation = 1e-5;                    // damping over stiffness of a tree joint's law [s]
constexpr double kSlow = 1e-2;                          // [1/s]: modes above are moved onto their gaps
constexpr int kPasses = 4;

// Laws for the tree's joints so stiff that they give way by nothing that matters.
void stiffen(const JointTree& tree, System& system) {
  double stiffest = kStiffAtLeast / kStiffer, size = 0;
  for (const int j : tree.laws())
    stiffest = std::max(stiffest, respond(system.joints[j].law, S::Vec::UnitX(), S::Vec::Zero()).stiffness.diagonal().head<2>().maxCoeff());
  for (const BodyData& body : system.bodies) size = std::max(size, body.mass[2] / body.mass[0]);
  for (int j = 0; j < system.n_joints(); ++j) {
    if (!tree.in_tree(j)) continue;
    JointData& joint = system.joints[j];
    LinearLaw law;
    law.k = kStiffer * stiffest * S::Vec(1, 1, size).cwiseProduct(S::Vec::Ones() - joint.free_mask);
    law.c = kRelaxation * law.k;
    joint.law = law;
  }
}

// Coordinates and rates moved until the bodies have the carried gaps; what no motion can close is taken from the bodies.
void move_onto_gaps(TreeInstant& at, TreeProjector& projector, TreeState& state) {
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * largest_coordinate(at.pose().q);
  VectorXd now;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (!projector.prepare(at, kSlow, state.gap, state.rate)) return;
    at.gaps(now);
    state.y += projector.close(state.gap - now);
    at.place(state.t, state.y, state.u);
    at.rates(now);
    state.u += projector.close(state.rate - now);
    at.place(state.t, state.y, state.u);
  }
  at.gaps(now);
  for (Eigen::Index i = 0; i < now.size(); ++i)
    if (std::abs(now[i] - state.gap[i]) > rounding) state.gap[i] = now[i];
  at.rates(state.rate);
}

void take_over(const JointTree& tree, const System& system, bool preloaded, State& state) {
  TreeState carried;
  TreeInstant at(system, tree);
  TreeProjector projector;
  TreePose pose;
  carried.t = state.t;
  tree.read_positions(state.q, carried.y);
  tree.place(carried.y, VectorXd::Zero(tree.n()), pose);
  tree.read_rates(pose, state.v, carried.u);
  take_carried(tree, state, carried);
  at.place(carried.t, carried.y, carried.u);
  if (preloaded) {
    move_onto_gaps(at, projector, carried);
  } else {
    at.gaps(carried.gap);
    at.rates(carried.rate);
  }
  at.forces(carried.gap, carried.rate, carried.force);
  if (!projector.prepare(at, kSlow, carried.gap, carried.rate)) return;
  projector.accelerations(at, carried.force, carried.w);
  at.accelerate(carried.w);
  at.gap_accelerations(carried.accel);
  at.write(carried, carried.w, state);
}

}  // namespace

Assembly start_over_tree(const Model& model, System& system, const std::function<Assembly(const Model&, System&)>& free_bodies) {
  const JointTree tree(system);
  System stiff = system;
  stiffen(tree, stiff);
  Assembly assembly = free_bodies(model, stiff);
  for (int j = 0; j < system.n_joints(); ++j) stiff.joints[j].law = system.joints[j].law;
  system = std::move(stiff);
  take_over(tree, system, model.simulate.start == Start::kAssembled, assembly.state);
  for (std::string& line : tree.notes()) assembly.notes.push_back(std::move(line));
  return assembly;
}

}  // namespace pintle

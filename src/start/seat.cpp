#include "start/seat.h"

#include "dynamics/inverse_dynamics.h"
#include "laws/gap_at_force.h"
#include "start/start_forces.h"

namespace pintle {
namespace {

using S = Planar;

// 1 N or 1 N*m on a component, or as much the other way, finds a side of the play.
bool has_two_sides(const BasicLaw<S>& law, int component) {
  for (const double way : {1.0, -1.0}) {
    S::Vec gap = S::Vec::Zero();
    if (!go_out_against<S>(law, way * S::Vec::Unit(component), S::Vec::Zero(), gap)) return false;
  }
  return true;
}

bool stands_in_play(const JointData& joint) {
  if (joint.law.ideal_limit() || joint.law.feeds()) return false;
  const S::Vec engaged = joint.law.engaged_stiffness();
  const BasicResponse<S> middle = respond<S>(joint.law, S::Vec::Zero(), S::Vec::Zero());
  for (int k = 0; k < S::kDof; ++k)
    if (joint.free_mask[k] == 0 && engaged[k] > 0 && !(middle.stiffness(k, k) > 0) && !(middle.damping(k, k) > 0) && has_two_sides(joint.law, k)) return true;
  return false;
}

// The same mechanism without its plays: springs as stiff as the laws where these act.
System without_play(const System& system, const std::vector<int>& joints) {
  System firm = system;
  for (const int j : joints) {
    LinearLaw spring;
    spring.k = system.joints[j].law.engaged_stiffness().cwiseProduct(S::Vec::Ones() - system.joints[j].free_mask);
    firm.joints[j].law = BasicLaw<S>(spring);
  }
  return firm;
}

std::string names_of(const System& system, const std::vector<int>& joints) {
  std::string names;
  for (const int j : joints) names += (names.empty() ? "" : ", ") + system.joints[j].name;
  return names;
}

}  // namespace

std::vector<int> joints_in_play(const System& system) {
  std::vector<int> out;
  for (int j = 0; j < system.n_joints(); ++j)
    if (stands_in_play(system.joints[j])) out.push_back(j);
  return out;
}

std::string names_of_joints_in_play(const System& system) { return names_of(system, joints_in_play(system)); }

std::string seat_joints(const System& system, State& state) {
  const std::vector<int> loose = joints_in_play(system);
  if (loose.empty()) return "";
  const System firm = without_play(system, loose);
  State carried = state;
  start_forces(firm, true, carried);
  std::vector<int> unloaded;
  const double nothing = kFits * largest_force(carried.force);
  for (const int j : loose) {
    S::Vec gap = S::Vec::Zero();
    const bool presses = carried.force[j].norm() > nothing && go_out_against<S>(system.joints[j].law, carried.force[j], S::Vec::Zero(), gap);
    if (presses) gap_at_force<S>(system.joints[j].law, carried.force[j], S::Vec::Zero(), gap);
    else unloaded.push_back(j);
    carried.gap[j] = gap;
  }
  BasicInverseDynamics<S>(firm).move_onto_gaps(carried);
  state.q = carried.q;
  state.v = carried.v;
  return names_of(system, unloaded);
}

}  // namespace pintle

#include "run/record/creeping_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pintle {
namespace {

// Judged by the law's columns.
template <class S>
bool is_contact(const BasicLaw<S>& law) {
  const std::vector<LawColumn> columns = law.columns();
  return std::any_of(columns.begin(), columns.end(), [](const LawColumn& column) { return column.name == "approach_speed"; });
}

}  // namespace

template <class S>
std::string note_on_creeping_contacts(const BasicSystem<S>& system, const BasicState<S>& end, double duration) {
  constexpr double kShare = 0.02, kSlow = 0.02;  // share of the force that is damping; damping over stiffness, as a fraction of the run
  std::string names;
  double largest_share = 0, slowest = 0;
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[j];
    const double force = end.force[j].template head<S::kDim>().norm();
    if (!(force > 0) || !is_contact(joint.law)) continue;
    BasicLawTangents<S> law;
    joint.law.linearize(law_point(system, j, end), law);
    bool creeps = false;
    for (int k = 0; k < S::kDim; ++k) {
      const double stiffness = std::abs(law.stiffness(k, k)), damping = std::abs(law.damping(k, k)), share = damping * std::abs(end.gap_rate[j][k]) / force;
      if (!(share > kShare) || !(damping > kSlow * duration * stiffness) || stiffness == 0) continue;
      creeps = true;
      largest_share = std::max(largest_share, share);
      slowest = std::max(slowest, damping / stiffness);
    }
    if (creeps) names += (names.empty() ? "" : ", ") + joint.name;
  }
  if (names.empty()) return "";
  return fmt::format("contacts that are still settling under their load at the end ({}): up to {:.2g} of their force is damping, which makes them take {:.2g} s to follow the load, and loads shared with other joints are still shifting. "
                     "A slowly loaded contact is damped as in an impact at least_approach_speed; with a larger one, or a restitution nearer to 1, it settles sooner",
                     names, largest_share, slowest);
}

template std::string note_on_creeping_contacts(const System& system, const State& end, double duration);
PINTLE_IN_SPACE(template std::string note_on_creeping_contacts(const BasicSystem<Spatial>& system, const BasicState<Spatial>& end, double duration);)

}  // namespace pintle

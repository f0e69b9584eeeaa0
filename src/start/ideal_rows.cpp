#include "start/ideal_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "laws/catalog.h"
#include "mobility/mobility.h"
#include "mobility/rank.h"

namespace pintle {
namespace {

constexpr int kDenseFreedoms = 900;  // number of coordinates up to which the rank of the constraints is found by a dense decomposition

std::string list_of_members(const CheckRedundancy& group) {
  constexpr std::size_t kShown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, group.members.size()); ++i)
    text += fmt::format("{}{}.{}", i == 0 ? "" : ", ", group.members[i].joint, group.members[i].component);
  if (group.members.size() > kShown) text += fmt::format(" and {} more", group.members.size() - kShown);
  return text;
}

// The rows to omit at q, from rows whose rank is known.
std::vector<int> dependent_rows(const System& system, const std::vector<ConstraintRow>& rows, const std::vector<JointKinematics>& joint_kinematics,
                                double tolerance) {
  const double length = arm_length(system, joint_kinematics);
  std::vector<char> kept(rows.size(), 0);
  if (3 * system.n_bodies() <= kDenseFreedoms) {
    for (const int row : DenseRank(rows, system, length, tolerance).independent_rows()) kept[row] = 1;
  } else {
    std::fill(kept.begin(), kept.end(), 1);
    for (const auto& dependency : sparse_rank(rows, system, length, tolerance).dependencies) {
      const auto last = std::find_if(dependency.rbegin(), dependency.rend(), [&](int row) { return kept[row] != 0; });
      if (last != dependency.rend()) kept[*last] = 0;
    }
  }
  std::vector<int> out;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!kept[i]) out.push_back(static_cast<int>(i));
  return out;
}

}  // namespace

System make_ideal(const Model& model, System system) {
  std::set<std::string> flexible;
  for (const Joint& joint : model.joints)
    if (const LawInfo* law = find_law(joint.law.word); law != nullptr && law->yields) flexible.insert(joint.name);
  for (JointData& joint : system.joints) joint.ideal = joint.constrained = joint.law.ideal_limit() && !joint.law.feeds() && !(joint.servo < 0 && flexible.contains(joint.name));
  return system;
}

void name_undetermined_reactions(const std::vector<CheckRedundancy>& groups, const std::function<bool(const std::string&)>& is_ideal, const char* what, std::vector<std::string>& notes,
                                 std::vector<std::string>& not_unique) {
  for (const CheckRedundancy& group : groups) {
    if (std::none_of(group.members.begin(), group.members.end(), [&](const CheckRedundancy::Member& member) { return is_ideal(member.joint); })) continue;  // their laws share the loads
    notes.push_back(fmt::format("{}: {} redundant constraint{} among {}: the motion is unique, these reactions are not", what, group.degree, group.degree == 1 ? "" : "s", list_of_members(group)));
    for (const auto& member : group.members)
      if (std::find(not_unique.begin(), not_unique.end(), member.joint) == not_unique.end()) not_unique.push_back(member.joint);
  }
}

IdealRows choose_ideal_rows(System system, const Vecs& q) {
  IdealRows out;
  const MobilityCheck mobility = check_mobility(system, q);
  const std::vector<JointKinematics> joint_kinematics = kinematics_at_rest(system, mobility.regular);
  std::vector<ConstraintRow> rows;
  for (const ConstraintRow& row : constraint_rows(system, joint_kinematics, 0))
    if (system.joints[row.joint].ideal) rows.push_back(row);
  for (const int i : dependent_rows(system, rows, joint_kinematics, mobility.counts.rank_tolerance)) {
    JointData& joint = system.joints[rows[i].joint];
    joint.redundant[rows[i].component] = true;
  }
  const auto is_ideal = [&system](const std::string& name) {
    return std::any_of(system.joints.begin(), system.joints.end(), [&name](const JointData& joint) { return joint.ideal && joint.name == name; });
  };
  if (mobility.counts.singular_position())
    out.notes.push_back("the start is a singular position: the constraints do not determine all reactions there, and those of t = 0, which may be the peaks, are one choice of many. Start beside it, or use equations = \"newtonian\"");
  name_undetermined_reactions(mobility.redundancies, is_ideal, "ideal joints", out.notes, out.not_unique);
  out.system = std::move(system);
  return out;
}

}  // namespace pintle

#include "mobility/redundancy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace pintle {
namespace {

// Disjoint sets of rows.
class Groups {
 public:
  explicit Groups(std::size_t n) : root_(n) { std::iota(root_.begin(), root_.end(), 0); }
  int find(int i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(int i, int j) { root_[find(i)] = find(j); }

 private:
  std::vector<int> root_;
};

CheckRedundancy::Member member(const System& system, const ConstraintRow& row, double share) {
  const JointData& joint = system.joints[row.joint];
  return {joint.name, component_name(joint, row.component), share};
}

void sort_members(CheckRedundancy& group) {
  std::stable_sort(group.members.begin(), group.members.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share + 1e-9; });
}

}  // namespace

std::vector<CheckRedundancy> redundancies(const System& system, const std::vector<ConstraintRow>& rows,
                                          const DenseRank& rank) {
  constexpr double kCoupled = 1e-6,
                   kSharing = 1e-5;  // the projector's entries are accurate to about roundoff / smallest kept pivot
  std::vector<CheckRedundancy> out;
  const int n = static_cast<int>(rows.size());
  if (n == rank.rank()) return out;
  const Eigen::MatrixXd projector = rank.dependencies();
  Groups groups(rows.size());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j)
      if (std::abs(projector(i, j)) > kCoupled) groups.join(i, j);
  std::map<int, std::vector<int>> members;
  for (int i = 0; i < n; ++i) members[groups.find(i)].push_back(i);
  for (const auto& [root, list] : members) {
    double degree = 0;
    for (const int i : list) degree += projector(i, i);
    if (degree < 0.5) continue;
    CheckRedundancy& group = out.emplace_back();
    group.degree = static_cast<int>(std::lround(degree));
    for (const int i : list)
      if (projector(i, i) > kSharing) group.members.push_back(member(system, rows[i], projector(i, i)));
    sort_members(group);
  }
  return out;
}

std::vector<CheckRedundancy> redundancies(const System& system, const std::vector<ConstraintRow>& rows,
                                          const SparseRank& rank) {
  Groups groups(rows.size());
  for (const auto& dependency : rank.dependencies)
    for (const int i : dependency) groups.join(i, dependency.front());
  std::map<int, CheckRedundancy> by_root;
  std::set<std::pair<int, int>> taken;  // a row may be in several dependencies of its group
  for (const auto& dependency : rank.dependencies) {
    CheckRedundancy& group = by_root[groups.find(dependency.front())];
    group.degree = group.members.empty() ? 1 : group.degree + 1;
    for (const int i : dependency) {
      if (taken.emplace(rows[i].joint, rows[i].component).second) group.members.push_back(member(system, rows[i], 0));
    }
  }
  std::vector<CheckRedundancy> out;
  for (auto& [root, group] : by_root) out.push_back(std::move(group));
  return out;
}

}  // namespace pintle

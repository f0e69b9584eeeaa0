#include "check/check_topology.h"

#include <algorithm>

namespace pintle {
namespace {

constexpr std::size_t kMaxListedLoops = 1000;

// A spanning forest of bodies (the ground is node n), grown breadth first so that loops are short.
class SpanningForest {
 public:
  explicit SpanningForest(const System& system)
      : system_(system),
        n_(system.n_bodies()),
        joints_of_(n_ + 1),
        parent_(n_ + 1, -1),
        by_(n_ + 1, -1),
        depth_(n_ + 1, -1) {
    for (int j = 0; j < system.n_joints(); ++j) {
      if (system.joints[j].servo >= 0) continue;
      joints_of_[node(system.joints[j].at.a)].push_back(j);
      joints_of_[node(system.joints[j].at.b)].push_back(j);
    }
    grow(n_);
    for (int i = 0; i < n_; ++i)
      if (depth_[i] < 0) floating_.push_back(grow(i));
  }

  // Bodies of each tree that does not contain the ground.
  const std::vector<std::vector<int>>& floating() const { return floating_; }
  // The joints that close loops, one for each loop.
  const std::vector<int>& closing() const { return closing_; }

  // The joints of the loop that joint j closes.
  std::vector<int> loop(int j) const {
    std::vector<int> up, down;
    int a = node(system_.joints[j].at.a), b = node(system_.joints[j].at.b);
    while (a != b) {
      if (depth_[a] >= depth_[b]) {
        up.push_back(by_[a]);
        a = parent_[a];
      } else {
        down.push_back(by_[b]);
        b = parent_[b];
      }
    }
    up.insert(up.end(), down.rbegin(), down.rend());
    up.push_back(j);
    return up;
  }

 private:
  int node(int body) const { return body == kGround ? n_ : body; }

  std::vector<int> grow(int root) {
    std::vector<int> reached{root};
    depth_[root] = 0;
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const int at = reached[next];
      for (const int j : joints_of_[at]) {
        const int a = node(system_.joints[j].at.a), b = node(system_.joints[j].at.b), other = a == at ? b : a;
        if (by_[at] == j || by_[other] == j) continue;
        if (depth_[other] >= 0) {
          if (a == at) closing_.push_back(j);  // reached from both ends, but counted once
          continue;
        }
        parent_[other] = at;
        by_[other] = j;
        depth_[other] = depth_[at] + 1;
        reached.push_back(other);
      }
    }
    return reached;
  }

  const System& system_;
  int n_;
  std::vector<std::vector<int>> joints_of_;
  std::vector<int> parent_, by_, depth_, closing_;
  std::vector<std::vector<int>> floating_;
};

}  // namespace

CheckTopology check_topology(const System& system) {
  const SpanningForest forest(system);
  CheckTopology out;
  std::vector<int> closing = forest.closing();
  std::sort(closing.begin(), closing.end());
  out.n_loops = static_cast<int>(closing.size());
  for (std::size_t i = 0; i < std::min(closing.size(), kMaxListedLoops); ++i) {
    CheckLoop& loop = out.loops.emplace_back();
    for (const int j : forest.loop(closing[i])) loop.joints.push_back(system.joints[j].name);
  }
  for (const auto& group : forest.floating()) {
    auto& names = out.floating.emplace_back();
    for (const int body : group) names.push_back(system.bodies[body].name);
  }
  return out;
}

}  // namespace pintle

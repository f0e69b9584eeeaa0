#include "bench/peer_tree.h"

namespace pintle::bench {

PeerTree peer_tree(const System& system) {
  PeerTree tree;
  std::vector<bool> reached(system.bodies.size(), false), used(system.joints.size(), false);
  std::vector<int> front{kGround};
  for (std::size_t i = 0; i < front.size(); ++i)
    for (int j = 0; j < system.n_joints(); ++j) {
      const Placement& at = system.joints[j].at;
      const int from = front[i];
      if (used[j] || system.joints[j].servo >= 0 || (at.a != from && at.b != from)) continue;
      const bool forward = at.a == from;
      const int body = forward ? at.b : at.a;
      if (body == kGround || reached[body]) continue;
      reached[body] = used[j] = true;
      tree.links.push_back({body, from, j, forward});
      front.push_back(body);
    }
  for (int j = 0; j < system.n_joints(); ++j)
    if (!used[j] && system.joints[j].servo < 0) tree.loops.push_back(j);
  return tree;
}

}  // namespace pintle::bench

// How programs with relative coordinates decompose a mechanism: a spanning tree of its joints, and the joints that close loops.
#pragma once

#include <vector>

#include "system/system.h"

namespace pintle::bench {

struct TreeLink {
  int body = 0, parent = kGround, joint = 0;
  bool forward = true;  // the parent is the joint's first body
};

struct PeerTree {
  std::vector<TreeLink> links;  // parents before their children
  std::vector<int> loops;       // joints that are not in the tree
};

/// The joints nearest to the ground come first. Servos are left out.
PeerTree peer_tree(const System& system);

}  // namespace pintle::bench

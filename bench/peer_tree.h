// How programs that count in relative coordinates take a mechanism apart: a spanning tree of its joints and what closes its loops.
#pragma once

#include <vector>

#include "system/system.h"

namespace pintle::bench {

struct TreeLink {
  int body = 0, parent = kGround, joint = 0;
  bool forward = true;  // the parent is the joint's first body
};

struct PeerTree {
  std::vector<TreeLink> links;  // parents before what they carry
  std::vector<int> loops;       // joints that are not in the tree
};

/// The joints nearest to the ground first. Servos are left out.
PeerTree peer_tree(const System& system);

}  // namespace pintle::bench

// The limit of a drive: a position beyond which its coordinate cannot go as long as all joints stay closed. theory/limits
#pragma once

#include <optional>
#include <vector>

#include "system/system.h"

namespace pintle {

struct DriveLimit {
  double value = 0;           // of the driven coordinate [rad or m]
  int ahead = 1;              // 1: the limit is the largest value, -1: the smallest
  Vecs q;                     // positions of the bodies there
  std::vector<int> in_line;   // pins in line that carry the drive's effort along that line, in order; empty if there are none
};

/// The value of a driven coordinate: a servo's, or the length of a joint [rad or m].
double drive_value(const JointData& drive, double gap, double t);

/// The limit between the position of `drive` (a joint of the system) and the one it should have at time t, for bodies near `q`.
/// Other drives stay where they are. Empty if all joints can be closed with the drive where it should be, or if they allow no motion.
std::optional<DriveLimit> find_drive_limit(const System& system, const Vecs& q, double t, int drive);

}  // namespace pintle

// The limit of a drive: a position beyond which its coordinate cannot go as long as all joints stay closed. theory/limits
#pragma once

#include <optional>
#include <vector>

#include "system/system.h"

namespace pintle {

struct DriveLimit {
  double value = 0;           // of the driven coordinate [rad or m]
  int ahead = 1;              // 1: it is the largest value, -1: the smallest
  Vecs q;                     // places of the bodies there
  std::vector<int> in_line;   // pins in one line along which they carry the drive's effort, in order; empty where there are none
};

/// What a driven coordinate is: a servo's, or the length of a joint [rad or m].
double drive_value(const JointData& drive, double gap, double t);

/// The limit that lies between where `drive` (a joint of the system) is and where it should be at time t, when the bodies are near `q`.
/// Other drives stay where they are. Nothing if all joints can be closed with the drive where it should be, or leave no motion.
std::optional<DriveLimit> find_drive_limit(const System& system, const Vecs& q, double t, int drive);

}  // namespace pintle

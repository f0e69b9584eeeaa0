// The battery as a table: the number of runs of each kind and tolerance that kept their promises.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/battery/measured_run.h"

namespace pintle::bench {

struct BatteryTally {
  int runs = 0, judged = 0, over = 0, too_little = 0, too_much = 0, missed = 0, chaotic = 0, failed = 0, hung = 0, refused = 0, other = 0;
  int joints = 0, honest_joints = 0;
  void add(const MeasuredRun& run);
  void add(const BatteryTally& other);
};

/// The fault of a run, in words; empty if there is none. `badness` ranks runs.
struct Fault {
  std::string what;
  double badness = 0;
};
Fault fault_of(const MeasuredRun& run);

/// Runs of one mechanism at every suitable tolerance: down to 1e-4 if bodies touch, else down to 1e-5, and 1e-6 for every fourth.
std::vector<MeasuredRun> measure_mechanism(const RandomMechanism& mechanism, const TrueMotion& truth, int number, const BatteryLimits& limits);

}  // namespace pintle::bench

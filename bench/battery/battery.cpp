#include "bench/battery/battery.h"

#include <fmt/format.h>

#include <algorithm>

namespace pintle::bench {

void BatteryTally::add(const MeasuredRun& run) {
  ++runs;
  if (run.ended == MeasuredRun::Ended::kRefused) return void(++refused);
  if (run.ended == MeasuredRun::Ended::kHung) return void(++hung);
  if (run.ended == MeasuredRun::Ended::kThrew || run.outcome == Outcome::kFailed) return void(++failed);
  if (run.outcome == Outcome::kToleranceNotMet) ++missed;
  else if (run.outcome == Outcome::kHorizon) ++chaotic;
  else if (run.outcome != Outcome::kCompleted) ++other;
  if (!run.judged) return;
  ++judged;
  over += run.broke_its_promise();
  too_little += run.states_too_little();
  too_much += run.states_too_much();
  joints += run.joints;
  honest_joints += run.honest_joints;
}

void BatteryTally::add(const BatteryTally& o) {
  for (int BatteryTally::*count : {&BatteryTally::runs, &BatteryTally::judged, &BatteryTally::over, &BatteryTally::too_little, &BatteryTally::too_much, &BatteryTally::missed, &BatteryTally::chaotic, &BatteryTally::failed,
                                   &BatteryTally::hung, &BatteryTally::refused, &BatteryTally::other, &BatteryTally::joints, &BatteryTally::honest_joints})
    this->*count += o.*count;
}

Fault fault_of(const MeasuredRun& run) {
  if (run.ended == MeasuredRun::Ended::kThrew) return {"threw", 1e7};
  if (run.ended == MeasuredRun::Ended::kHung) return {"over the time limit", 1e6};
  if (run.outcome == Outcome::kFailed) return {"failed", 1e5};
  if (run.broke_its_promise()) return {"over the tolerance", 1e3 * run.worst.error / run.tolerance};
  if (run.states_too_little()) return {"states too little", run.dishonesty};
  if (run.states_too_much()) return {"states too much", std::min(1.0, 1e-3 * run.dishonesty)};
  if (run.outcome == Outcome::kToleranceNotMet) return {"exit code 7", 10};
  if (run.outcome == Outcome::kEnergyOpen) return {"energy account open", 1e4};
  return {};
}

std::vector<MeasuredRun> measure_mechanism(const RandomMechanism& mechanism, const TrueMotion& truth, int number, const BatteryLimits& limits) {
  std::vector<MeasuredRun> runs;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    if (mechanism.kind->touches && tolerance < 0.99e-4) break;
    if (tolerance < 0.99e-5 && number % 4 != 0) break;
    runs.push_back(measured_run(mechanism, truth, tolerance, limits));
    if (runs.back().ended == MeasuredRun::Ended::kRefused || runs.back().ended == MeasuredRun::Ended::kHung) break;
  }
  return runs;
}

}  // namespace pintle::bench

#include "cli/exit_codes.h"

namespace pintle::cli {

ExitCode exit_code_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kCompleted:
      return kOk;
    case Outcome::kToleranceNotMet:
      return kToleranceMissed;
    case Outcome::kInterrupted:
      return kStoppedBySignal;
    case Outcome::kFailed:
      return kIntegrationFailed;
    case Outcome::kHorizon:
      return kPromisedUntilHorizon;
    case Outcome::kRunaway:
      return kRanAway;
    case Outcome::kEnergyOpen:
      return kEnergyOpen;
  }
  return kInternalError;
}

ExitCode exit_code_of(const std::vector<Outcome>& outcomes) {
  ExitCode code = kOk;
  for (const Outcome outcome : outcomes) {
    if (outcome == Outcome::kInterrupted) return kStoppedBySignal;
    if (outcome == Outcome::kFailed || code == kOk) code = exit_code_of(outcome);
  }
  return code;
}

}  // namespace pintle::cli

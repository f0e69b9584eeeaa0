// The program's exit codes. docs/reference/exit-codes.md explains each.
#pragma once

#include <vector>

#include "pintle/trajectory.h"

namespace pintle::cli {

enum ExitCode : int {
  kOk = 0,
  kInternalError = 1,
  kCommandLineError = 2,
  kModelError = 3,
  kAssemblyFailed = 4,
  kIntegrationFailed = 5,
  kFileError = 6,
  kToleranceMissed = 7,
  kCheckFailed = 8,
  kPromisedUntilHorizon = 9,
  kRanAway = 10,
  kEnergyOpen = 11,
  kStoppedBySignal = 130,
};

ExitCode exit_code_of(Outcome outcome);

/// For several runs: stopped or failed, else the code of the first run that did not complete.
ExitCode exit_code_of(const std::vector<Outcome>& outcomes);

/// The same for --help.
inline constexpr const char* kExitCodeHelp =
    "Exit codes:\n"
    "  0  all is well\n"
    "  1  internal error, please report it\n"
    "  2  the command line is wrong\n"
    "  3  the model file has errors\n"
    "  4  the mechanism cannot be assembled, or cannot start as the model asks\n"
    "  5  the integration failed; results up to there are kept\n"
    "  6  a file or folder cannot be read or written\n"
    "  7  finished, but some joint's force missed the tolerance; results are kept; stiffen: no stiffness was enough\n"
    "  8  pintle check: a formula disagrees with its differences, or energy is not kept\n"
    "  9  finished; the motion is chaotic, and forces are promised up to a time that the table states\n"
    "  10  the motion runs away, fed by a motor or force that the message names; results up to there are kept\n"
    "  11  the energy account does not close: the results are wrong; the message says from when on and why\n"
    "  130  stopped by Ctrl-C or a termination signal; results up to there are kept\n";

}  // namespace pintle::cli

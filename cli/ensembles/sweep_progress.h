// The progress of a sweep, on standard error.
#pragma once

#include <filesystem>
#include <string>

#include "cli/progress.h"
#include "pintle/sweep.h"

namespace pintle::cli {

class SweepProgressReport {
 public:
  explicit SweepProgressReport(ProgressStyle style) : style_(style) {}

  void show(const SweepProgress& progress);
  void clear() { line_.clear(); }
  /// The last JSON object.
  void finish(const SweepOutcome& outcome, const std::filesystem::path& file);

 private:
  ProgressStyle style_;
  StatusLine line_;
};

/// "1200 of 100000 samples   1 %   850 /s   116 s to go".
std::string progress_line(const SweepProgress& progress);
std::string progress_json(const SweepProgress& progress);

}  // namespace pintle::cli

// The progress of a run, on standard error: a line that overwrites itself, or one JSON object per line, or nothing.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/console.h"
#include "pintle/simulate.h"

namespace pintle::cli {

enum class ProgressStyle { kNone, kLine, kJson };

/// As --progress says; "auto": a line if somebody is watching.
ProgressStyle progress_style(bool quiet, std::string_view asked = "auto");

class ProgressReport {
 public:
  /// The notes on the model are shown above the line if a run takes long: what they warn of may be the reason.
  explicit ProgressReport(ProgressStyle style, std::vector<std::string> notes = {}) : style_(style), notes_(std::move(notes)) {}

  void show(const Progress& progress);
  /// Shows the progress of a run, and stops the run when the user interrupts it. The report must outlive the observer.
  Observer observer();
  /// Clears the line, so that other output may follow.
  void clear() { line_.clear(); }
  /// The last JSON object: the outcome of the run and the place of its results.
  void finish(const Trajectory& trajectory, const std::filesystem::path& folder);

 private:
  /// Model seconds per second in this pass; 0 while unknown.
  double speed(const Progress& progress);

  void show_notes();

  ProgressStyle style_;
  std::vector<std::string> notes_;  // still to be shown
  Progress pass_start_{0, 0, 0, 0};
  StatusLine line_;
};

/// "12.3 s", "4 min", "1.5 h".
std::string clock_text(double seconds);

/// The line without control characters: "0.312 s of 0.63 s   49 %   pass 2   1200 s/s   0.3 s to go".
std::string progress_line(const Progress& progress, double speed);

/// The JSON object without its line ending.
std::string progress_json(const Progress& progress, double speed);

}  // namespace pintle::cli

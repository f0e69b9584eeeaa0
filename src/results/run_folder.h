// The run folder's files; tests can replace the system calls.
#pragma once

#include "pintle/results.h"
#include "results/disk.h"

namespace pintle {

inline constexpr const char* kSeriesFile = "series.csv";
inline constexpr const char* kEventsFile = "events.csv";  // if joints have events
inline constexpr const char* kSummaryFile = "summary.json";

/// The copy of the model file, in its original format.
std::string model_file_of(const RunStamp& stamp);

/// Like write_run() in pintle/results.h, but with `calls`.
void write_run(const Trajectory& trajectory, const RunStamp& stamp, const std::filesystem::path& folder,
               Overwrite overwrite, const DiskCalls& calls);

}  // namespace pintle

// The run folder's files, with the system calls open to tests.
#pragma once

#include "pintle/results.h"
#include "results/disk.h"

namespace pintle {

inline constexpr const char* kSeriesFile = "series.csv";
inline constexpr const char* kEventsFile = "events.csv";  // where joints have any
inline constexpr const char* kSummaryFile = "summary.json";

/// The copy of the model file, in its own form.
std::string model_file_of(const RunStamp& stamp);

/// As write_run() in pintle/results.h, through `calls`.
void write_run(const Trajectory& trajectory, const RunStamp& stamp, const std::filesystem::path& folder,
               Overwrite overwrite, const DiskCalls& calls);

}  // namespace pintle

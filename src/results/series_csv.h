// series.csv: the columns of a trajectory, as RFC 4180 with two header rows, name and unit.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "pintle/results.h"

namespace pintle {

/// Hands the table to `append`, piece by piece. Numbers are the shortest that read back to the same bits.
void write_series(const Trajectory& trajectory, const std::function<void(std::string_view)>& append);

/// Fills columns (name and unit) and values from `text`. Throws FileError with line and column of `path`.
void read_series(std::string_view text, const std::filesystem::path& path, Trajectory& trajectory);

/// events.csv: what the laws of joints went through, by joint and in the order of time; a column for each number that one of them reports, empty where it is
/// another's. Two header rows, name and unit.
void write_events(const Trajectory& trajectory, const std::function<void(std::string_view)>& append);

}  // namespace pintle

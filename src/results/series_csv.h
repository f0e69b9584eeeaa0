// series.csv: the columns of a trajectory as RFC 4180, with two header rows for name and unit.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "pintle/results.h"

namespace pintle {

/// Passes the table to `append` piece by piece. Each number is the shortest text that reads back to the same bits.
void write_series(const Trajectory& trajectory, const std::function<void(std::string_view)>& append);

/// Fills columns (name and unit) and values from `text`. Throws FileError with line and column in `path`.
void read_series(std::string_view text, const std::filesystem::path& path, Trajectory& trajectory);

/// events.csv: the events of joint laws, by joint and in the order of time; with a column for each number that any law reports, empty where another law
/// reports it. Two header rows, name and unit.
void write_events(const Trajectory& trajectory, const std::function<void(std::string_view)>& append);

}  // namespace pintle

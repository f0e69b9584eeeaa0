// Input of the verbs that draw a run: the run folder, and the model that was run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/results.h"

namespace pintle::cli {

struct DrawnRun {
  RunRecord run;
  Model model;
};

/// `changes` are made to the model in addition to the run's own. Throws FileError, with the position, if the folder is damaged.
DrawnRun read_drawn_run(const std::string& folder, const std::vector<std::string>& changes = {});

/// The last component of a folder's path.
std::string folder_name(const std::string& folder);

/// "<run><ending>" in the current folder, unless the user chose a file.
std::filesystem::path picture_file(const std::string& chosen, const std::string& run, const std::string& ending);

/// Throws FileError if `path` exists and is not one of our own files, which have `mark` near the beginning; with an empty `mark` no existing file is accepted.
void check_replaceable(const std::filesystem::path& path, std::string_view mark, bool force);

}  // namespace pintle::cli

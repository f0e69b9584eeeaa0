// A run on disk and on the console: writing the run folder (series.csv, summary.json, the model), the summary table, and reading the folder back.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// A file that a model names, such as the columns of a table. A run folder holds it under the same name.
struct ModelFile {
  std::string name;    ///< as written in the model, relative to its folder
  std::string hash;    ///< "sha256:..."
  std::string text{};  ///< empty when a run is read back: read_model_file() returns it then
};

/// The origin of a run.
struct RunStamp {
  std::string model_name;
  std::string model_path;
  std::string input_hash;  ///< "sha256:..." of the model file's bytes
  std::string version;     ///< of the program that ran it
  std::string command_line;
  std::vector<std::string> overrides{};  ///< what the command line changed in the model, in the form parse_model() takes
  std::string model_text{};              ///< the text of the model file; empty: not known
  std::vector<ModelFile> model_files{};  ///< the files that the model names
};

struct RunRecord {
  RunStamp stamp;
  Trajectory trajectory;
};

/// A file or folder that cannot be read or written: which one, why, and what to try.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What write_run may replace. In either case it replaces only its own files: other files in the folder stay.
enum class Overwrite {
  kRunFolder,  ///< only an earlier run, or an empty folder
  kAnyFolder,  ///< any folder
};

/// Throws FileError if write_run() would refuse `folder`: to be called before a long run rather than after it.
void check_run_folder(const std::filesystem::path& folder, Overwrite overwrite = Overwrite::kRunFolder);

/// Writes the run folder. It is built under another name next to `folder`, synced and then renamed, so that `folder` is
/// at every moment either unchanged or complete. On failure throws FileError after removing what it has written.
void write_run(const Trajectory& trajectory, const RunStamp& stamp, const std::filesystem::path& folder,
               Overwrite overwrite = Overwrite::kRunFolder);

/// Reads a run folder back, without the text of the model. Throws FileError if it is damaged.
RunRecord read_run(const std::filesystem::path& folder);

/// The model file of a run, from its folder, or from its original place if the folder has none. Throws FileError if it
/// is gone or differs from what was run.
std::string read_model_text(const std::filesystem::path& folder, const RunStamp& stamp);

/// The text of a file that the model of a run names, from the run's folder. Throws FileError if it is gone or differs from what was run.
std::string read_model_file(const std::filesystem::path& folder, const ModelFile& file);

/// The text of summary.json: everything in the trajectory but the values.
std::string summary_json(const Trajectory& trajectory, const RunStamp& stamp);

/// The same for human readers: joints, springs, motors, energy account, counters. `colour` adds terminal escapes.
std::string summary_text(const Trajectory& trajectory, const RunStamp& stamp, bool colour = false);

/// "completed", "tolerance_not_met", "interrupted", "failed", "horizon", "runaway" or "energy_open".
std::string to_text(Outcome outcome);

}  // namespace pintle

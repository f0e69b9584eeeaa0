// Ensembles: one mechanism with many sets of values, in a grid or random. The peaks of every joint force go to one HDF5
// file, through a journal that survives a kill. docs/tutorials/sweep.md
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace pintle {

/// Those from kHorizon on are the outcomes of a run that have the same names. Written to files by number.
enum class SampleStatus : std::uint8_t { kCompleted, kToleranceNotMet, kFailed, kNotAssembled, kModelError, kHorizon, kRunaway, kEnergyOpen };

/// "completed", "tolerance_not_met", "failed", "not_assembled", "model_error", "horizon", "runaway" or "energy_open".
std::string to_text(SampleStatus status);

/// What to compute. Two requests that are equal give files that are equal to the last bit, on any number of threads and machines.
struct SweepRequest {
  std::string model_text, model_name;   ///< the model file's text and its name, for messages
  std::vector<std::string> overrides;   ///< as for parse_model
  std::vector<std::string> vary;        ///< "joint.A.stiffness=1e6..1e9 N/m:log:16" or "...=1e6,2e6 N/m"; the last one runs fastest
  bool zip = false;                     ///< the lists of `vary` run side by side instead of each against each
  std::uint64_t samples = 0;            ///< drawn from the model's [variation], at each point of the grid; 0: none
  std::uint64_t seed = 1;
  bool latin = false;                   ///< a Latin hypercube: every value's range evenly filled
  std::vector<std::string> series;      ///< columns to keep at all output times, named as in series.csv
  std::uint64_t check_every = 1;        ///< one sample in so many gets an error estimate and meets the tolerance by it; the others are integrated once, as the base needs it
  std::map<std::string, std::string> model_files{};  ///< the texts of the files that the model names, by name
};

struct SweepRun {
  std::filesystem::path out;  ///< the file; FILE.part beside it is the journal
  int threads = 0;            ///< 0: as many as there are cores
  bool force = false;         ///< replaces what is there, whatever it is
  std::string command;        ///< for the record; must not depend on how the work is spread
};

struct SweepProgress {
  std::uint64_t done = 0, total = 0;
  std::uint64_t resumed = 0;  ///< of those done: by earlier starts
  std::uint64_t troubled = 0; ///< of those done: not completed
  double wall_seconds = 0;
};

/// Called about ten times a second; return false to stop. The journal keeps what is done.
using SweepObserver = std::function<bool(const SweepProgress&)>;

/// What the file holds, series left out. Row-major.
struct SweepTable {
  std::string model_name;  ///< the file's
  std::string title;       ///< the model's own name, or the file's
  std::string command;
  std::string plan;        ///< its hash
  std::vector<std::string> paths, units;   ///< of the values
  std::vector<std::string> joints;
  std::vector<double> values;              ///< [samples x paths], SI
  std::vector<double> force, time, moment, error;  ///< [samples x joints]; NaN where there is none
  std::vector<std::uint8_t> status;        ///< SampleStatus
  std::vector<std::uint64_t> steps;
  std::vector<std::uint64_t> troubled;     ///< samples that are not completed, and why
  std::vector<std::string> messages;
  std::size_t n_samples() const { return status.size(); }
};

enum class SweepEnd { kFinished, kFinishedBefore, kInterrupted };

struct SweepOutcome {
  SweepEnd end = SweepEnd::kFinished;
  SweepProgress progress;
};

/// Computes the samples that FILE and its journal do not hold yet. Throws InputError for the plan or the model, FileError.
SweepOutcome sweep(const SweepRequest& request, const SweepRun& run, const SweepObserver& observer = {});

/// Reads a finished file. Throws FileError.
SweepTable read_sweep(const std::filesystem::path& file);

}  // namespace pintle

// Ensembles: one mechanism with many sets of values, on a grid or random. The peaks of every joint force are written to
// one HDF5 file, through a journal that survives a kill. docs/tutorials/sweep.md
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace pintle {

/// Those from kHorizon on are outcomes of a run with the same names. Written to files as numbers.
enum class SampleStatus : std::uint8_t { kCompleted, kToleranceNotMet, kFailed, kNotAssembled, kModelError, kHorizon, kRunaway, kEnergyOpen };

/// "completed", "tolerance_not_met", "failed", "not_assembled", "model_error", "horizon", "runaway" or "energy_open".
std::string to_text(SampleStatus status);

/// What to compute. Equal requests give files that are identical to the last bit, on any number of threads and machines.
struct SweepRequest {
  std::string model_text, model_name;   ///< the model file's text and its name, for messages
  std::vector<std::string> overrides;   ///< as for parse_model
  std::vector<std::string> vary;        ///< "joint.A.stiffness=1e6..1e9 N/m:log:16" or "...=1e6,2e6 N/m"; the last entry varies fastest
  bool zip = false;                     ///< the lists of `vary` advance together instead of being combined
  std::uint64_t samples = 0;            ///< drawn from the model's [variation], at each grid point; 0: none
  std::uint64_t seed = 1;
  bool latin = false;                   ///< a Latin hypercube: the range of every value is evenly filled
  std::vector<std::string> series;      ///< columns to keep at all output times, named as in series.csv
  std::uint64_t check_every = 1;        ///< one sample in this many gets an error estimate and is refined until it meets the tolerance; the others are integrated once, in the way that the base run needed
  std::map<std::string, std::string> model_files{};  ///< the texts of the files that the model names, by name
};

struct SweepRun {
  std::filesystem::path out;  ///< the result file; FILE.part next to it is the journal
  int threads = 0;            ///< 0: one per core
  bool force = false;         ///< replaces an existing file, whatever it contains
  std::string command;        ///< for the record; must not depend on how the work is distributed
};

struct SweepProgress {
  std::uint64_t done = 0, total = 0;
  std::uint64_t resumed = 0;  ///< those of `done` from earlier starts
  std::uint64_t troubled = 0; ///< those of `done` that did not complete
  double wall_seconds = 0;
};

/// Called about ten times a second; return false to stop. The journal keeps what has been computed.
using SweepObserver = std::function<bool(const SweepProgress&)>;

/// The contents of the file, without series. Row-major.
struct SweepTable {
  std::string model_name;  ///< the file's
  std::string title;       ///< the model's own name, or the file's
  std::string command;
  std::string plan;        ///< hash of the plan
  std::vector<std::string> paths, units;   ///< of the values
  std::vector<std::string> joints;
  std::vector<double> values;              ///< [samples x paths], SI
  std::vector<double> force, time, moment, error;  ///< [samples x joints]; NaN where there is no value
  std::vector<std::uint8_t> status;        ///< SampleStatus
  std::vector<std::uint64_t> steps;
  std::vector<std::uint64_t> troubled;     ///< samples that did not complete, and why
  std::vector<std::string> messages;
  std::size_t n_samples() const { return status.size(); }
};

enum class SweepEnd { kFinished, kFinishedBefore, kInterrupted };

struct SweepOutcome {
  SweepEnd end = SweepEnd::kFinished;
  SweepProgress progress;
};

/// Computes the samples that FILE and its journal do not hold yet. Throws InputError for errors in the plan or the model, and FileError.
SweepOutcome sweep(const SweepRequest& request, const SweepRun& run, const SweepObserver& observer = {});

/// Reads a finished file. Throws FileError.
SweepTable read_sweep(const std::filesystem::path& file);

}  // namespace pintle

// The file of a finished sweep: HDF5, written from the journal. docs/reference/sweep-file.md
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pintle/sweep.h"
#include "sweeps/plan.h"
#include "sweeps/storage/journal.h"

namespace pintle {

/// Whether this program was built with HDF5.
bool has_hdf5();
/// Advice if it was not.
inline constexpr const char* kNoHdf5 =
    "this pintle was built without HDF5, which sweep writes its results with.\n"
    "    try: install libhdf5-dev (tools/setup.sh does) and build again";

/// The provenance of the results. It does not depend on how the work was distributed.
struct SweepOrigin {
  std::map<std::string, std::string> model_files;  // the files that the model names, by name
  std::string model_text, model_name, title, command, plan, version;
  std::uint64_t seed = 0, check_every = 1;
  double tolerance = 0, output_step = 0;
  std::size_t n_times = 0;
  std::vector<std::string> joints, series, series_units;
};

/// Writes the file under a temporary name and renames it. The journal must have every sample.
void write_sweep_file(const std::filesystem::path& file, const SweepOrigin& origin, const SweepPlan& plan, const Journal& journal);

/// The plan's hash in a finished file; "" if the file is not a sweep file.
std::string plan_of_sweep_file(const std::filesystem::path& file);

}  // namespace pintle

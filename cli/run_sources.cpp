#include "cli/run_sources.h"

#include <fmt/format.h>

#include <algorithm>

#include "pintle/read_model.h"
#include "results/disk.h"
#include "results/run_folder.h"

namespace pintle::cli {
namespace fs = std::filesystem;
namespace {

FileText recorded_files(const fs::path& folder, const std::vector<ModelFile>& files) {
  return [folder, files](const std::string& name) {
    const auto it = std::find_if(files.begin(), files.end(), [&](const ModelFile& file) { return file.name == name; });
    if (it == files.end()) throw FileError(fmt::format("{}: the run did not read this file.\n    Run the model again.", (folder / name).string()));
    return read_model_file(folder, *it);
  };
}

}  // namespace

DrawnRun read_drawn_run(const std::string& folder, const std::vector<std::string>& changes) {
  DrawnRun drawn{read_run(folder), {}};
  RunStamp& stamp = drawn.run.stamp;
  stamp.model_text = read_model_text(folder, stamp);
  std::vector<std::string> overrides = stamp.overrides;
  overrides.insert(overrides.end(), changes.begin(), changes.end());
  drawn.model = parse_model(stamp.model_text, (fs::path(folder) / model_file_of(stamp)).string(), overrides, recorded_files(folder, stamp.model_files));
  return drawn;
}

std::string folder_name(const std::string& folder) {
  fs::path path = fs::absolute(folder).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  return path.filename().string();
}

fs::path picture_file(const std::string& chosen, const std::string& run, const std::string& ending) {
  return chosen.empty() ? fs::path(folder_name(run) + ending) : fs::path(chosen);
}

void check_replaceable(const fs::path& path, std::string_view mark, bool force) {
  constexpr std::size_t kHead = 4096;
  if (force || !fs::is_regular_file(path)) return;
  if (!mark.empty() && read_file(path, kHead).find(mark) != std::string::npos) return;
  throw FileError(fmt::format("{}: this file exists{}.\n    Choose another place with --out, or replace it with --force.", path.string(), mark.empty() ? "" : " and was not written by pintle"));
}

}  // namespace pintle::cli

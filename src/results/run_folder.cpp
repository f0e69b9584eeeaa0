#include "results/run_folder.h"

#include <fmt/format.h>

#include <system_error>

#include "results/series_csv.h"
#include "results/sha256.h"
#include "results/summary_json.h"

namespace pintle {
namespace fs = std::filesystem;
namespace {

constexpr const char *kTomlCopy = "model-as-run.toml", *kJsonCopy = "model-as-run.json";

bool holds_a_run(const fs::path& folder) {
  try {
    return is_summary(read_file(folder / kSummaryFile));
  } catch (const FileError&) {
    return false;
  }
}

/// The summary states what each column is about; names and units must agree with those in the series.
void check_columns(const std::vector<Column>& promised, const std::vector<Column>& found, const fs::path& series) {
  if (promised.size() != found.size())
    throw FileError(fmt::format("{}:1:1: found {} columns: {} lists {}.", series.string(), found.size(), kSummaryFile,
                                promised.size()));
  for (std::size_t i = 0; i < found.size(); ++i)
    if (promised[i].name != found[i].name || promised[i].unit != found[i].unit)
      throw FileError(fmt::format("{}:1: found column {} \"{}\" [{}]: {} calls it \"{}\" [{}].", series.string(), i + 1,
                                  found[i].name, found[i].unit, kSummaryFile, promised[i].name, promised[i].unit));
}

void write_model_file(const fs::path& path, const std::string& text, const DiskCalls& calls) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) throw file_error(path.parent_path(), "create", error.value());
  NewFile file(path, calls);
  file.append(text);
  file.close();
}

}  // namespace

void check_run_folder(const fs::path& folder, Overwrite overwrite) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw FileError(fmt::format("{}: this is a file, but a run needs a folder.\n    Choose another place with --out.",
                                folder.string()));
  const bool empty = fs::is_empty(folder, error);
  if (error) throw file_error(folder, "look into", error.value());
  if (overwrite == Overwrite::kAnyFolder || empty || holds_a_run(folder)) return;
  throw FileError(
      fmt::format("{}: this folder exists and is not an earlier run (it has no {} written by pintle).\n    Choose another place "
                  "with --out, or add the run to its files with --force.",
                  folder.string(), kSummaryFile));
}

void write_run(const Trajectory& trajectory, const RunStamp& stamp, const fs::path& folder, Overwrite overwrite,
               const DiskCalls& calls) {
  check_run_folder(folder, overwrite);
  NewFolder fresh(folder, calls);
  NewFile series(fresh.path() / kSeriesFile, calls);
  write_series(trajectory, [&series](std::string_view text) { series.append(text); });
  series.close();
  if (!trajectory.events.empty()) {
    NewFile events(fresh.path() / kEventsFile, calls);
    write_events(trajectory, [&events](std::string_view text) { events.append(text); });
    events.close();
  }
  NewFile summary(fresh.path() / kSummaryFile, calls);
  summary.append(summary_json(trajectory, stamp));
  summary.close();
  if (!stamp.model_text.empty()) {
    NewFile model(fresh.path() / model_file_of(stamp), calls);
    model.append(stamp.model_text);
    model.close();
  }
  for (const ModelFile& file : stamp.model_files) write_model_file(fresh.path() / file.name, file.text, calls);
  // Files that only the earlier run had must not appear to belong to this one.
  fresh.publish(holds_a_run(folder) ? std::vector<std::string>{kEventsFile, kTomlCopy, kJsonCopy} : std::vector<std::string>{});
}

void write_run(const Trajectory& trajectory, const RunStamp& stamp, const fs::path& folder, Overwrite overwrite) {
  write_run(trajectory, stamp, folder, overwrite, DiskCalls());
}

std::string model_file_of(const RunStamp& stamp) {
  return stamp.model_path.ends_with(".json") ? kJsonCopy : kTomlCopy;
}

std::string read_model_text(const fs::path& folder, const RunStamp& stamp) {
  const fs::path copy = folder / model_file_of(stamp), original = stamp.model_path;
  const bool copied = fs::exists(copy);
  if (!copied && !fs::exists(original))
    throw FileError(fmt::format("{}: the run has no copy of its model, and {} does not exist either.\n    Run the model again; for a model made in a program, call report_html with that model.", copy.string(),
                                stamp.model_path.empty() ? "the model file" : stamp.model_path));
  const std::string text = read_file(copied ? copy : original);
  if ("sha256:" + sha256(text) != stamp.input_hash)
    throw FileError(fmt::format("{}: this is not the model that was run: {} has a different hash.\n    Run the model again.", (copied ? copy : original).string(),
                                kSummaryFile));
  return text;
}

std::string read_model_file(const fs::path& folder, const ModelFile& file) {
  const fs::path path = folder / file.name;
  if (!fs::exists(path)) throw FileError(fmt::format("{}: the run has lost this file, which its model names.\n    Run the model again.", path.string()));
  std::string text = read_file(path);
  if ("sha256:" + sha256(text) != file.hash) throw FileError(fmt::format("{}: this is not the file that was used: {} has a different hash.\n    Run the model again.", path.string(), kSummaryFile));
  return text;
}

RunRecord read_run(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw FileError(fmt::format("{}: there is no such run folder.\n    Make one with pintle run.", folder.string()));
  if (!fs::exists(folder / kSummaryFile))
    throw FileError(fmt::format("{}: this is not a run folder: it has no {}.\n    Make one with pintle run.", folder.string(), kSummaryFile));
  Summary summary = parse_summary(read_file(folder / kSummaryFile), folder / kSummaryFile);
  RunRecord run = std::move(summary.run);
  std::vector<Column> promised = std::move(run.trajectory.columns);
  const fs::path series = folder / kSeriesFile;
  read_series(read_file(series), series, run.trajectory);
  check_columns(promised, run.trajectory.columns, series);
  run.trajectory.columns = std::move(promised);
  if (run.trajectory.n_rows() != summary.n_rows)
    throw FileError(fmt::format("{}: found {} rows: {} promises {}.", series.string(), run.trajectory.n_rows(),
                                kSummaryFile, summary.n_rows));
  return run;
}

}  // namespace pintle

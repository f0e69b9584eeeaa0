#include "sweeps/storage/sweep_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <limits>

#ifdef PINTLE_HDF5
#include "sweeps/storage/hdf5_objects.h"
#endif

namespace pintle {

std::string to_text(SampleStatus status) {
  constexpr const char* kTexts[] = {"completed", "tolerance_not_met", "failed", "not_assembled", "model_error", "horizon", "runaway", "energy_open"};
  return kTexts[static_cast<int>(status)];
}

#ifndef PINTLE_HDF5

bool has_hdf5() { return false; }
void write_sweep_file(const std::filesystem::path& file, const SweepOrigin&, const SweepPlan&, const Journal&) { throw FileError(file.string() + ": " + kNoHdf5); }
std::string plan_of_sweep_file(const std::filesystem::path&) { return {}; }
SweepTable read_sweep(const std::filesystem::path& file) { throw FileError(file.string() + ": " + kNoHdf5); }

#else

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRowsAtOnce = 1024;
constexpr const char* kFormat = "pintle sweep 1";
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

void write_origin(hid_t file, const SweepOrigin& origin) {
  const Hdf5 settings = make_group(file, "settings");
  write_attribute(settings, "format", kFormat);
  write_attribute(settings, "version", origin.version);
  write_attribute(settings, "command", origin.command);
  write_attribute(settings, "plan", origin.plan);
  write_attribute(settings, "seed", origin.seed);
  write_attribute(settings, "check_every", origin.check_every);
  write_attribute(settings, "tolerance", origin.tolerance);
  write_texts(file, "model", {origin.model_text});
  const Hdf5 model(H5Dopen2(file, "model", H5P_DEFAULT), H5Dclose, "model");
  write_attribute(model, "name", origin.model_name);
  write_attribute(model, "title", origin.title);
  if (origin.model_files.empty()) return;
  std::vector<std::string> names, texts;
  for (const auto& [name, text] : origin.model_files) {
    names.push_back(name);
    texts.push_back(text);
  }
  const Hdf5 files = make_group(file, "model_files");
  write_texts(files, "names", names);
  write_texts(files, "texts", texts);
}

// The tables of the file, with a block of rows of each waiting to be written.
class Tables {
 public:
  Tables(hid_t file, const SweepOrigin& origin, const SweepPlan& plan)
      : n_joints_(origin.joints.size()), n_times_(origin.n_times), samples_(make_group(file, "samples")), peaks_(make_group(file, "peaks")),
        values_(samples_, "values", H5T_NATIVE_DOUBLE, plan.paths().size()), force_(peaks_, "force", H5T_NATIVE_DOUBLE, n_joints_),
        time_(peaks_, "time", H5T_NATIVE_DOUBLE, n_joints_), moment_(peaks_, "moment", H5T_NATIVE_DOUBLE, n_joints_),
        error_(peaks_, "error", H5T_NATIVE_DOUBLE, n_joints_), status_(file, "status", H5T_NATIVE_UINT8, 0), steps_(file, "steps", H5T_NATIVE_UINT64, 0) {
    write_texts(samples_, "paths", plan.paths());
    write_texts(samples_, "units", plan.units());
    write_texts(peaks_, "joints", origin.joints);
    force_.attribute("unit", "N");
    time_.attribute("unit", "s");
    moment_.attribute("unit", "N*m");
    error_.attribute("unit", "N, of a couple N*m");
    status_.attribute("meaning", "0 completed, 1 tolerance_not_met, 2 failed, 3 not_assembled, 4 model_error");
    if (origin.series.empty()) return;
    const Hdf5 group = make_group(file, "series");
    write_attribute(group, "output_step", origin.output_step);
    for (std::size_t k = 0; k < origin.series.size(); ++k) {
      series_.emplace_back(group, origin.series[k], H5T_NATIVE_DOUBLE, n_times_);
      series_.back().attribute("unit", origin.series_units[k]);
    }
    series_rows_.resize(series_.size());
  }

  void add(std::uint64_t sample, const std::vector<double>& values, SampleResult result) {
    value_rows_.insert(value_rows_.end(), values.begin(), values.end());
    result.joints.resize(n_joints_, {kNothing, kNothing, kNothing, kNothing});
    for (const JointPeak& joint : result.joints) {
      force_rows_.push_back(joint.force);
      time_rows_.push_back(joint.time);
      moment_rows_.push_back(joint.moment);
      error_rows_.push_back(joint.error);
    }
    result.series.resize(series_.size() * n_times_, kNothing);
    for (std::size_t k = 0; k < series_.size(); ++k)
      series_rows_[k].insert(series_rows_[k].end(), &result.series[k * n_times_], &result.series[k * n_times_] + n_times_);
    status_rows_.push_back(static_cast<std::uint8_t>(result.status));
    step_rows_.push_back(result.steps);
    if (result.status != SampleStatus::kCompleted) {
      troubled_.push_back(sample);
      messages_.push_back(result.message);
    }
    if (status_rows_.size() >= (series_.empty() ? kRowsAtOnce : kRowsAtOnce / 16)) write_rows();
  }

  void finish(hid_t file) {
    write_rows();
    const Hdf5 group = make_group(file, "troubled");
    Hdf5Table samples(group, "sample", H5T_NATIVE_UINT64, 0);
    samples.append(troubled_.data(), troubled_.size());
    write_texts(group, "message", messages_);
  }

 private:
  void write_rows() {
    const std::uint64_t n = status_rows_.size();
    if (n == 0) return;
    for (auto [table, rows] : {std::pair(&values_, &value_rows_), {&force_, &force_rows_}, {&time_, &time_rows_}, {&moment_, &moment_rows_}, {&error_, &error_rows_}}) {
      table->append(rows->data(), n);
      rows->clear();
    }
    for (std::size_t k = 0; k < series_.size(); ++k) {
      series_[k].append(series_rows_[k].data(), n);
      series_rows_[k].clear();
    }
    status_.append(status_rows_.data(), n);
    steps_.append(step_rows_.data(), n);
    status_rows_.clear();
    step_rows_.clear();
  }

  std::size_t n_joints_, n_times_;
  Hdf5 samples_, peaks_;
  Hdf5Table values_, force_, time_, moment_, error_, status_, steps_;
  std::vector<Hdf5Table> series_;
  std::vector<double> value_rows_, force_rows_, time_rows_, moment_rows_, error_rows_;
  std::vector<std::vector<double>> series_rows_;
  std::vector<std::uint8_t> status_rows_;
  std::vector<std::uint64_t> step_rows_, troubled_;
  std::vector<std::string> messages_;
};

void write_tables(const fs::path& path, const SweepOrigin& origin, const SweepPlan& plan, const Journal& journal) {
  const Hdf5 properties(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "file");
  demand(H5Pset_obj_track_times(properties, false), "file");
  const Hdf5 file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, properties, H5P_DEFAULT), H5Fclose, "to create " + path.string());
  write_origin(file, origin);
  Tables tables(file, origin, plan);
  for (std::uint64_t i = 0; i < plan.size(); ++i) tables.add(i, plan.values(i), journal.read(i));
  tables.finish(file);
  demand(H5Fflush(file, H5F_SCOPE_GLOBAL), "to write " + path.string());
}

void sync_path(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw file_error(path, "write", errno);
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

bool has_hdf5() { return true; }

void write_sweep_file(const fs::path& file, const SweepOrigin& origin, const SweepPlan& plan, const Journal& journal) {
  silence_hdf5();
  const fs::path fresh = file.string() + ".new", folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  errno = 0;
  try {
    write_tables(fresh, origin, plan, journal);
    sync_path(fresh);
    if (std::rename(fresh.c_str(), file.c_str()) != 0) throw file_error(file, "replace", errno);
    sync_path(folder);
  } catch (...) {
    const bool full = errno == ENOSPC || errno == EDQUOT;
    ::unlink(fresh.c_str());
    if (full) throw file_error(file, "write", ENOSPC);
    throw;
  }
}

std::string plan_of_sweep_file(const fs::path& file) {
  silence_hdf5();
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) return {};
  const Hdf5 opened(id, H5Fclose, "");
  if (H5Lexists(opened, "settings", H5P_DEFAULT) <= 0) return {};
  const Hdf5 settings(H5Gopen2(opened, "settings", H5P_DEFAULT), H5Gclose, "settings");
  return read_text_attribute(settings, "format") == kFormat ? read_text_attribute(settings, "plan") : std::string();
}

SweepTable read_sweep(const fs::path& file) {
  check_readable(file);
  if (plan_of_sweep_file(file).empty()) throw FileError(file.string() + ": this is not the file of a sweep.");
  const Hdf5 opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, file.string());
  const auto group = [&](const char* name) { return Hdf5(H5Gopen2(opened, name, H5P_DEFAULT), H5Gclose, name); };
  const Hdf5 settings = group("settings"), samples = group("samples"), peaks = group("peaks"), troubled = group("troubled");
  const Hdf5 model(H5Dopen2(opened, "model", H5P_DEFAULT), H5Dclose, "model");
  SweepTable out;
  out.model_name = read_text_attribute(model, "name");
  out.title = read_text_attribute(model, "title");
  out.command = read_text_attribute(settings, "command");
  out.plan = read_text_attribute(settings, "plan");
  out.paths = read_texts(samples, "paths");
  out.units = read_texts(samples, "units");
  out.joints = read_texts(peaks, "joints");
  out.values = read_table<double>(samples, "values", H5T_NATIVE_DOUBLE);
  out.force = read_table<double>(peaks, "force", H5T_NATIVE_DOUBLE);
  out.time = read_table<double>(peaks, "time", H5T_NATIVE_DOUBLE);
  out.moment = read_table<double>(peaks, "moment", H5T_NATIVE_DOUBLE);
  out.error = read_table<double>(peaks, "error", H5T_NATIVE_DOUBLE);
  out.status = read_table<std::uint8_t>(opened, "status", H5T_NATIVE_UINT8);
  out.steps = read_table<std::uint64_t>(opened, "steps", H5T_NATIVE_UINT64);
  out.troubled = read_table<std::uint64_t>(troubled, "sample", H5T_NATIVE_UINT64);
  out.messages = read_texts(troubled, "message");
  return out;
}

#endif

}  // namespace pintle

#include "cli/ensembles/sweep_progress.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace pintle::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Samples per second since this start; 0 while unknown.
double rate(const SweepProgress& progress) {
  return progress.wall_seconds > 0 ? static_cast<double>(progress.done - progress.resumed) / progress.wall_seconds : 0;
}

double to_go(const SweepProgress& progress) { return static_cast<double>(progress.total - progress.done) / rate(progress); }

double fraction(const SweepProgress& progress) {
  return progress.total > 0 ? static_cast<double>(progress.done) / static_cast<double>(progress.total) : 1;
}

std::string to_text(SweepEnd end) {
  return end == SweepEnd::kFinished ? "finished" : end == SweepEnd::kFinishedBefore ? "finished_before" : "interrupted";
}

}  // namespace

std::string progress_line(const SweepProgress& progress) {
  std::string line = fmt::format("{} of {} samples  {:3.0f} %", progress.done, progress.total, 100 * fraction(progress));
  if (progress.troubled > 0) line += fmt::format("   {} not completed", progress.troubled);
  if (rate(progress) > 0) line += fmt::format("   {:.3g} /s   {} to go", rate(progress), clock_text(to_go(progress)));
  return line;
}

std::string progress_json(const SweepProgress& progress) {
  Json json = {{"event", "progress"},           {"samples", progress.done},         {"total", progress.total},
               {"resumed", progress.resumed},   {"troubled", progress.troubled},    {"fraction", fraction(progress)},
               {"wall_seconds", progress.wall_seconds}};
  json["samples_per_second"] = rate(progress) > 0 ? Json(rate(progress)) : Json();
  json["seconds_to_go"] = rate(progress) > 0 ? Json(to_go(progress)) : Json();
  return json.dump();
}

void SweepProgressReport::show(const SweepProgress& progress) {
  if (style_ == ProgressStyle::kNone) return;
  if (style_ == ProgressStyle::kJson) return print_error(progress_json(progress) + "\n");
  line_.show(progress_line(progress));
}

void SweepProgressReport::finish(const SweepOutcome& outcome, const std::filesystem::path& file) {
  clear();
  if (style_ != ProgressStyle::kJson) return;
  const Json json = {{"event", "finished"}, {"outcome", to_text(outcome.end)}, {"samples", outcome.progress.done}, {"total", outcome.progress.total},
                     {"troubled", outcome.progress.troubled}, {"wall_seconds", outcome.progress.wall_seconds}, {"file", file.string()}};
  print_error(json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace pintle::cli

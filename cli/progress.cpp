#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/interrupt.h"
#include "pintle/results.h"

namespace pintle::cli {
namespace {

constexpr double kLongRun = 2;  // [s] after which the notes on the model are shown during the run instead of only with its results

using Json = nlohmann::ordered_json;

double fraction(const Progress& progress) {
  return progress.duration > 0 ? std::clamp(progress.t / progress.duration, 0.0, 1.0) : 0.0;
}

/// Seconds until this pass is finished, at this speed.
double to_go(const Progress& progress, double speed) {
  return std::max(0.0, progress.duration - progress.t) / speed;
}

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

ProgressStyle progress_style(bool quiet, std::string_view asked) {
  if (asked == "json") return ProgressStyle::kJson;
  return asked == "auto" && !quiet && is_terminal(STDERR_FILENO) ? ProgressStyle::kLine : ProgressStyle::kNone;
}

double ProgressReport::speed(const Progress& progress) {
  if (progress.pass != pass_start_.pass) pass_start_ = progress;
  const double seconds = progress.wall_seconds - pass_start_.wall_seconds;
  return seconds > 0 ? (progress.t - pass_start_.t) / seconds : 0;
}

void ProgressReport::show(const Progress& progress) {
  if (style_ == ProgressStyle::kNone) return;
  const double now = speed(progress);
  if (style_ == ProgressStyle::kJson) return print_error(progress_json(progress, now) + "\n");
  if (progress.wall_seconds > kLongRun) show_notes();
  line_.show(progress_line(progress, now));
}

void ProgressReport::show_notes() {
  if (!notes_.empty()) line_.clear();
  for (const std::string& note : notes_) print_error("note: " + note + "\n");
  notes_.clear();
}

Observer ProgressReport::observer() {
  return [this](const Progress& progress) {
    show(progress);
    return !interrupted();
  };
}

void ProgressReport::finish(const Trajectory& trajectory, const std::filesystem::path& folder) {
  clear();
  if (style_ != ProgressStyle::kJson) return;
  print_error(dump({{"event", "finished"},
                    {"outcome", to_text(trajectory.outcome)},
                    {"t", trajectory.t_end},
                    {"wall_seconds", trajectory.wall_seconds},
                    {"folder", folder.string()}}) +
              "\n");
}

std::string clock_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.1f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string progress_line(const Progress& progress, double speed) {
  if (progress.pass == 0) return "assembling";
  std::string line = fmt::format("{:.4g} s of {:.4g} s  {:3.0f} %   pass {}", progress.t, progress.duration,
                                 100 * fraction(progress), progress.pass);
  if (speed > 0) line += fmt::format("   {:.3g} s/s   {} to go", speed, clock_text(to_go(progress, speed)));
  return line;
}

std::string progress_json(const Progress& progress, double speed) {
  Json json = {{"event", "progress"},           {"t", progress.t},
               {"duration", progress.duration}, {"fraction", fraction(progress)},
               {"pass", progress.pass},         {"wall_seconds", progress.wall_seconds}};
  json["speed"] = speed > 0 ? Json(speed) : Json();
  json["seconds_to_go"] = speed > 0 ? Json(to_go(progress, speed)) : Json();
  return dump(json);
}

}  // namespace pintle::cli

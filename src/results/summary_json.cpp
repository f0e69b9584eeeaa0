#include "results/summary_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "results/bearing_text.h"
#include "results/event_kinds.h"

namespace pintle {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kMarker = "pintle_run";  // its value is the version of the format
constexpr int kRunFormat = 1;

constexpr std::array<std::pair<Outcome, const char*>, 7> kOutcomes{{
    {Outcome::kCompleted, "completed"},
    {Outcome::kToleranceNotMet, "tolerance_not_met"},
    {Outcome::kInterrupted, "interrupted"},
    {Outcome::kFailed, "failed"},
    {Outcome::kHorizon, "horizon"},
    {Outcome::kRunaway, "runaway"},
    {Outcome::kEnergyOpen, "energy_open"},
}};

// One function per structure serves both directions: `visit(key, member)` stores into JSON or loads from it.

template <class Load, class Visit>
void for_each_entry(Load& load, const Visit& visit) requires requires {
  load.peak_moment;
}
{
  visit("name", load.name);
  visit("type", load.type);
  visit("first_body", load.first_body);
  visit("second_body", load.second_body);
  visit("peak", load.peak);
  visit("peak_time", load.peak_time);
  visit("rms", load.rms);
  visit("mean", load.mean);
  visit("has_moment", load.has_moment);
  visit("peak_moment", load.peak_moment);
  visit("rms_moment", load.rms_moment);
  visit("mean_moment", load.mean_moment);
  visit("heat", load.heat);
  visit("error_estimate", load.error_estimate);
  visit("moment_error_estimate", load.moment_error_estimate);
  visit("relative_error_estimate", load.relative_error_estimate);
  visit("horizon", load.horizon);
  visit("peak_after", load.peak_after);
  visit("rms_after", load.rms_after);
  visit("mean_after", load.mean_after);
  visit("peak_scatter", load.peak_scatter);
  visit("rms_scatter", load.rms_scatter);
  visit("mean_scatter", load.mean_scatter);
  visit("unique", load.unique);
}

template <class Motor, class Visit>
void for_each_entry(Motor& motor, const Visit& visit) requires requires {
  motor.peak_effort;
}
{
  visit("name", motor.name);
  visit("joint", motor.joint);
  visit("unit", motor.unit);
  visit("peak_effort", motor.peak_effort);
  visit("rms_effort", motor.rms_effort);
  visit("mean_effort", motor.mean_effort);
  visit("peak_power", motor.peak_power);
  visit("mean_power", motor.mean_power);
  visit("work", motor.work);
  visit("effort_error", motor.effort_error);
}

template <class Pin, class Visit>
void for_each_entry(Pin& pin, const Visit& visit) requires requires {
  pin.equivalent_load;
}
{
  visit("joint", pin.joint);
  visit("path", pin.path);
  visit("swing", pin.swing);
  visit("mean_speed", pin.mean_speed);
  visit("peak_speed", pin.peak_speed);
  visit("mean_force", pin.mean_force);
  visit("peak_force", pin.peak_force);
  visit("force_error", pin.force_error);
  visit("equivalent_load", pin.equivalent_load);
  visit("equivalent_load_error", pin.equivalent_load_error);
  visit("life", pin.life);
  visit("life_hours", pin.life_hours);
  visit("life_error", pin.life_error);
  visit("static_safety", pin.static_safety);
  visit("fatigue_ratio", pin.fatigue_ratio);
  visit("mean_pressure", pin.mean_pressure);
  visit("peak_pressure", pin.peak_pressure);
  visit("mean_sliding", pin.mean_sliding);
  visit("peak_sliding", pin.peak_sliding);
  visit("mean_pv", pin.mean_pv);
  visit("peak_pv", pin.peak_pv);
  visit("bush_depth", pin.bush_depth);
  visit("bush_depth_angle", pin.bush_depth_angle);
  visit("wants", pin.wants);
  visit("remarks", pin.remarks);
}

template <class Wear, class Visit>
void for_each_entry(Wear& wear, const Visit& visit) requires requires {
  wear.bush;
}
{
  visit("joint", wear.joint);
  visit("bush", wear.bush);
  visit("pin", wear.pin);
}

template <class Duty, class Visit>
void for_each_entry(Duty& duty, const Visit& visit) requires requires {
  duty.load_10_3;
}
{
  visit("joint", duty.joint);
  visit("path", duty.path);
  visit("swing", duty.swing);
  visit("peak_rate", duty.peak_rate);
  visit("load", duty.load);
  visit("load_3", duty.load_3);
  visit("load_10_3", duty.load_10_3);
  visit("peak_power", duty.peak_power);
}

template <class Energy, class Visit>
void for_each_entry(Energy& energy, const Visit& visit) requires requires {
  energy.dissipated;
}
{
  visit("kinetic_start", energy.kinetic_start);
  visit("kinetic_end", energy.kinetic_end);
  visit("kinetic_peak", energy.kinetic_peak);
  visit("potential_start", energy.potential_start);
  visit("potential_end", energy.potential_end);
  visit("dissipated", energy.dissipated);
  visit("supplied", energy.supplied);
  visit("drift", energy.drift);
}

template <class Rates, class Visit>
void for_each_entry(Rates& growth, const Visit& visit) requires requires {
  growth.rate_error;
}
{
  visit("rate", growth.rate);
  visit("rate_error", growth.rate_error);
  visit("horizon", growth.horizon);
}

template <class Counts, class Visit>
void for_each_entry(Counts& counts, const Visit& visit) requires requires {
  counts.newton_iterations;
}
{
  visit("steps", counts.steps);
  visit("rejected", counts.rejected);
  visit("newton_iterations", counts.newton_iterations);
  visit("newton_failures", counts.newton_failures);
  visit("evaluations", counts.evaluations);
  visit("factorizations", counts.factorizations);
  visit("passes", counts.passes);
  visit("events", counts.events);
}

template <class Kind, class Visit>
void for_each_entry(Kind& kind, const Visit& visit) requires requires {
  kind.fastest_approach;
}
{
  visit("joint", kind.joint);
  visit("event", kind.what);
  visit("count", kind.count);
  visit("first", kind.first);
  visit("last", kind.last);
  visit("fastest_approach", kind.fastest_approach);
  visit("approach_unit", kind.approach_unit);
  visit("most_heat", kind.most_heat);
}

template <class Named, class Visit>
void for_each_entry(Named& column, const Visit& visit) requires requires {
  column.about;
}
{
  visit("name", column.name);
  visit("unit", column.unit);
  visit("about", column.about);
}

template <class File, class Visit>
void for_each_entry(File& file, const Visit& visit) requires requires {
  file.hash;
}
{
  visit("name", file.name);
  visit("hash", file.hash);
}

template <class Stamp, class Visit>
void for_each_entry(Stamp& stamp, const Visit& visit) requires requires {
  stamp.model_path;
}
{
  visit("version", stamp.version);
  visit("model", stamp.model_name);
  visit("model_path", stamp.model_path);
  visit("input_hash", stamp.input_hash);
  visit("command_line", stamp.command_line);
}

template <class T>
Json to_json(const T& structure) {
  Json json = Json::object();
  for_each_entry(structure, [&json](const char* key, const auto& member) { json[key] = member; });
  return json;
}

template <class T>
Json to_json(const std::vector<T>& list) {
  Json json = Json::array();
  for (const T& entry : list) json.push_back(to_json(entry));
  return json;
}

void load(const Json& json, double& value) {
  value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();  // JSON has no NaN, infinity
}

template <class T>
void load(const Json& json, T& value) {
  json.get_to(value);
}

// Runs of version 0.1 from before ideal joints lack "unique", and older ones the error of couples; those of 0.2 lack events, horizons, heat and wear.
bool is_newer(std::string_view key) {
  constexpr std::array kNewer{"unique", "heat", "moment_error_estimate", "events", "horizon", "peak_after", "rms_after", "mean_after", "peak_scatter", "rms_scatter", "mean_scatter", "bush_depth", "bush_depth_angle", "effort_error"};
  return std::any_of(kNewer.begin(), kNewer.end(), [key](const char* newer) { return key == newer; });
}

template <class T>
void from_json(const Json& json, T& structure) {
  for_each_entry(structure, [&json](const char* key, auto& member) {
    if (!is_newer(key) || json.contains(key)) load(json.at(key), member);
  });
}

template <class T>
void from_json(const Json& json, std::vector<T>& list) {
  for (const Json& entry : json) from_json(entry, list.emplace_back());
}

Json units() {
  return {{"force", "N"}, {"moment", "N*m"}, {"time", "s"}, {"energy", "J"}, {"power", "W"}};
}

Outcome outcome_from(const std::string& word) {
  for (const auto& [outcome, text] : kOutcomes)
    if (word == text) return outcome;
  throw std::invalid_argument(fmt::format("unknown outcome \"{}\"", word));
}

Summary summary_from(const Json& json) {
  if (const int format = json.at(kMarker).get<int>(); format != kRunFormat)
    throw std::invalid_argument(
        fmt::format("run format {} is not known to this version, which reads {}", format, kRunFormat));
  Summary summary;
  Trajectory& trajectory = summary.run.trajectory;
  from_json(json, summary.run.stamp);
  if (json.contains("overrides")) load(json.at("overrides"), summary.run.stamp.overrides);  // absent in runs of version 0.1
  if (json.contains("model_files")) from_json(json.at("model_files"), summary.run.stamp.model_files);
  trajectory.outcome = outcome_from(json.at("outcome").get<std::string>());
  load(json.at("message"), trajectory.message);
  load(json.at("notes"), trajectory.notes);
  load(json.at("method"), trajectory.method);
  load(json.at("tolerance"), trajectory.tolerance);
  if ((trajectory.of_motion = json.contains("motion_error"))) load(json.at("motion_error"), trajectory.motion_error);
  if (json.contains("growth")) from_json(json.at("growth"), trajectory.growth);
  load(json.at("t_end"), trajectory.t_end);
  load(json.at("wall_seconds"), trajectory.wall_seconds);
  load(json.at("rows"), summary.n_rows);
  from_json(json.at("joints"), trajectory.joints);
  from_json(json.at("springs"), trajectory.springs);
  from_json(json.at("motors"), trajectory.motors);
  if (json.contains("bearings")) from_json(json.at("bearings"), trajectory.bearings);  // absent in runs of version 0.2
  if (json.contains("events")) from_json(json.at("events"), trajectory.event_kinds);
  if (json.contains("wear")) from_json(json.at("wear"), trajectory.wear);
  if (json.contains("duty")) from_json(json.at("duty"), trajectory.duty);
  from_json(json.at("energy"), trajectory.energy);
  from_json(json.at("counters"), trajectory.counters);
  from_json(json.at("columns"), trajectory.columns);
  return summary;
}

}  // namespace

std::string to_text(Outcome outcome) {
  for (const auto& [value, text] : kOutcomes)
    if (value == outcome) return text;
  return "failed";
}

std::string summary_json(const Trajectory& trajectory, const RunStamp& stamp) {
  Json json = {{kMarker, kRunFormat}};
  json.update(to_json(stamp));
  json["overrides"] = stamp.overrides;
  if (!stamp.model_files.empty()) json["model_files"] = to_json(stamp.model_files);
  json["outcome"] = to_text(trajectory.outcome);
  json["message"] = trajectory.message;
  json["notes"] = trajectory.notes;
  json["method"] = trajectory.method;
  json["tolerance"] = trajectory.tolerance;
  if (trajectory.of_motion) json["motion_error"] = trajectory.motion_error;
  if (trajectory.growth.rate > 0) json["growth"] = to_json(trajectory.growth);
  json["t_end"] = trajectory.t_end;
  json["wall_seconds"] = trajectory.wall_seconds;
  json["units"] = units();
  json["joints"] = to_json(trajectory.joints);
  json["springs"] = to_json(trajectory.springs);
  json["motors"] = to_json(trajectory.motors);
  json["bearings"] = to_json(trajectory.bearings);
  if (const auto kinds = kinds_of_events(trajectory); !kinds.empty()) json["events"] = to_json(kinds);
  if (!trajectory.wear.empty()) json["wear"] = to_json(trajectory.wear);
  if (!trajectory.duty.empty()) json["duty"] = to_json(trajectory.duty);
  json["energy"] = to_json(trajectory.energy);
  json["counters"] = to_json(trajectory.counters);
  json["rows"] = trajectory.n_rows();
  json["columns"] = to_json(trajectory.columns);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string bearing_json(const std::vector<BearingSummary>& bearings) {
  return Json{{"bearings", to_json(bearings)}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Summary parse_summary(std::string_view text, const std::filesystem::path& path) {
  try {
    return summary_from(Json::parse(text));
  } catch (const Json::exception& error) {
    throw FileError(fmt::format("{}: it is not a summary that pintle run wrote: {}.", path.string(), error.what()));
  } catch (const std::invalid_argument& error) {
    throw FileError(fmt::format("{}: {}.", path.string(), error.what()));
  }
}

bool is_summary(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  return json.is_object() && json.contains(kMarker);
}

}  // namespace pintle

// A run for the studio: progress on the way, columns and summaries at the end.
#include <fmt/format.h>

#include <algorithm>

#include "pintle/read_model.h"
#include "pintle/report.h"
#include "pintle/results.h"
#include "pintle/simulate.h"
#include "studio/kernel/exchange.h"

namespace pintle::studio {
namespace {

constexpr double kPilotShare = 0.15;  // of a run's time, roughly
constexpr double kPassShare = 0.75;   // of what is left, by each further integration

// How far a run is. How many integrations it will take is not known before the end, so this is a guess that never falls.
class ProgressGuess {
 public:
  double at(const Progress& progress) {
    const double inside = progress.duration > 0 ? std::clamp(progress.t / progress.duration, 0.0, 1.0) : 0;
    double begin = 0, share = kPilotShare;
    for (int pass = 2; pass <= progress.pass; ++pass) {
      begin += share;
      share = kPassShare * (1 - begin);
    }
    if (progress.pass >= 1) so_far_ = std::max(so_far_, begin + share * inside);
    return so_far_;
  }

 private:
  double so_far_ = 0;
};

Json progress_json(const Progress& progress, double fraction) {
  Json out = {{"fraction", fraction}, {"t", progress.t}, {"duration", progress.duration}, {"pass", progress.pass}, {"wall_seconds", progress.wall_seconds}};
  out["seconds_left"] = fraction > 0.02 ? Json(progress.wall_seconds * (1 - fraction) / fraction) : Json(nullptr);
  return out;
}

// The name tells everything: "joint.A.on_coupler.fx[world]", "body.crank.x", "energy.kinetic".
Json column_json(const Column& column) {
  Json out = {{"name", column.name}, {"unit", column.unit}, {"about", column.about}};
  const std::string& name = column.name;
  const std::size_t first = name.find('.'), bracket = name.find('[');
  const std::string kind = first == std::string::npos ? "time" : name.substr(0, first);
  std::string of, feels, quantity = name, frame;
  if (bracket != std::string::npos) frame = name.substr(bracket + 1, name.size() - bracket - 2);
  const std::string path = name.substr(0, bracket);
  if (kind != "time") {
    const std::size_t last = path.rfind('.');
    quantity = path.substr(last + 1);
    if (last > first) of = path.substr(first + 1, last - first - 1);
    if (const std::size_t on = of.find(".on_"); on != std::string::npos) {
      feels = of.substr(on + 4);
      of = of.substr(0, on);
    }
  }
  out.update({{"kind", kind}, {"of", of}, {"quantity", quantity}, {"frame", frame}, {"feels", feels}});
  return out;
}

std::vector<double> column_values(const Trajectory& trajectory, std::size_t column) {
  std::vector<double> out(trajectory.n_rows());
  for (std::size_t row = 0; row < out.size(); ++row) out[row] = trajectory.at(row, column);
  return out;
}

std::vector<std::string> overrides_of(const Json& arguments) {
  std::vector<std::string> out;
  const auto it = arguments.find("set");
  if (it == arguments.end()) return out;
  for (const auto& [path, value] : it->items()) out.push_back(path + "=" + value.get<std::string>());
  return out;
}

void demand_duration(const Model& model) {
  if (model.simulate.duration > 0) return;
  throw CallFault("The model states no duration for a run.", "duration = \"1 s\" under [simulate]");
}

struct Asked {
  std::string text;
  Model model;
};

Asked model_asked_for(const Exchange& call) {
  std::string text = text_argument(call, "text");
  Model model = parse_model(text, name_for(text), overrides_of(call.arguments), files_argument(call));
  demand_duration(model);
  return {std::move(text), std::move(model)};
}

Trajectory run_with_progress(const Model& model, const Exchange& call) {
  ProgressGuess guess;
  return simulate(model, [&](const Progress& progress) {
    const double fraction = guess.at(progress);
    return !call.on_progress || call.on_progress(dump(progress_json(progress, fraction)));
  });
}

}  // namespace

Json run(Exchange& call) {
  const Model model = model_asked_for(call).model;
  const Trajectory trajectory = run_with_progress(model, call);

  Json out = Json::parse(summary_json(trajectory, {model.name, "", "", PINTLE_VERSION, ""}));
  Json columns = Json::array(), values = Json::array();
  for (std::size_t c = 0; c < trajectory.columns.size(); ++c) {
    columns.push_back(column_json(trajectory.columns[c]));
    values.push_back(call.array(column_values(trajectory, c)));
  }
  out["columns"] = std::move(columns);
  out["values"] = std::move(values);
  std::vector<std::string> names;
  for (const Joint& joint : model.joints) names.push_back(joint.name);
  const bool ended = trajectory.outcome == Outcome::kRunaway || trajectory.outcome == Outcome::kEnergyOpen;
  if (trajectory.outcome == Outcome::kFailed || trajectory.outcome == Outcome::kInterrupted || ended) {
    const bool failed = trajectory.outcome != Outcome::kInterrupted;
    out["stopped"] = {{"time", trajectory.t_end},
                      {"joints", joints_named_in(trajectory.message, &names)},
                      {"reason", failed ? trajectory.message : "The run was stopped."},
                      {"hint", ended ? "The results so far are kept." : failed ? "Check the loads and motors that act at that time: are they finite, do they add energy? The results so far are kept." : ""}};
  }
  return out;
}

// The page of `pintle report`, of a run made anew: it is the same bits, and the page holds no trajectory.
Json report(Exchange& call) {
  const auto [text, model] = model_asked_for(call);
  RunRecord run{{model.name, name_for(text), "", PINTLE_VERSION, ""}, run_with_progress(model, call)};
  run.stamp.model_text = text;
  return {{"html", report_html(model, run)}};
}

}  // namespace pintle::studio

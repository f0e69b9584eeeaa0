// pintle life: the life of rolling bearings and the pressure on plain ones, from the joint forces of a run.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/model_options.h"
#include "cli/progress.h"
#include "cli/run_sources.h"
#include "cli/verbs.h"
#include "pintle/bearings.h"
#include "results/bearing_text.h"

namespace pintle::cli {
namespace {

constexpr const char* kLifeFooter =
    "Examples:\n"
    "  pintle life four_bar.toml\n"
    "  pintle life four_bar-run --set joint.O4.bearing.type=ball --set joint.O4.bearing.dynamic_load_rating='9.56 kN'\n"
    "  pintle life four_bar-run --set joint.A.bearing.pin_diameter='20 mm' --set joint.A.bearing.pin_length='25 mm' --json\n"
    "\n"
    "The run counts as a load cycle that repeats. Joints without a table `bearing` in the model are listed with their duty.\n"
    "Of a run that is there already, --set changes bearings only.\n\n";

struct LifeOptions : ModelOptions {
  bool json = false, quiet = false;
};

/// Whether the path of a change starts with "joint.NAME.bearing".
bool is_of_bearing(const std::string& change) {
  const std::string path = change.substr(0, change.find('='));
  const std::size_t name = path.find('.'), rest = name == std::string::npos ? name : path.find('.', name + 1);
  if (path.substr(0, name) != "joint" || rest == std::string::npos) return false;
  const std::string tail = path.substr(rest + 1);
  return tail == "bearing" || tail.starts_with("bearing.");
}

/// The first change that requires a new run instead of the existing one; "" if none does.
std::string needs_a_run(const LifeOptions& options) {
  for (const std::string& change : laws_and_overrides(options.laws, options.overrides))
    if (!is_of_bearing(change)) return change;
  if (!options.duration.empty()) return "--duration " + options.duration;
  return options.tolerance.empty() ? "" : "--tolerance " + options.tolerance;
}

DrawnRun make_run(const LifeOptions& options) {
  DrawnRun made;
  made.model = read_model_to_run(options).model;
  made.run.stamp = {made.model.name, options.model, "", "", ""};
  catch_interrupts();
  ProgressReport report(progress_style(options.quiet));
  made.run.trajectory = with_file_name(options.model, [&] { return simulate(made.model, report.observer()); });
  report.clear();
  return made;
}

std::string heading(const RunRecord& run, bool colour) {
  const std::string name = run.stamp.model_name.empty() ? run.stamp.model_path : run.stamp.model_name;
  const Trajectory& made = run.trajectory;
  std::string text = fmt::format("{}{}{}: {} after {:.6g} s of model time, {} rows\n", colour ? "\x1b[1m" : "", name, colour ? "\x1b[0m" : "", to_text(made.outcome), made.t_end, made.n_rows());
  return made.message.empty() ? text : text + "  " + made.message + "\n";
}

ExitCode life(const LifeOptions& options) {
  const bool there = std::filesystem::is_directory(options.model);
  if (const std::string change = there ? needs_a_run(options) : ""; !change.empty()) {
    print_error(fmt::format("pintle life: found \"{}\": {} has been run already, and this would be another run.\n    try: the model file instead of the run, or changes of joint.NAME.bearing only\n", change, options.model));
    return kCommandLineError;
  }
  DrawnRun drawn = there ? read_drawn_run(options.model, options.overrides) : make_run(options);
  Trajectory& run = drawn.run.trajectory;
  run.bearings = bearing_summaries(drawn.model, run, BearingsOf::kEveryPin);
  const bool colour = wants_colour(STDOUT_FILENO);
  if (options.json) print_out(bearing_json(run.bearings));
  else if (!options.quiet) print_out(heading(drawn.run, colour) + (run.bearings.empty() ? "There are no revolute joints.\n" : bearing_text(run.bearings, colour ? "\x1b[1m" : "", colour ? "\x1b[0m" : "")));
  return there ? kOk : exit_code_of(run.outcome);
}

}  // namespace

void add_life(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("life", "Life of rolling bearings and pressure in plain ones, by the joint forces of a run");
  const auto options = std::make_shared<LifeOptions>();
  verb->add_option("RUN_OR_MODEL", options->model, "run folder, or model file (.toml or .json) to run first")->required();
  add_changes(*verb, *options);
  verb->add_flag("--json", options->json, "print the table as JSON, in SI units");
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(std::string(kLifeFooter) + kExitCodeHelp);
  verb->callback([options, &exit_code] { exit_code = life(*options); });
}

}  // namespace pintle::cli

// pintle run: model file -> run folder and a table.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/verbs.h"
#include "io/document.h"
#include "pintle/read_model.h"
#include "pintle/results.h"
#include "pintle/simulate.h"
#include "results/disk.h"
#include "results/sha256.h"

namespace pintle::cli {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  pintle run four_bar.toml\n"
    "  pintle run four_bar.toml --set joint.A.stiffness='2e8 N/m' --tolerance 1e-6 --out stiffer\n"
    "  pintle run four_bar.toml --json --quiet > summary.json\n"
    "\n"
    "The run folder holds series.csv (two header rows: name and unit) and summary.json. Ctrl-C stops a run and keeps "
    "the\n"
    "results up to there; a second Ctrl-C kills it.\n\n";

constexpr const char* kFailureAdvice =
    "    try: look at the loads and motors that act at that time (do they stay finite, do they feed energy?), or at "
    "the\n"
    "    results up to there, which are kept\n";

struct RunOptions {
  std::string model;
  std::vector<std::string> overrides;
  std::string duration, tolerance, method;
  std::string out;
  std::string progress = "auto";
  bool quiet = false, json = false, force = false;
};

ProgressStyle progress_style(const RunOptions& options) {
  if (options.progress == "json") return ProgressStyle::kJson;
  const bool watched = options.progress == "auto" && !options.quiet && is_terminal(STDERR_FILENO);
  return watched ? ProgressStyle::kLine : ProgressStyle::kNone;
}

/// --duration and its kin are --set simulate.duration and its kin.
std::vector<std::string> all_overrides(const RunOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  const auto add = [&overrides](const char* key, const std::string& value) {
    if (!value.empty()) overrides.push_back(fmt::format("simulate.{}={}", key, value));
  };
  add("duration", options.duration);
  add("tolerance", options.tolerance);
  add("method", options.method);
  return overrides;
}

/// A model may leave its duration to the command line; a run may not.
void check_duration(const Model& model, const std::string& text, const RunOptions& options) {
  if (model.simulate.duration > 0) return;
  const Document document = parse_document(text, options.model);
  const Entry* simulate = document.root.table()->find_entry("simulate");
  throw InputError({document.complaint(simulate == nullptr ? Spot{0, 1, 1} : simulate->key_spot, "simulate.duration",
                                       "no duration", "a run needs to know how long it lasts",
                                       "duration = \"1 s\" under [simulate], or --duration '1 s'")});
}

std::filesystem::path run_folder(const RunOptions& options) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path(options.model).stem().string() + "-run";
}

ExitCode exit_code_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kCompleted:
      return kOk;
    case Outcome::kToleranceNotMet:
      return kToleranceMissed;
    case Outcome::kInterrupted:
      return kStoppedBySignal;
    case Outcome::kFailed:
      return kIntegrationFailed;
  }
  return kInternalError;
}

/// An assembly's message with the file's name before it.
Trajectory simulate_file(const Model& model, const std::string& file, const Observer& observer) {
  try {
    return simulate(model, observer);
  } catch (const AssemblyError& error) {
    throw AssemblyError(fmt::format("{}: {}", file, error.what()));
  }
}

void print_results(const Trajectory& trajectory, const RunStamp& stamp, const RunOptions& options,
                   const std::filesystem::path& folder) {
  if (options.json) {
    print_out(summary_json(trajectory, stamp));
  } else if (!options.quiet) {
    print_out(summary_text(trajectory, stamp, wants_colour(STDOUT_FILENO)));
    print_out(fmt::format("\nResults in {}/ (series.csv, summary.json)\n", folder.string()));
  }
  const bool failed = trajectory.outcome == Outcome::kFailed;
  if (failed || (options.quiet && trajectory.outcome != Outcome::kCompleted))
    print_error(fmt::format("{}: {}{}{}\n{}", options.model, to_text(trajectory.outcome),
                            trajectory.message.empty() ? "" : ": ", trajectory.message, failed ? kFailureAdvice : ""));
}

ExitCode run(const RunOptions& options) {
  const std::filesystem::path folder = run_folder(options);
  const Overwrite overwrite = options.force ? Overwrite::kAnyFolder : Overwrite::kRunFolder;
  const std::string text = read_file(options.model, kMaxFileBytes + 1);
  const Model model = parse_model(text, options.model, all_overrides(options));
  check_duration(model, text, options);
  check_run_folder(folder, overwrite);
  const RunStamp stamp{model.name, options.model, "sha256:" + sha256(text), PINTLE_VERSION, command_line()};

  catch_interrupts();
  ProgressReport report(progress_style(options));
  const Trajectory trajectory = simulate_file(model, options.model, [&report](const Progress& progress) {
    report.show(progress);
    return !interrupted();
  });
  report.clear();
  write_run(trajectory, stamp, folder, overwrite);
  report.finish(trajectory, folder);
  print_results(trajectory, stamp, options, folder);
  return exit_code_of(trajectory.outcome);
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("run", "Run a model; write series.csv and summary.json, print joint forces");
  const auto options = std::make_shared<RunOptions>();
  verb->add_option("MODEL", options->model, "model file (.toml or .json)")->required();
  verb->add_option("--set", options->overrides,
                   "change one value of the model, e.g. joint.A.stiffness=2e8 (repeatable)")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  verb->add_option("--duration", options->duration, "model time to run, e.g. 2 or '500 ms'")->type_name("TIME");
  verb->add_option("--tolerance", options->tolerance, "wanted error of each joint force, relative to its peak")
      ->type_name("NUMBER");
  verb->add_option("--method", options->method, "integration method")
      ->check(CLI::IsMember({"auto", "radau", "dopri5", "ode45", "ode23t", "ode15s", "ode113", "hht", "generalised_alpha"}))
      ->type_name("auto|radau|dopri5|ode45|ode23t|ode15s|ode113|hht|generalised_alpha");
  verb->add_option("-o,--out", options->out, "run folder (default: <name of the model file>-run)")->type_name("FOLDER");
  verb->add_flag("--force", options->force, "write into a folder that is not an earlier run; its files stay");
  verb->add_option("--progress", options->progress, "on standard error: a line on a terminal, nothing, or JSON lines")
      ->check(CLI::IsMember({"auto", "none", "json"}))
      ->type_name("auto|none|json");
  verb->add_flag("--json", options->json, "print summary.json instead of the table");
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(std::string(kFooter) + kExitCodeHelp);
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pintle::cli

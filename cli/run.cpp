// pintle run: model file -> run folder and a table.
#include <fmt/format.h>
#include <sys/resource.h>
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
#include "cli/model_options.h"
#include "cli/progress.h"
#include "cli/verbs.h"
#include "pintle/results.h"
#include "pintle/simulate.h"
#include "results/disk.h"
#include "results/sha256.h"

namespace pintle::cli {
namespace {

constexpr const char* kRunFooter =
    "Examples:\n"
    "  pintle run four_bar.toml\n"
    "  pintle run four_bar.toml --set joint.A.stiffness='2e8 N/m' --tolerance 1e-6 --out stiffer\n"
    "  pintle run four_bar.toml --law 'joint.B=maxwell,stiffness=2e6,branch_ratio=[1],branch_time=[0.01]' --out rubber\n"
    "  pintle run four_bar.toml --json --quiet > summary.json\n"
    "\n"
    "The run folder holds series.csv (two header rows: name and unit) and summary.json. Ctrl-C stops a run and keeps the\n"
    "results so far; a second Ctrl-C kills it.\n\n";

constexpr const char* kFailureAdvice =
    "    try: check the loads and motors that act at that time (are they finite, do they add energy?), or the\n"
    "    results up to then, which are kept\n";

struct RunOptions : ModelOptions {
  std::string out;
  std::string progress = "auto";
  bool quiet = false, json = false, force = false;
};

std::filesystem::path run_folder(const RunOptions& options) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path(options.model).stem().string() + "-run";
}

/// The memory used if it is large enough to matter; otherwise "".
std::string memory_text() {
  constexpr double kWorthSaying = 100;
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
#ifdef __APPLE__
  const double megabytes = static_cast<double>(use.ru_maxrss) / 1048576;
#else
  const double megabytes = static_cast<double>(use.ru_maxrss) / 1024;
#endif
  return megabytes < kWorthSaying ? "" : fmt::format("; peak memory {:.0f} MB", megabytes);
}

void print_results(const Trajectory& trajectory, const RunStamp& stamp, const RunOptions& options,
                   const std::filesystem::path& folder) {
  if (options.json) {
    print_out(summary_json(trajectory, stamp));
  } else if (!options.quiet) {
    print_out(summary_text(trajectory, stamp, wants_colour(STDOUT_FILENO)));
    print_out(fmt::format("\nResults in {0}/ (series.csv, summary.json){1}\nSee them: pintle report {2}\n", folder.string(), memory_text(), shell_word(folder.string())));
  }
  const bool failed = trajectory.outcome == Outcome::kFailed;
  if (failed || (options.quiet && trajectory.outcome != Outcome::kCompleted))
    print_error(fmt::format("{}: {}{}{}\n{}", options.model, to_text(trajectory.outcome),
                            trajectory.message.empty() ? "" : ": ", trajectory.message, failed ? kFailureAdvice : ""));
}

ExitCode run(const RunOptions& options) {
  const std::filesystem::path folder = run_folder(options);
  const Overwrite overwrite = options.force ? Overwrite::kAnyFolder : Overwrite::kRunFolder;
  const auto [text, model, files] = read_model_to_run(options);
  check_run_folder(folder, overwrite);
  const RunStamp stamp{model.name, options.model, "sha256:" + sha256(text), PINTLE_VERSION, command_line(),
                       all_overrides(options), text, files};

  catch_interrupts();
  ProgressReport report(progress_style(options.quiet, options.progress), model.notes);
  const Trajectory trajectory = with_file_name(options.model, [&, &ready = model] { return simulate(ready, report.observer()); });
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
  add_model_options(*verb, *options);
  verb->add_option("--tolerance-of", options->tolerance_of, "what the tolerance applies to: joint forces (default) or body positions")
      ->check(CLI::IsMember({"forces", "motion"}))
      ->type_name("forces|motion");
  verb->add_option("--method", options->method, "integration method")
      ->check(CLI::IsMember(method_names()))
      ->type_name("NAME");
  verb->add_option("--equations", options->equations, "newtonian: every joint a force law; relative: relative coordinates for joints marked ideal; ideal: every joint a constraint; penalty, augmented_lagrangian, relative_augmented_lagrangian: the same by the methods of Bayo and Cuadrado")
      ->check(CLI::IsMember(equations_names(true)))
      ->type_name("NAME");
  verb->add_option("-o,--out", options->out, "run folder (default: <name of the model file>-run)")->type_name("FOLDER");
  verb->add_flag("--force", options->force, "write into a folder that is not an earlier run; its files are kept");
  verb->add_option("--progress", options->progress, "on standard error: a line on a terminal, nothing, or JSON lines")
      ->check(CLI::IsMember({"auto", "none", "json"}))
      ->type_name("auto|none|json");
  verb->add_flag("--json", options->json, "print summary.json instead of the table");
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(std::string(kRunFooter) + kExitCodeHelp);
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pintle::cli

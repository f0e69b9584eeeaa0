#include "cli/ensembles/sweep.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/command_line.h"
#include "cli/companions.h"
#include "cli/console.h"
#include "cli/ensembles/sweep_progress.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/model_options.h"
#include "io/document.h"
#include "io/model_files.h"
#include "pintle/read_model.h"
#include "results/disk.h"
#include "sweeps/run_sweep.h"
#include "sweeps/sweep_report.h"

#ifdef PINTLE_MPI
#include "cli/ensembles/mpi_processes.h"
#endif

namespace pintle::cli {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  pintle sweep four_bar.toml --vary joint.A.stiffness='1e6..1e9 N/m:log:16' --plot A.svg\n"
    "  pintle sweep four_bar.toml --vary parameters.speed='5,10,20 rad/s' --vary defaults.joint.damping=1e3..1e5:log:9\n"
    "  pintle sweep four_bar.toml --sample 100000 --seed 1 --tolerance 1e-4 --check-every 100\n"
    "  mpirun -n 64 pintle sweep four_bar.toml --sample 1000000\n"
    "\n"
    "--vary makes a grid, the last one varying fastest; --sample draws from the distributions under [variation] in the\n"
    "model, at each point of the grid. After Ctrl-C, a kill or a power cut, run the same command again to continue from\n"
    "FILE.part. The file is bitwise identical for any number of threads, machines and restarts.\n\n";

struct SweepOptions : ModelOptions {
  SweepRequest request;
  SweepRun run;
  std::string out, plot, progress = "auto";
  bool quiet = false, json = false;
};

/// The options that determine the results, as a command; without how the work is distributed or where the results go.
std::string command_of(const SweepOptions& options) {
  const SweepRequest& r = options.request;
  std::string text = "pintle sweep " + shell_word(options.model);
  for (const std::string& set : r.overrides) text += " --set " + shell_word(set);
  for (const std::string& vary : r.vary) text += " --vary " + shell_word(vary);
  if (r.zip) text += " --zip";
  if (r.samples > 0) text += fmt::format(" --sample {} --seed {}{}", r.samples, r.seed, r.latin ? " --latin" : "");
  for (const std::string& series : r.series) text += " --series " + shell_word(series);
  return r.check_every > 1 ? text + fmt::format(" --check-every {}", r.check_every) : text;
}

// The model, and the files that it names.
void read_texts(SweepOptions& options) {
  SweepRequest& request = options.request;
  request.model_text = read_file(options.model, kMaxFileBytes + 1);
  ModelFiles files(options.model);
  parse_model(request.model_text, options.model, request.overrides, files.reader());
  request.model_files = files.texts();
}

#ifdef PINTLE_MPI

// Returns the outcome on the first process; the others compute for it and return nothing.
std::optional<SweepOutcome> run_on_all(SweepOptions& options, const SweepObserver& observer) {
  MpiProcesses processes;
  if (processes.is_first()) read_texts(options);
  processes.share(options.request.model_text);
  processes.share(options.request.model_files);
  if (!processes.is_first()) {
    try {
      processes.work(options.request, usable_threads(options.run.threads));
      return std::nullopt;
    } catch (const std::exception& error) {
      print_error(fmt::format("pintle sweep: {}\n", error.what()));
      processes.abort(kInternalError);
    }
  }
  try {
    const SweepOutcome outcome = run_sweep(options.request, options.run, observer, &processes);
    processes.dismiss();
    return outcome;
  } catch (...) {
    processes.dismiss();
    throw;
  }
}

#endif

std::optional<SweepOutcome> run_everywhere(SweepOptions& options, const SweepObserver& observer) {
#ifdef PINTLE_MPI
  if (started_by_mpi()) return run_on_all(options, observer);
#endif
  read_texts(options);
  return run_sweep(options.request, options.run, observer, nullptr);
}

void print_results(const SweepOptions& options, const SweepOutcome& outcome) {
  if (options.quiet && !options.json && options.plot.empty()) return;
  const SweepTable table = read_sweep(options.run.out);
  if (!options.plot.empty()) {
    const auto plot = sweep_plot(table);
    if (plot) write_file(options.plot, to_svg(*plot));
    else print_error("pintle sweep: no plot: it needs one varying value, or two of which one takes at most eight values\n");
  }
  if (options.json) return print_out(sweep_json(table, options.run.out.string()));
  if (options.quiet) return;
  print_out(sweep_text(table, wants_colour(STDOUT_FILENO)));
  if (outcome.end == SweepEnd::kFinishedBefore) print_out(fmt::format("\n{} is already complete; --force recomputes it\n", options.run.out.string()));
  else {
    const std::uint64_t kept = outcome.progress.resumed;
    print_out(fmt::format("\nResults in {} ({} samples in {}{})\n", options.run.out.string(), outcome.progress.done - kept, clock_text(outcome.progress.wall_seconds),
                          kept > 0 ? fmt::format(", {} from before", kept) : ""));
  }
}

ExitCode sweep_model(SweepOptions& options) {
  options.request.model_name = options.model;
  options.request.overrides = all_overrides(options);
  options.run.out = options.out.empty() ? std::filesystem::path(options.model).stem().string() + "-sweep.h5" : options.out;
  options.run.command = command_of(options);
  catch_interrupts();
  SweepProgressReport report(progress_style(options.quiet, options.progress));
  const auto outcome = run_everywhere(options, [&report](const SweepProgress& progress) {
    report.show(progress);
    return !interrupted();
  });
  if (!outcome) return kOk;
  report.finish(*outcome, options.run.out);
  if (outcome->end == SweepEnd::kInterrupted) {
    print_error(fmt::format("stopped after {} of {} samples, kept in {}.part\n    try: run the same command again to continue\n",
                            outcome->progress.done, outcome->progress.total, options.run.out.string()));
    return kStoppedBySignal;
  }
  print_results(options, *outcome);
  return kOk;
}

}  // namespace

void add_sweep(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("sweep", kSweepDescription);
  const auto options = std::make_shared<SweepOptions>();
  SweepRequest& request = options->request;
  add_model_options(*verb, *options);
  verb->add_option("--vary", request.vary, "a value to vary over a range or a list (repeatable: a grid)")->type_name("PATH=FROM..TO:lin|log:COUNT")->allow_extra_args(false);
  verb->add_flag("--zip", request.zip, "vary all --vary together instead of as a grid");
  verb->add_option("--sample", request.samples, "number of samples to draw from the distributions in the model")->type_name("COUNT")->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  verb->add_option("--seed", request.seed, "seed of the random numbers")->type_name("NUMBER")->capture_default_str();
  verb->add_flag("--latin", request.latin, "Latin hypercube: the samples fill each value's range evenly");
  verb->add_option("--series", request.series, "keep this column of series.csv at all output times (repeatable)")->type_name("COLUMN")->allow_extra_args(false);
  verb->add_option("--check-every", request.check_every, "estimate the errors of one sample in this many; the others are integrated once, with the steps of the nominal run")
      ->type_name("COUNT")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
      ->capture_default_str();
  verb->add_option("-o,--out", options->out, "file (default: <name of the model file>-sweep.h5)")->type_name("FILE.h5");
  verb->add_flag("--force", options->run.force, "replace any existing file or journal");
  verb->add_option("--threads", options->run.threads, "threads of each process (default: one per core)")->type_name("COUNT")->check(CLI::Range(1, 4096));
  verb->add_option("--plot", options->plot, "plot the peak forces against the one or two varying values")->type_name("FILE.svg")->check(svg_problem, "", "");
  verb->add_option("--progress", options->progress, "on standard error: a line on a terminal, nothing, or JSON lines")->check(CLI::IsMember({"auto", "none", "json"}))->type_name("auto|none|json");
  verb->add_flag("--json", options->json, "print the summary as JSON");
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(std::string(kFooter) + kExitCodeHelp);
  verb->callback([options, &exit_code] { exit_code = sweep_model(*options); });
}

}  // namespace pintle::cli

// pintle compare: what the compliance of the joints does, beside ideal joints or relative coordinates.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/model_options.h"
#include "cli/progress.h"
#include "cli/verbs.h"
#include "pintle/compare.h"
#include "results/disk.h"
#include "results/studies/compare_report.h"

namespace pintle::cli {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  pintle compare four_bar.toml\n"
    "  pintle compare four_bar.toml --set defaults.joint.stiffness=1e6 --plot softer.svg\n"
    "  pintle compare four_bar.toml --against relative --set joint.A.ideal=true --set joint.B.ideal=true\n"
    "\n"
    "Digits are the significant figures in which both agree. A difference within the error estimates of both runs is\n"
    "called numerical, a larger one physical: the joints' own compliance.\n\n";

struct CompareOptions : ModelOptions {
  std::string against = "ideal", plot;
  bool json = false, quiet = false;
};

/// The worse of two outcomes.
ExitCode exit_code_of(const Comparison& comparison) {
  ExitCode code = kOk;
  for (const Trajectory* run : {&comparison.first, &comparison.second}) {
    if (run->outcome == Outcome::kInterrupted) return kStoppedBySignal;
    if (run->outcome == Outcome::kFailed) code = kIntegrationFailed;
    if (code != kOk) continue;
    if (run->outcome == Outcome::kToleranceNotMet) code = kToleranceMissed;
    if (run->outcome == Outcome::kHorizon) code = kPromisedUntilHorizon;
    if (run->outcome == Outcome::kRunaway) code = kRanAway;
    if (run->outcome == Outcome::kEnergyOpen) code = kEnergyOpen;
  }
  return code;
}

ExitCode compare_model(const CompareOptions& options) {
  const Model model = read_model_to_run(options).model;
  const Equations against = options.against == "ideal" ? Equations::kIdeal : Equations::kRelative;
  catch_interrupts();
  ProgressReport report(!options.quiet && is_terminal(STDERR_FILENO) ? ProgressStyle::kLine : ProgressStyle::kNone);
  const Comparison comparison = with_file_name(options.model, [&] {
    return compare(model, against, [&report](const Progress& progress) {
      report.show(progress);
      return !interrupted();
    });
  });
  report.clear();
  const std::string title = model.name.empty() ? options.model : model.name;
  const std::string plot = options.plot.empty() ? std::filesystem::path(options.model).stem().string() + "-compare.svg" : options.plot;
  if (plot != "none") write_file(plot, to_svg(compare_plot(comparison, title)));
  if (options.json) print_out(compare_json(comparison, model.name, options.model));
  else if (!options.quiet) print_out(compare_text(comparison, title, wants_colour(STDOUT_FILENO)) + (plot == "none" ? "" : "\nPlot: " + plot + "\n"));
  return exit_code_of(comparison);
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("compare", "Compare compliant joints with ideal ones: how many digits agree, and why they differ");
  const auto options = std::make_shared<CompareOptions>();
  add_model_options(*verb, *options);
  verb->add_option("--against", options->against, "ideal: every joint ideal; relative: relative coordinates for the joints marked ideal")
      ->check(CLI::IsMember({"ideal", "relative", "lagrangian"}))
      ->type_name("ideal|relative")
      ->capture_default_str();
  verb->add_option("--plot", options->plot, "picture to write (default: <name of the model file>-compare.svg; none: no picture)")->type_name("FILE.svg")->check(svg_or_none_problem, "", "");
  verb->add_flag("--json", options->json, "print the comparison as JSON");
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(std::string(kFooter) + kExitCodeHelp);
  verb->callback([options, &exit_code] { exit_code = compare_model(*options); });
}

}  // namespace pintle::cli

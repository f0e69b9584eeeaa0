// pintle solvers: the cost of every integration method for a model, and the accuracy of its joint forces.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/model_options.h"
#include "cli/verbs.h"
#include "pintle/solvers.h"
#include "results/disk.h"
#include "results/studies/solvers_report.h"

namespace pintle::cli {
namespace {

constexpr const char* kSolversFooter =
    "Examples:\n"
    "  pintle solvers four_bar.toml\n"
    "  pintle solvers four_bar.toml --methods radau,ode15s,hht --tolerances 1e-4,1e-6,1e-8 --plot work.svg\n"
    "  pintle solvers four_bar.toml --set simulate.equations=ideal\n"
    "  pintle solvers pendulum.toml --set joint.pin.stiffness=1e9 --duration '0.2 s' --json\n"
    "\n"
    "Every method integrates the model once per tolerance, from the same start. Its joint forces are compared at the\n"
    "output times with a reference run of radau at tolerance 1e-9, whose own estimated error is printed. A joint's\n"
    "force error is the largest over the output times, relative to the joint's peak force.\n"
    "\n"
    "Parasitic vibration is measured from the force minus the reference force, less its running mean over 3 periods of the\n"
    "joints' slowest vibration (at least 20 output steps, at most a quarter of the run): peak to peak in the last half of\n"
    "the run. Smooth drift does not count.\n"
    "\n"
    "radau and dopri5 are Pintle's own and control the error of the joint forces. The others control that of positions and\n"
    "velocities, as general integrators do: ode45 (Dormand-Prince), ode23t (trapezoidal rule), ode15s (BDF), ode113\n"
    "(Adams), hht (alpha = -0.05), generalised_alpha (spectral radius 0.9).\n"
    "\n"
    "With --set simulate.equations=ideal the methods are ways to keep constraints: multipliers (the reference), penalty,\n"
    "augmented_lagrangian (trapezoidal rule), augmented_lagrangian_hht, and both in relative coordinates.\n\n";

struct SolversOptions : ModelOptions {
  std::string plot;
  SolverStudyOptions study;
  bool json = false, quiet = false;
};

ExitCode exit_code_of(const SolverStudy& study) {
  if (study.interrupted) return kStoppedBySignal;
  if (!study.truth.complete) return kIntegrationFailed;
  return kOk;
}

ExitCode solvers(const SolversOptions& options) {
  const Model model = read_model_to_run(options).model;
  catch_interrupts();
  SolverStudy study;
  try {
    study = with_file_name(options.model, [&] { return compare_solvers(model, options.study, [] { return !interrupted(); }); });
  } catch (const std::invalid_argument& error) {
    print_error(fmt::format("pintle solvers: {}\n", error.what()));
    return kCommandLineError;
  }
  const std::string title = model.name.empty() ? options.model : model.name;
  if (options.json) print_out(solvers_json(study, model.name, options.model));
  else if (!options.quiet) print_out(solvers_text(study, title, wants_colour(STDOUT_FILENO)));
  if (!options.plot.empty()) write_file(options.plot, to_svg(solvers_plot(study, title)));
  if (!study.truth.complete && !study.interrupted)
    print_error(fmt::format("{}: the reference run failed: {}\n", options.model, study.truth.message));
  return exit_code_of(study);
}

}  // namespace

void add_solvers(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("solvers", "Compare the integration methods on a model: cost, joint-force error, vibration");
  const auto options = std::make_shared<SolversOptions>();
  std::vector<std::string> known = solver_methods(Equations::kNewtonian);
  for (std::string& word : solver_methods(Equations::kIdeal)) known.push_back(std::move(word));
  add_model_options(*verb, *options, false);
  verb->add_option("--methods", options->study.methods, "methods to compare")
      ->type_name("LIST")
      ->delimiter(',')
      ->check(CLI::IsMember(known))
      ->allow_extra_args(false);
  verb->add_option("--tolerances", options->study.tolerances, "tolerances (1e-3 to 1e-7)")
      ->type_name("LIST")
      ->delimiter(',')
      ->check(CLI::Range(1e-14, 0.5))
      ->allow_extra_args(false);
  verb->add_option("--truth", options->study.truth_tolerance, "tolerance of the reference run (1e-9)")
      ->type_name("NUMBER")
      ->check(CLI::Range(1e-13, 0.5));
  verb->add_option("--time-limit", options->study.time_limit, "seconds for each integration; longer ones are stopped (10)")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
  verb->add_option("--max-step", options->max_step, "longest step of every method, e.g. '1 ms'")->type_name("TIME");
  verb->add_option("--plot", options->plot, "plot force error over time and over evaluations")->type_name("FILE.svg")->check(svg_problem, "", "");
  verb->add_flag("--json", options->json, "print everything as JSON");
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(std::string(kSolversFooter) + kExitCodeHelp);
  verb->callback([options, &exit_code] { exit_code = solvers(*options); });
}

}  // namespace pintle::cli

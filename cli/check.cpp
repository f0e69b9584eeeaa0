// pintle check: is the model file valid, how can the mechanism move, how fast does it vibrate, do its formulas agree with finite differences?
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/model_options.h"
#include "cli/verbs.h"
#include "io/document.h"
#include "io/model_files.h"
#include "pintle/check.h"
#include "pintle/read_model.h"
#include "results/disk.h"
#include "results/studies/check_report.h"

namespace pintle::cli {
namespace {

constexpr const char* kCheckFooter =
    "Examples:\n"
    "  pintle check four_bar.toml\n"
    "  pintle check four_bar.toml --set parameters.theta='90 deg' --details\n"
    "  pintle check four_bar.toml --json | jq .mobility\n\n";

struct CheckOptions {
  std::string model;
  std::vector<std::string> overrides, laws;
  bool json = false, details = false, quiet = false;
};

ExitCode check(const CheckOptions& options) {
  const std::string text = read_file(options.model, kMaxFileBytes + 1);
  const Model model = parse_model(text, options.model, laws_and_overrides(options.laws, options.overrides), ModelFiles(options.model).reader());
  const CheckReport report = check_model(model);
  if (options.json) {
    print_out(check_json(report, model.name, options.model));
  } else if (!options.quiet) {
    print_out(check_text(report, model.name.empty() ? options.model : model.name, options.details,
                         wants_colour(STDOUT_FILENO)));
  }
  if (report.passed()) return kOk;
  print_error(fmt::format("{}: a formula disagrees with finite differences, or the energy account does not close\n",
                          options.model));
  return kCheckFailed;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("check", "Check a model without running it: mobility, loops, frequencies, formulas");
  const auto options = std::make_shared<CheckOptions>();
  verb->add_option("MODEL", options->model, "model file (.toml or .json)")->required();
  add_set_and_law(*verb, options->overrides, options->laws);
  verb->add_flag("--details", options->details, "list every mode, joint component and comparison");
  verb->add_flag("--json", options->json, "print the report as JSON");
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(std::string(kCheckFooter) + kExitCodeHelp);
  verb->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace pintle::cli

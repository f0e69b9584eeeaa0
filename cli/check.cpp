// pintle check: is the model file in order?
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/verbs.h"
#include "io/document.h"
#include "pintle/read_model.h"
#include "results/disk.h"

namespace pintle::cli {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  pintle check four_bar.toml\n"
    "  pintle check four_bar.toml --set crank='0.8 m'\n\n";

struct CheckOptions {
  std::string model;
  std::vector<std::string> overrides;
};

std::string counted(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

void check(const CheckOptions& options) {
  const std::string text = read_file(options.model, kMaxFileBytes + 1);
  const Model model = parse_model(text, options.model, options.overrides);
  print_out(fmt::format(
      "{}: in order: {}, {}, {}, {}, {}\n", options.model, counted(model.bodies.size(), "moving body", "moving bodies"),
      counted(model.joints.size(), "joint", "joints"), counted(model.springs.size(), "spring", "springs"),
      counted(model.forces.size(), "force", "forces"), counted(model.motors.size(), "motor", "motors")));
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("check", "Check a model file without running it");
  const auto options = std::make_shared<CheckOptions>();
  verb->add_option("MODEL", options->model, "model file (.toml or .json)")->required();
  verb->add_option("--set", options->overrides,
                   "change one value of the model, e.g. joint.A.stiffness=2e8 (repeatable)")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  verb->footer(std::string(kFooter) + kExitCodeHelp);
  verb->callback([options, &exit_code] {
    check(*options);
    exit_code = kOk;
  });
}

}  // namespace pintle::cli

// pintle stiffen: how stiff the joints must be for the required digits of the forces.
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
#include "io/toml/edit_toml.h"
#include "pintle/stiffen.h"
#include "results/disk.h"
#include "results/studies/stiffen_report.h"

namespace pintle::cli {
namespace {

constexpr const char* kStiffenFooter =
    "Examples:\n"
    "  pintle stiffen four_bar.toml --digits 4\n"
    "  pintle stiffen four_bar.toml --joint O4 --digits 6 --damping-ratio 0.1\n"
    "  pintle stiffen four_bar.toml --motion-only --write\n"
    "\n"
    "Ropes, and joints that the model makes softer than the starting stiffness, keep their stiffness as part of the\n"
    "mechanism. All other stiffnesses are raised tenfold until the digits agree.\n\n";

struct StiffenOptions : ModelOptions {
  StiffenRequest request;
  std::optional<double> damping_ratio;
  std::string plot;
  bool json = false, quiet = false, write = false;
};

/// The model file with the recommended values; comments and order are kept.
std::string with_recommended(std::string text, const Stiffening& found, const std::string& file) {
  for (const StiffenJoint& joint : found.joints) {
    if (joint.kept) continue;
    const auto put = [&](const char* key, double value, const char* unit) {
      text = with_value(text, file, {"joint", joint.name, key}, fmt::format("\"{:.6g} {}\"", value, unit));
    };
    put("stiffness", joint.stiffness, "N/m");
    put("damping", joint.damping, "N*s/m");
    if (joint.angular_stiffness <= 0) continue;
    put("angular_stiffness", joint.angular_stiffness, "N*m/rad");
    put("angular_damping", joint.angular_damping, "N*m*s/rad");
  }
  return text;
}

ExitCode stiffen_model(StiffenOptions& options) {
  const auto [text, model, files] = read_model_to_run(options);
  options.request.damping_ratio = options.damping_ratio;
  catch_interrupts();
  ProgressReport report(progress_style(options.quiet));
  const Stiffening found = with_file_name(options.model, [&, &start = model] { return stiffen(start, options.request, report.observer()); });
  report.clear();
  const std::string title = model.name.empty() ? options.model : model.name;
  const std::string plot = found.steps.empty() ? "none" : options.plot.empty() ? std::filesystem::path(options.model).stem().string() + "-stiffen.svg" : options.plot;
  if (plot != "none") write_file(plot, to_svg(stiffen_plot(found, title)));
  if (options.json) print_out(stiffen_json(found, model.name, options.model));
  else if (!options.quiet) print_out(stiffen_text(found, title, wants_colour(STDOUT_FILENO)) + (plot == "none" ? "" : "\nPlot: " + plot + "\n"));
  if (options.write && found.found) {
    write_file(options.model, with_recommended(text, found, options.model));
    if (!options.json && !options.quiet) print_out("Written to " + options.model + "\n");
  }
  if (found.reason == "interrupted") return kStoppedBySignal;
  return found.found ? kOk : kToleranceMissed;
}

}  // namespace

void add_stiffen(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("stiffen", "Find the stiffness at which joint forces no longer change, and their limit");
  const auto options = std::make_shared<StiffenOptions>();
  StiffenRequest& request = options->request;
  add_model_options(*verb, *options);
  verb->add_option("--digits", request.digits, "significant figures that must agree")->check(CLI::Range(1, 8))->capture_default_str();
  verb->add_flag("--motion-only", request.motion_only, "compare coordinates instead of joint forces; starts from 1e5 N/m");
  verb->add_option("--joint", request.joints, "count the force at this joint only (repeatable)")->type_name("NAME")->allow_extra_args(false);
  verb->add_option("--damping", request.damping, "damping of every joint [N*s/m]")->check(CLI::NonNegativeNumber)->capture_default_str();
  verb->add_option("--damping-ratio", options->damping_ratio, "fraction of critical damping, instead of --damping")->check(CLI::Range(0.0, 10.0));
  verb->add_option("--from", request.first, "stiffness to start from [N/m] (default: 1e6, or 1e5 with --motion-only)")->check(CLI::PositiveNumber);
  verb->add_option("--to", request.last, "stiffness to give up at [N/m]")->check(CLI::PositiveNumber)->capture_default_str();
  verb->add_flag("--write", options->write, "put the recommended values into the model file");
  verb->add_option("--plot", options->plot, "picture to write (default: <name of the model file>-stiffen.svg; none: no picture)")->type_name("FILE.svg")->check(svg_or_none_problem, "", "");
  verb->add_flag("--json", options->json, "print the result as JSON");
  verb->add_flag("-q,--quiet", options->quiet, "print nothing but errors");
  verb->footer(std::string(kStiffenFooter) + kExitCodeHelp);
  verb->callback([options, &exit_code] { exit_code = stiffen_model(*options); });
}

}  // namespace pintle::cli

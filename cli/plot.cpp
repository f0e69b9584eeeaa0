// pintle plot: joint forces and other columns of a run as SVG.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/verbs.h"
#include "results/disk.h"
#include "results/run_plot.h"

namespace pintle::cli {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  pintle plot four_bar-run --joint O4\n"
    "  pintle plot four_bar-run --joint O2 --joint O4 --components magnitude --out forces.svg\n"
    "  pintle plot four_bar-run --column body.rocker.angle --column body.rocker.spin --x joint.O2.angle\n"
    "\n"
    "Columns of different units stand in panels one above the other. The head of series.csv lists all columns.\n";

struct PlotOptions {
  std::string run, out;
  PlotRequest request;
};

std::filesystem::path plot_file(const PlotOptions& options) {
  if (!options.out.empty()) return options.out;
  std::filesystem::path folder = std::filesystem::absolute(options.run).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  std::string name = folder.filename().string();
  for (const std::string& joint : options.request.joints) name += "-" + joint;
  if (options.request.joints.empty()) name += "-" + options.request.columns.front();
  return name + ".svg";
}

ExitCode plot(const PlotOptions& options) {
  const RunRecord run = read_run(options.run);
  std::string svg;
  try {
    svg = to_svg(make_plot(run, options.request));
  } catch (const PlotRequestError& error) {
    print_error(fmt::format("pintle plot: {}\n", error.what()));
    return kCommandLineError;
  }
  if (options.out == "-") {
    print_out(svg);
    return kOk;
  }
  const std::filesystem::path file = plot_file(options);
  write_file(file, svg);
  print_out(file.string() + "\n");
  return kOk;
}

}  // namespace

void add_plot(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("plot", "Draw joint forces and other columns of a run as SVG");
  const auto options = std::make_shared<PlotOptions>();
  PlotRequest& request = options->request;
  verb->add_option("RUN", options->run, "run folder")->required();
  verb->add_option("--joint", request.joints, "force at this joint (repeatable)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb->add_option("--components", request.components, "which: x, y, magnitude (world axes), 1, 2 (joint axes), moment")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  verb->add_option("--on", request.on, "the body that feels the force (default: the joint's second)")
      ->type_name("BODY");
  verb->add_option("--column", request.columns, "any column of series.csv (repeatable)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb->add_option("--x", request.x, "column along the horizontal axis")->type_name("COLUMN")->capture_default_str();
  verb->add_option("--title", request.title, "title of the plot")->type_name("TEXT");
  verb->add_option("-o,--out", options->out, "file to write, - for standard output (default: <run>-<what>.svg)")
      ->type_name("FILE");
  verb->footer(kFooter);
  verb->callback([options, &exit_code] { exit_code = plot(*options); });
}

}  // namespace pintle::cli

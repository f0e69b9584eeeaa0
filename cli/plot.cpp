// pintle plot: joint forces and other columns of runs, as SVG or PNG.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/run_sources.h"
#include "cli/verbs.h"
#include "results/disk.h"
#include "results/plots/run_plot.h"
#include "results/plots/run_polar.h"

namespace pintle::cli {
namespace {

constexpr const char* kPlotFooter =
    "Examples:\n"
    "  pintle plot four_bar-run\n"
    "  pintle plot four_bar-run --joint O4\n"
    "  pintle plot four_bar-run --joint O2 --joint O4 --components magnitude --out forces.svg\n"
    "  pintle plot four_bar-run --column body.rocker.angle --column body.rocker.spin --x joint.O2.angle\n"
    "  pintle plot four_bar-run --with softer-run --joint O4 --components magnitude\n"
    "  pintle plot four_bar-run --joint O4 --out O4.png --width 500 --dpi 300\n"
    "  pintle plot four_bar-run --polar A\n"
    "  pintle plot worn-run --orbit B\n"
    "  pintle plot worn-run --wear B\n"
    "  pintle plot worn-run --x joint.B.contact_angle --column joint.B.penetration --every 0.012 --from 1.2\n"
    "\n"
    "Without --joint and --column: the magnitude of the force in every joint, or in the seven most loaded.\n"
    "Columns with different units are drawn in stacked panels. The first row of series.csv lists all columns.\n";

struct PlotOptions {
  std::string run, out, polar, orbit, wear;
  std::vector<std::string> others;
  PlotRequest request;
  double width = 0, dots_per_inch = 192;

  bool png() const { return out.ends_with(".png"); }
  /// Number of requested pictures of a pin: polar diagrams, the orbit, wear.
  int pictures_of_pins() const { return !polar.empty() + !orbit.empty() + !wear.empty(); }
  /// Devices and pipes have no extension.
  bool drawable() const {
    const auto type = std::filesystem::status(out).type();
    const bool replaced = type == std::filesystem::file_type::regular || type == std::filesystem::file_type::not_found;
    return out.empty() || out == "-" || png() || out.ends_with(".svg") || !replaced;
  }
};

std::filesystem::path plot_file(const PlotOptions& options) {
  if (!options.out.empty()) return options.out;
  std::string name = folder_name(options.run);
  if (!options.polar.empty()) name += "-" + options.polar + "-polar";
  if (!options.orbit.empty()) name += "-" + options.orbit + "-orbit";
  if (!options.wear.empty()) name += "-" + options.wear + "-wear";
  for (const std::string& joint : options.request.joints) name += "-" + joint;
  if (options.request.joints.empty() && !options.request.columns.empty()) name += "-" + options.request.columns.front();
  for (const std::string& other : options.others) name += "-with-" + folder_name(other);
  return name + ".svg";
}

Plot plot_of_other(const std::string& run, const PlotRequest& request) {
  try {
    return make_plot(read_run(run), request);
  } catch (const PlotRequestError& error) {
    throw PlotRequestError(fmt::format("{}: {}", run, error.what()));
  }
}

/// Shortens names to the folders if that distinguishes the runs.
template <class Named>
void shorten_names(std::vector<Named>& plots) {
  std::set<std::string> names;
  for (const Named& one : plots) names.insert(folder_name(one.name));
  if (names.size() < plots.size()) return;
  for (Named& one : plots) one.name = folder_name(one.name);
}

std::string line_picture(const PlotOptions& options, const RunRecord& run) {
  Plot made = make_plot(run, options.request);
  if (!options.others.empty()) {
    std::vector<NamedPlot> plots{{options.run, std::move(made)}};
    for (const std::string& other : options.others) plots.push_back({other, plot_of_other(other, options.request)});
    shorten_names(plots);
    made = overlay(plots);
  }
  if (options.width > 0) made.width = options.width;
  return to_svg(made);
}

std::string polar_picture(const PlotOptions& options, const RunRecord& run) {
  if (!options.request.joints.empty() || !options.request.columns.empty() || options.pictures_of_pins() > 1)
    throw PlotRequestError("--polar, --orbit and --wear are pictures of their own, and take no --joint or --column.\n    Call pintle plot twice.");
  std::vector<RunRecord> records;
  for (const std::string& other : options.others) records.push_back(read_run(other));
  std::vector<PolarRun> runs{{options.run, &run}};
  for (std::size_t i = 0; i < records.size(); ++i) runs.push_back({options.others[i], &records[i]});
  shorten_names(runs);
  PolarPlot made = !options.polar.empty() ? make_polar_plot(runs, options.polar) : !options.orbit.empty() ? make_orbit_plot(runs, options.orbit) : make_wear_plot(runs, options.wear);
  if (!options.request.title.empty()) made.title = options.request.title;
  if (options.width > 0) made.width = options.width;
  return to_svg(made);
}

ExitCode plot(const PlotOptions& options, const WritePng& write_png) {
  if (!options.drawable()) {
    print_error(fmt::format("pintle plot: found --out \"{}\": it must end in .svg or .png, or be - for SVG on standard output.\n", options.out));
    return kCommandLineError;
  }
  if (options.png() && !write_png)
    throw FileError(options.out + ": PNG needs pintle-pictures, which was built without librsvg or is not next to pintle.\n    Install librsvg2-dev and build again, or choose .svg.");
  const RunRecord run = read_run(options.run);
  std::string picture;
  try {
    picture = options.pictures_of_pins() == 0 ? line_picture(options, run) : polar_picture(options, run);
  } catch (const PlotRequestError& error) {
    print_error(fmt::format("pintle plot: {}\n", error.what()));
    return kCommandLineError;
  }
  if (options.png()) picture = write_png(picture, options.dots_per_inch);
  if (options.out == "-") {
    print_out(picture);
    return kOk;
  }
  const std::filesystem::path file = plot_file(options);
  write_file(file, picture);
  print_out(file.string() + "\n");
  return kOk;
}

}  // namespace

void add_plot(CLI::App& app, int& exit_code, const WritePng& write_png) {
  CLI::App* verb = app.add_subcommand("plot", "Draw joint forces and other columns of a run as SVG or PNG");
  const auto options = std::make_shared<PlotOptions>();
  PlotRequest& request = options->request;
  verb->add_option("RUN", options->run, "run folder")->required();
  verb->add_option("--joint", request.joints, "force at this joint (repeatable)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb->add_option("--components", request.components, "components: x, y, magnitude (world axes), 1, 2 (joint axes), moment")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  verb->add_option("--on", request.on, "the body the force acts on (default: the joint's second)")
      ->type_name("BODY");
  verb->add_option("--column", request.columns, "any column of series.csv (repeatable)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb->add_option("--polar", options->polar, "polar load diagrams of this revolute joint: in world axes, and in those of its marker on either body")->type_name("NAME");
  verb->add_option("--orbit", options->orbit, "where the pin of this revolute joint, which has clearance, a film or a bearing, goes in its bush")->type_name("NAME");
  verb->add_option("--wear", options->wear, "what the pin of this revolute joint, which has clearance, and its bush rub off each other, by directions around them")->type_name("NAME");
  verb->add_option("--with", options->others, "add another run to the plot (repeatable)")->type_name("RUN")->allow_extra_args(false);
  verb->add_option("--x", request.x, "column on the horizontal axis")->type_name("COLUMN")->capture_default_str();
  verb->add_option("--every", request.every, "a Poincare section: dots at times so far apart, the period of a motor")->type_name("SECONDS");
  verb->add_option("--from", request.from, "the first of these times: later than what the start leaves behind")->type_name("SECONDS")->capture_default_str();
  verb->add_option("--title", request.title, "title of the plot")->type_name("TEXT");
  verb->add_option("-o,--out", options->out, "file to write, .svg or .png, - for SVG on standard output (default: <run>-<what>.svg)")
      ->type_name("FILE");
  verb->add_option("--width", options->width, "width of the picture, at 96 pixels per inch (default: 760)")->type_name("PIXELS")->check(CLI::Range(200.0, 10000.0));
  verb->add_option("--dpi", options->dots_per_inch, "dots per inch of a PNG")->type_name("DOTS")->check(CLI::Range(36.0, 1200.0))->capture_default_str();
  verb->footer(kPlotFooter);
  verb->callback([options, &exit_code, write_png] { exit_code = plot(*options, write_png); });
}

}  // namespace pintle::cli

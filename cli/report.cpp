// pintle report: a run as one HTML page.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/run_sources.h"
#include "cli/verbs.h"
#include "pintle/report.h"
#include "results/disk.h"

namespace pintle::cli {
namespace {

constexpr const char* kReportFooter =
    "Examples:\n"
    "  pintle report four_bar-run\n"
    "  pintle report four_bar-run --out four-bar.html\n"
    "\n"
    "The page is self-contained: no network, no other file. It shows the moving mechanism with the force at every joint,\n"
    "linked plots, peak forces with their error estimates, the energy account and the assumptions. It can be printed.\n";

struct Options {
  std::string run, out;
  bool force = false;
};

ExitCode report(const Options& options) {
  const std::filesystem::path file = picture_file(options.out == "-" ? "" : options.out, options.run, ".html");
  if (options.out != "-") check_replaceable(file, ": Pintle report</title>", options.force);
  const DrawnRun drawn = read_drawn_run(options.run);
  const std::string html = report_html(drawn.model, drawn.run);
  if (options.out == "-") {
    print_out(html);
    return kOk;
  }
  write_file(file, html);
  print_out(file.string() + "\n");
  return kOk;
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("report", "Make one HTML page of a run: moving mechanism, forces, plots, tables");
  const auto options = std::make_shared<Options>();
  verb->add_option("RUN", options->run, "run folder")->required();
  verb->add_option("-o,--out", options->out, "file to write, - for standard output (default: <run>.html)")->type_name("FILE");
  verb->add_flag("--force", options->force, "replace a file that is not an earlier report");
  verb->footer(kReportFooter);
  verb->callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace pintle::cli

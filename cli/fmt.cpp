// pintle fmt: tidies the layout of TOML model files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/verbs.h"
#include "io/document.h"
#include "io/writers.h"
#include "results/disk.h"

namespace pintle::cli {
namespace {

constexpr const char* kFmtFooter =
    "Examples:\n"
    "  pintle fmt four_bar.toml            # rewrites the file if its layout needs changes\n"
    "  pintle fmt --check mechanisms/*.toml # exit code 3 if any is not; changes nothing\n"
    "\n"
    "Spacing, indentation and blank lines change; comments, the order of keys and every value stay as written.\n";

struct FmtOptions {
  std::vector<std::string> models;
  bool check = false, to_stdout = false;
};

ExitCode format_files(const FmtOptions& options) {
  ExitCode code = kOk;
  for (const std::string& model : options.models) {
    const std::string text = read_file(model, kMaxFileBytes + 1);
    const std::string formatted = format_toml(text, model);
    if (options.to_stdout) {
      print_out(formatted);
    } else if (formatted != text && options.check) {
      print_error(fmt::format("{}: its layout needs changes.\n    Try pintle fmt {}.\n", model, model));
      code = kModelError;
    } else if (formatted != text) {
      write_file(model, formatted);
    }
  }
  return code;
}

}  // namespace

void add_fmt(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("fmt", "Format TOML model files");
  const auto options = std::make_shared<FmtOptions>();
  verb->add_option("MODEL", options->models, "model files (.toml)")->required();
  CLI::Option* check = verb->add_flag("--check", options->check, "report needed changes without making them");
  verb->add_flag("--stdout", options->to_stdout, "print the result and leave the file alone")->excludes(check);
  verb->footer(kFmtFooter);
  verb->callback([options, &exit_code] { exit_code = format_files(*options); });
}

}  // namespace pintle::cli

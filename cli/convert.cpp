// pintle convert: TOML <-> JSON, the same tree.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/run_sources.h"
#include "cli/verbs.h"
#include "io/document.h"
#include "io/writers.h"
#include "results/disk.h"

namespace pintle::cli {
namespace {

constexpr const char* kConvertFooter =
    "Examples:\n"
    "  pintle convert four_bar.toml --out four_bar.json\n"
    "  pintle convert four_bar.json --to toml\n"
    "\n"
    "Names, values, units and expressions are preserved; JSON cannot hold comments.\n";

struct ConvertOptions {
  std::string model, to, out;
  bool force = false;
};

bool is_json(const std::filesystem::path& path) {
  return path.extension() == ".json";
}

/// As --to says, else by the extension of --out, else the format that the model does not have.
bool wants_json(const ConvertOptions& options) {
  if (!options.to.empty()) return options.to == "json";
  return options.out.empty() ? !is_json(options.model) : is_json(options.out);
}

void convert(const ConvertOptions& options) {
  if (!options.out.empty()) check_replaceable(options.out, {}, options.force);
  const Document document = parse_document(read_file(options.model, kMaxFileBytes + 1), options.model);
  const std::string text = wants_json(options) ? to_json(document) : to_toml(document);
  options.out.empty() ? print_out(text) : write_file(options.out, text);
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("convert", "Convert a model file between TOML and JSON");
  const auto options = std::make_shared<ConvertOptions>();
  verb->add_option("MODEL", options->model, "model file (.toml or .json)")->required();
  verb->add_option("--to", options->to, "output format (default: from the extension of --out, else the other one)")
      ->check(CLI::IsMember({"toml", "json"}))
      ->type_name("toml|json");
  verb->add_option("-o,--out", options->out, "file to write (default: standard output)")->type_name("FILE");
  verb->add_flag("--force", options->force, "replace a file that is there");
  verb->footer(kConvertFooter);
  verb->callback([options, &exit_code] {
    convert(*options);
    exit_code = kOk;
  });
}

}  // namespace pintle::cli

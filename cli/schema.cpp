// pintle schema: the model format, for editors and for people.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/run_sources.h"
#include "cli/verbs.h"
#include "io/writers.h"
#include "results/disk.h"

namespace pintle::cli {
namespace {

constexpr const char* kSchemaFooter =
    "Examples:\n"
    "  pintle schema --out pintle.schema.json     # then, as the first line of a model:  #:schema ./pintle.schema.json\n"
    "  pintle schema --reference | less\n";

struct SchemaOptions {
  bool reference = false, force = false;
  std::string out;
};

}  // namespace

void add_schema(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("schema", "Print the JSON Schema of model files, or their reference page");
  const auto options = std::make_shared<SchemaOptions>();
  verb->add_flag("--reference", options->reference, "the reference page, in Markdown");
  verb->add_option("-o,--out", options->out, "file to write (default: standard output)")->type_name("FILE");
  verb->add_flag("--force", options->force, "replace a file that is not an earlier schema or page");
  verb->footer(kSchemaFooter);
  verb->callback([options, &exit_code] {
    constexpr std::string_view kPage = "# Model file", kSchema = "\"title\": \"Pintle model file";
    if (!options->out.empty()) check_replaceable(options->out, options->reference ? kPage : kSchema, options->force);
    const std::string text = options->reference ? reference_markdown() : json_schema();
    options->out.empty() ? print_out(text) : write_file(options->out, text);
    exit_code = kOk;
  });
}

}  // namespace pintle::cli

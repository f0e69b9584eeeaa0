#include "cli/companions.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string_view>

#include "cli/console.h"
#include "cli/exit_codes.h"

namespace pintle::cli {
namespace {

struct Companion {
  const char *verb, *about, *program, *advice;
};

constexpr Companion kCompanions[] = {
    {"sweep", kSweepDescription, "pintle-sweep", "make build, which builds both"},
    {"film", kFilmDescription, "pintle-pictures", "make build, which builds both"},
    {"studio", kStudioDescription, "pintle-studio", "install libcpp-httplib-dev, build again, and install both"},
};

const char* companion_for(int argc, const char* const* argv) {
  const std::string_view verb = argc > 1 ? argv[1] : "";
  for (const Companion& companion : kCompanions)
    if (verb == companion.verb) return companion.program;
  if (verb == "plot")
    for (int i = 2; i < argc; ++i)
      if (std::string_view(argv[i]).ends_with(".png")) return "pintle-pictures";
  return nullptr;
}

}  // namespace

void become_companion(int argc, char** argv) {
  const char* const program = companion_for(argc, argv);
  if (!program) return;
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) ::execv((self.parent_path() / program).c_str(), argv);
  ::execvp(program, argv);
}

void add_companions(CLI::App& app, int& exit_code) {
  for (const Companion& companion : kCompanions) {
    CLI::App* verb = app.add_subcommand(companion.verb, companion.about);
    const std::string missing = fmt::format("pintle {} needs the program {}, which is neither next to pintle nor on the path.\n    try: {}\n", companion.verb, companion.program, companion.advice);
    verb->prefix_command();
    verb->footer(missing);  // also in its help
    verb->callback([&exit_code, missing] {
      print_error(missing);
      exit_code = kFileError;
    });
  }
}

}  // namespace pintle::cli

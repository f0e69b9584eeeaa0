#include "cli/companions.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "cli/console.h"
#include "cli/exit_codes.h"

namespace pintle::cli {
namespace {

constexpr std::array<std::string_view, 2> kVerbs{"sweep", "studio"};

std::string program_of(std::string_view verb) { return fmt::format("pintle-{}", verb); }

void add_companion(CLI::App& app, int& exit_code, const std::string& verb_name, const char* about, const char* advice) {
  CLI::App* verb = app.add_subcommand(verb_name, about);
  verb->prefix_command();
  verb->callback([&exit_code, verb_name, advice] {
    print_error(fmt::format("pintle {0} is the program {1}, which is neither beside pintle nor on the path.\n    try: {2}\n", verb_name, program_of(verb_name), advice));
    exit_code = kFileError;
  });
}

}  // namespace

void become_companion(int argc, char** argv) {
  if (argc < 2 || std::find(kVerbs.begin(), kVerbs.end(), argv[1]) == kVerbs.end()) return;
  const std::string program = program_of(argv[1]);
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) ::execv((self.parent_path() / program).c_str(), argv);
  ::execvp(program.c_str(), argv);
}

void add_sweep_program(CLI::App& app, int& exit_code) {
  add_companion(app, exit_code, "sweep", kSweepDescription, "build and install both");
}

void add_studio_program(CLI::App& app, int& exit_code) {
  add_companion(app, exit_code, "studio", "Draw, play and read mechanisms in the browser, with this folder's models", "install libcpp-httplib-dev, build again, and install both");
}

}  // namespace pintle::cli

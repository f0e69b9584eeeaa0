#include "cli/sweep_program.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string_view>

#include "cli/console.h"
#include "cli/exit_codes.h"

namespace pintle::cli {
namespace {

constexpr const char* kProgram = "pintle-sweep";

}  // namespace

bool wants_sweep(int argc, char** argv) { return argc > 1 && std::string_view(argv[1]) == "sweep"; }

void become_sweep_program(char** argv) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) ::execv((self.parent_path() / kProgram).c_str(), argv);
  ::execvp(kProgram, argv);
}

void add_sweep_program(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("sweep", kSweepDescription);
  verb->prefix_command();
  verb->callback([&exit_code] {
    print_error("pintle sweep is the program pintle-sweep, which is neither beside pintle nor on the path.\n    try: build and install both\n");
    exit_code = kFileError;
  });
}

}  // namespace pintle::cli

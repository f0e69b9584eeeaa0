#include "cli/sister_programs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string_view>

#include "cli/console.h"
#include "cli/exit_codes.h"

namespace pintle::cli {
namespace {

constexpr const char* kSweeps = "pintle-sweep";
constexpr const char* kPictures = "pintle-pictures";

void add(CLI::App& app, int& exit_code, const char* name, const char* about, const char* program) {
  CLI::App* verb = app.add_subcommand(name, about);
  verb->prefix_command();
  verb->callback([&exit_code, name, program] {
    print_error(fmt::format("pintle {} is the program {}, which is neither beside pintle nor on the path.\n    try: build and install both\n", name, program));
    exit_code = kFileError;
  });
}

}  // namespace

const char* sister_for(int argc, const char* const* argv) {
  const std::string_view verb = argc > 1 ? argv[1] : "";
  if (verb == "sweep") return kSweeps;
  if (verb == "film") return kPictures;
  if (verb == "plot")
    for (int i = 2; i < argc; ++i)
      if (std::string_view(argv[i]).ends_with(".png")) return kPictures;
  return nullptr;
}

void become(const char* program, char** argv) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) ::execv((self.parent_path() / program).c_str(), argv);
  ::execvp(program, argv);
}

void add_sister_programs(CLI::App& app, int& exit_code) {
  add(app, exit_code, "sweep", "Run a model with many sets of values, in a grid or by chance; peaks of every joint force", kSweeps);
  add(app, exit_code, "film", "Film a run as GIF or WebM, or draw one instant of it as SVG or PNG", kPictures);
}

}  // namespace pintle::cli

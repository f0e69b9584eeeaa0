// pintle version: identifies this program.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/verbs.h"

namespace pintle::cli {
namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __clang_version__;
#elif defined(__GNUC__)
constexpr const char* kCompiler = "gcc " __VERSION__;
#else
constexpr const char* kCompiler = "unknown compiler";
#endif

#ifdef NDEBUG
constexpr const char* kBuild = "optimised";
#else
constexpr const char* kBuild = "with assertions";
#endif

}  // namespace

void add_version(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("version", "Print the version, the compiler and the kind of build");
  verb->footer("Example:\n  pintle version\n");
  verb->callback([&exit_code] {
    print_out(fmt::format("pintle {}\nmodel format 1\nbuilt by {}, {}\n", PINTLE_VERSION, kCompiler, kBuild));
    exit_code = kOk;
  });
}

}  // namespace pintle::cli

#include "cli/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>

#include "base/freed_memory.h"
#include "cli/command_line.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "pintle/complaint.h"
#include "pintle/results.h"
#include "pintle/simulate.h"

namespace pintle::cli {
namespace {

constexpr const char* kAbout =
    "Planar mechanism dynamics: every joint is a force law, every joint force a result.";
constexpr const char* kProgramFooter =
    "Example:\n"
    "  pintle run mechanisms/four_bar.toml\n"
    "  pintle plot four_bar-run --joint O4 --out O4.svg\n"
    "\n"
    "Each verb has its own --help.\n";

ExitCode complain(const std::string& text, ExitCode code) {
  print_error(text.empty() || text.back() != '\n' ? text + "\n" : text);
  return code;
}

/// Parses the command line, which calls the verb.
int dispatch(CLI::App& app, int argc, char** argv, const int& exit_code) {
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return complain(explain(app, error), kCommandLineError);
  } catch (const InputError& error) {
    return complain(error.what(), kModelError);
  } catch (const AssemblyError& error) {
    return complain(error.what(), kAssemblyFailed);
  } catch (const FileError& error) {
    return complain(error.what(), kFileError);
  } catch (const std::bad_alloc&) {
    return complain("pintle: out of memory. A larger output_step gives fewer rows.", kInternalError);
  } catch (const std::exception& error) {
    return complain(fmt::format("pintle: internal error: {}. Please report it with the model file.", error.what()),
                    kInternalError);
  }
}

}  // namespace

int run_program(int argc, char** argv, std::initializer_list<AddVerb> verbs) {
  keep_freed_memory();
  remember_command_line(argc, argv);
  CLI::App app(kAbout, "pintle");
  app.footer(kProgramFooter);
  app.set_version_flag("--version", "pintle " PINTLE_VERSION);
  app.require_subcommand(1);
  int exit_code = kOk;
  for (const AddVerb add : verbs) add(app, exit_code);
  return dispatch(app, argc, argv, exit_code);
}

}  // namespace pintle::cli

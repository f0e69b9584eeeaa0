// pintle studio: the studio in the browser, with this folder's models and the native kernel.
#include "cli/studio/studio.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/companions.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/studio/web_server.h"
#include "pintle/results.h"
#include "results/disk.h"

namespace pintle::cli {
namespace fs = std::filesystem;
namespace {

constexpr int kUsualPort = 7463;
constexpr int kMorePorts = 9;  // tried after the given one, since browsers store a page's data by its port
constexpr const char* kFooter =
    "Examples:\n"
    "  pintle studio\n"
    "  pintle studio four_bar.toml --port 8000\n"
    "\n"
    "The studio reads and writes the model files of the folder it is started in, and nothing else. It accepts\n"
    "connections from this machine only. Ctrl-C stops it.\n";

struct StudioOptions {
  std::string model, pages;
  int port = kUsualPort;
  bool no_browser = false;
};

/// The built pages: those given, or those installed with this program, or those that make studio has built.
fs::path find_pages(const std::string& given) {
  std::error_code error;
  if (!given.empty()) {
    check_readable(fs::path(given) / "index.html");
    return given;
  }
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  for (const fs::path& pages : {self.parent_path().parent_path() / "share/pintle/studio", fs::path(PINTLE_STUDIO_PAGES)})
    if (fs::exists(pages / "index.html", error)) return pages;
  throw FileError("the studio's pages are not built\n    try: make studio");
}

/// The model's path below the folder; throws FileError if it is elsewhere.
std::string model_below(const fs::path& folder, const std::string& model) {
  if (model.empty()) return "";
  check_readable(model);
  const fs::path path = fs::canonical(model).lexically_relative(fs::canonical(folder));
  if (path.empty() || path.begin()->string() == "..")
    throw FileError(fmt::format("{} is not in this folder\n    try: start pintle studio in the folder of the model", model));
  return path.generic_string();
}

/// Asks the desktop to open `address`; does nothing if there is no desktop.
void show(const std::string& address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  const pid_t child = fork();
  if (child < 0) return;
  if (child == 0) {
    if (fork() == 0) execlp("xdg-open", "xdg-open", address.c_str(), static_cast<char*>(nullptr));
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

ExitCode run_studio(const StudioOptions& options) {
  const fs::path folder = fs::current_path();
  studio::RouterSettings settings{find_pages(options.pages), folder, model_below(folder, options.model), 0, studio::random_token(), studio::random_token()};
  WebServer server(options.port, options.port == kUsualPort ? kMorePorts : 0);
  settings.port = server.port();
  studio::RequestRouter router(settings);
  const std::string place = fmt::format("http://127.0.0.1:{}/", server.port());
  print_out(fmt::format("Pintle Studio: {}#token={}\nModels in {}; Ctrl-C stops it.\n", place, settings.token, folder.string()));
  catch_interrupts();
  if (!options.no_browser) show(place + "enter/" + settings.ticket);
  server.serve(router, [] { return !interrupted(); });
  return kOk;
}

}  // namespace

void add_studio(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("studio", kStudioDescription);
  const auto options = std::make_shared<StudioOptions>();
  verb->add_option("MODEL", options->model, "model file to open, in this folder");
  verb->add_option("--port", options->port, fmt::format("port on 127.0.0.1 (default: {}; if taken, one of the next {}, or any free one)", kUsualPort, kMorePorts))
      ->check(CLI::Range(0, 65535))
      ->type_name("N");
  verb->add_option("--pages", options->pages, "built studio to serve (default: the installed one, or build/studio)")->type_name("FOLDER");
  verb->add_flag("--no-browser", options->no_browser, "print the address only");
  verb->footer(kFooter);
  verb->callback([options, &exit_code] { exit_code = run_studio(*options); });
}

}  // namespace pintle::cli

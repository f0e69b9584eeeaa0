// pintle-pictures: the verbs that need a rasteriser.
#include "cli/pictures/film.h"
#include "cli/pictures/raster.h"
#include "cli/program.h"
#include "cli/verbs.h"

namespace {

void add_plot_with_png(CLI::App& app, int& exit_code) {
  using namespace pintle::cli;
  add_plot(app, exit_code, can_rasterise() ? WritePng(png_of) : WritePng());
}

}  // namespace

#ifdef PINTLE_SANITIZED
// Fontconfig, which librsvg uses, keeps its font data until the program ends.
extern "C" const char* __lsan_default_suppressions();  // NOLINT: the sanitizer asks for this name
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
#endif

int main(int argc, char** argv) { return pintle::cli::run_program(argc, argv, {add_plot_with_png, pintle::cli::add_film}); }

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

int main(int argc, char** argv) { return pintle::cli::run_program(argc, argv, {add_plot_with_png, pintle::cli::add_film}); }

#include "cli/pictures/raster.h"
#include "pintle/results.h"

namespace pintle::cli {
namespace {

[[noreturn]] void refuse() {
  throw FileError("pintle was built without librsvg, which PNG and films need.\n    Install librsvg2-dev and build again; SVG works without it.");
}

}  // namespace

bool can_rasterise() { return false; }
Pixels pixels_of(const std::string&, double) { refuse(); }
std::string png_of(const std::string&, double) { refuse(); }

}  // namespace pintle::cli

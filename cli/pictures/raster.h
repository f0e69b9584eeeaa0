// Converts SVG to pixels with librsvg.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pintle::cli {

bool can_rasterise();  ///< false: built without librsvg

/// Rows from the top, four bytes per pixel: blue, green, red, and one that is always 255.
struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> bytes;
};

/// `scale` is the number of pixels per unit of the SVG. Throws FileError.
Pixels pixels_of(const std::string& svg, double scale);

/// The bytes of a PNG file, which states its resolution; an inch is 96 units of the SVG. Throws FileError.
std::string png_of(const std::string& svg, double dots_per_inch);

}  // namespace pintle::cli

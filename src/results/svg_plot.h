// Line plots as SVG, fit for print: panels one above the other over a common x axis.
#pragma once

#include <string>
#include <vector>

namespace pintle {

/// One line. The label is plain text; `subscript` follows it lowered ("F" and "x").
struct Curve {
  std::string label, subscript;
  std::vector<double> y;  ///< one per x; a NaN interrupts the line
  std::vector<double> x{};  ///< in a panel with an x axis of its own
};

/// One set of axes; all its curves share the unit.
struct Panel {
  std::string quantity;  ///< "Force on rocker"
  std::string unit;      ///< "N"; may get a prefix
  std::vector<Curve> curves;
  std::string x_quantity{}, x_unit{};  ///< given: an x axis of its own, and every curve brings its x
  bool logarithmic = false;        ///< both axes, with such an x axis; every value is marked by a dot
};

struct Plot {
  std::string title, subtitle;
  std::string x_quantity, x_unit;
  std::vector<double> x;
  std::vector<Panel> panels;
  double width = 760;         ///< [px]
  double panel_height = 300;  ///< of the axes' frame [px]
};

/// The picture. On logarithmic axes values that are not positive are left out. Long series are thinned to what can be seen, every minimum and maximum kept.
std::string to_svg(const Plot& plot);

}  // namespace pintle

// Line plots as SVG, suitable for print: panels one above the other with a common x axis.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pintle {

/// A marked point of a line at its exact position, in addition to the line's own points.
struct Mark {
  double x = 0, y = 0;
  std::string title;  ///< "peak 674.08 N at 0.58945 s"; shown when the pointer is over the mark
};

/// One line. The label is plain text; `subscript` follows it as a subscript ("F" and "x").
struct Curve {
  std::string label, subscript;
  std::vector<double> y;  ///< one per x; a NaN interrupts the line
  bool dots = false;      ///< a dot at every point instead of a line ...
  bool joined = false;    ///< ... and the line as well
  std::vector<double> x{};  ///< x values of its own; if the panel's x axis is the plot's, may be empty: the plot's x
  double band = 0;          ///< half-width of a band around the line, an error [unit]
  int style = -1;           ///< colour (the first seven solid, then the same dashed), with a legend even for a single curve; -1: by index
  std::optional<Mark> mark{};
};

/// One set of axes; all its curves have the same unit.
struct Panel {
  std::string quantity;  ///< "Force on rocker"
  std::string unit;      ///< "N"; may get a prefix
  std::vector<Curve> curves;
  bool log_y = false;    ///< logarithmic; values that are not positive are left out
  std::string x_quantity{}, x_unit{};  ///< if given: an x axis of its own, and every curve has its own x
  bool log_x = false;    ///< for the panel's own x axis
};

struct Plot {
  std::string title, subtitle;
  std::string x_quantity, x_unit;
  std::vector<double> x;
  bool log_x = false;
  std::vector<Panel> panels;
  double width = 760;         ///< [px]
  double panel_height = 300;  ///< of the axes' frame [px]
};

/// The picture. Long series are thinned to what is visible; every minimum and maximum is kept.
std::string to_svg(const Plot& plot);

}  // namespace pintle

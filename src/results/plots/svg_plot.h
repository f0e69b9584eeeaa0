// Line plots as SVG, fit for print: panels one above the other over a common x axis.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pintle {

/// A point of a line that is marked, at its true place beside the points of the line.
struct Mark {
  double x = 0, y = 0;
  std::string title;  ///< "peak 674.08 N at 0.58945 s"; shown by the pointer
};

/// One line. The label is plain text; `subscript` follows it lowered ("F" and "x").
struct Curve {
  std::string label, subscript;
  std::vector<double> y;  ///< one per x; a NaN interrupts the line
  bool dots = false;      ///< a dot at every point instead of a line ...
  bool joined = false;    ///< ... and the line too
  std::vector<double> x{};  ///< of its own; in a panel whose x axis is the plot's it may be empty: the plot's x
  double band = 0;          ///< half the width of a band around the line, an error [unit]
  int style = -1;           ///< which colour (the first seven solid, then the same dashed), and named even when alone; -1: by its place
  std::optional<Mark> mark{};
};

/// One set of axes; all its curves share the unit.
struct Panel {
  std::string quantity;  ///< "Force on rocker"
  std::string unit;      ///< "N"; may get a prefix
  std::vector<Curve> curves;
  bool log_y = false;    ///< decades; what is not positive is left out
  std::string x_quantity{}, x_unit{};  ///< given: an x axis of its own, and every curve brings its x
  bool log_x = false;    ///< of the own x axis
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

/// The picture. Long series are thinned to what can be seen, every minimum and maximum kept.
std::string to_svg(const Plot& plot);

}  // namespace pintle

// Paths of a vector's tip as SVG: diagrams side by side over concentric rings, all to the same scale.
#pragma once

#include <string>
#include <vector>

namespace pintle {

/// One path, from row to row. The label is plain text.
struct PolarCurve {
  std::string label;
  std::vector<double> x, y;
};

struct PolarPanel {
  std::string title, axes;  ///< two lines: "Force on crank", "in the axes of its marker"
  std::vector<PolarCurve> curves;
  double limit = 0;  ///< radius of a circle that bounds the paths, drawn in bold; 0: none
};

/// The first point of each path is marked by a ring, the longest vector by a dot, whose values are in the line below the diagram.
struct PolarPlot {
  std::string title, subtitle;
  std::string unit;
  std::vector<PolarPanel> panels;
  double width = 960;  ///< [px]
};

std::string to_svg(const PolarPlot& plot);

}  // namespace pintle

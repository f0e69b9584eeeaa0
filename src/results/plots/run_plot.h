// From a run to a plot: choice and names of columns.
#pragma once

#include <string>
#include <vector>

#include "pintle/results.h"
#include "results/plots/run_columns.h"
#include "results/plots/svg_plot.h"

namespace pintle {

/// What the user asked to plot.
struct PlotRequest {
  std::vector<std::string> joints;  ///< forces at these joints ...
  std::vector<std::string> components{
      "x", "y", "magnitude"};        ///< ... these components: x, y, magnitude (world axes), 1, 2 (joint axes), moment
  std::string on;                    ///< ... on this body; empty: on each joint's second body
  std::vector<std::string> columns;  ///< these columns, unchanged
  std::string x = "t";               ///< column along the horizontal axis
  double every = 0;                  ///< a Poincare section: one dot per period of this length [s]; 0: lines through all rows
  double from = 0;                   ///< ... the first at this time [s]
  std::string title;                 ///< empty: made from the request
};

/// Curves with the same unit share a panel. If the request names no joints and columns: the force magnitudes of all joints, or of the most loaded ones.
/// Throws PlotRequestError.
Plot make_plot(const RunRecord& run, const PlotRequest& request);

struct NamedPlot {
  std::string name;  ///< of the run
  Plot plot;
};

/// The same request for several runs in one plot: corresponding curves have the same colour, each further run has other dashes.
Plot overlay(const std::vector<NamedPlot>& plots);

}  // namespace pintle

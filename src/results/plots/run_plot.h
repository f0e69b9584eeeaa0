// From a run to a plot: which columns, how they are called.
#pragma once

#include <string>
#include <vector>

#include "pintle/results.h"
#include "results/plots/run_columns.h"
#include "results/plots/svg_plot.h"

namespace pintle {

/// What the user asked to see.
struct PlotRequest {
  std::vector<std::string> joints;  ///< forces at these joints ...
  std::vector<std::string> components{
      "x", "y", "magnitude"};        ///< ... of these: x, y, magnitude (world axes), 1, 2 (joint axes), moment
  std::string on;                    ///< ... on this body; empty: on each joint's second
  std::vector<std::string> columns;  ///< these columns as they are
  std::string x = "t";               ///< column along the horizontal axis
  double every = 0;                  ///< a Poincare section: a dot for each of these periods [s]; 0: lines through all rows
  double from = 0;                   ///< ... the first at this time [s]
  std::string title;                 ///< empty: made from the request
};

/// Curves of one unit share a panel. Of a request without joints and columns: the force magnitudes of all joints, or of the most loaded ones.
/// Throws PlotRequestError.
Plot make_plot(const RunRecord& run, const PlotRequest& request);

struct NamedPlot {
  std::string name;  ///< of the run
  Plot plot;
};

/// The same request of several runs in one plot: what is alike has one colour, each further run other dashes.
Plot overlay(const std::vector<NamedPlot>& plots);

}  // namespace pintle

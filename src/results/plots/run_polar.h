// From runs to the polar load diagram of a pin, to the diagram of its wear, and to its orbit in the bush.
#pragma once

#include <string>
#include <vector>

#include "pintle/results.h"
#include "results/plots/polar_plot.h"
#include "results/plots/run_columns.h"

namespace pintle {

/// A run and its name in comparisons.
struct PolarRun {
  std::string name;
  const RunRecord* run = nullptr;
};

/// The force of a revolute joint on its second body in world axes, on its first body in the axes of its marker there, and on its second body
/// in the axes of its marker there; each run gives one path. The bodies are those of the first run. Throws PlotRequestError.
PolarPlot make_polar_plot(const std::vector<PolarRun>& runs, const std::string& joint);

/// The path of a revolute joint's pin in its bush, if no springs hold the pin, in the axes of the bush's marker and in those of the pin's; with the
/// radial clearance as a circle if the law reports it. Throws PlotRequestError.
PolarPlot make_orbit_plot(const std::vector<PolarRun>& runs, const std::string& joint);
/// Whether a joint has such a plot.
bool has_orbit(const Trajectory& run, const std::string& joint);

/// The material that the pin of this joint, which has clearance, and its bush have worn off each other, by direction in the axes of their markers. Throws
/// PlotRequestError.
PolarPlot make_wear_plot(const std::vector<PolarRun>& runs, const std::string& joint);

}  // namespace pintle

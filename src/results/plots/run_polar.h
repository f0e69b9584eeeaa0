// From runs to the polar load diagram of a pin, to that of its wear, and to its orbit in the bush.
#pragma once

#include <string>
#include <vector>

#include "pintle/results.h"
#include "results/plots/polar_plot.h"
#include "results/plots/run_columns.h"

namespace pintle {

/// A run and what it is called beside others.
struct PolarRun {
  std::string name;
  const RunRecord* run = nullptr;
};

/// The force of a revolute joint on its second body in world axes, on its first body in the axes of the marker there, and on its second body
/// in the axes of the marker there; each run is a path. The bodies are those of the first run. Throws PlotRequestError.
PolarPlot make_polar_plot(const std::vector<PolarRun>& runs, const std::string& joint);

/// Where the pin of a revolute joint that is not held by springs goes in its bush, in the axes of the bush's marker and in those of the pin's; with the
/// radial clearance as a circle, of laws that tell it. Throws PlotRequestError.
PolarPlot make_orbit_plot(const std::vector<PolarRun>& runs, const std::string& joint);
/// Whether there is such a plot of a joint.
bool has_orbit(const Trajectory& run, const std::string& joint);

/// What the pin of this joint, which has clearance, and its bush have rubbed off each other, by directions in the axes of their markers. Throws
/// PlotRequestError.
PolarPlot make_wear_plot(const std::vector<PolarRun>& runs, const std::string& joint);

}  // namespace pintle

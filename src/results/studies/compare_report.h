// A comparison of two runs as text, as JSON and as a picture.
#pragma once

#include <string>

#include "pintle/compare.h"
#include "results/plots/svg_plot.h"

namespace pintle {

/// "ideal joints", "relative coordinates".
std::string to_text(Equations equations);

/// Tables for the console; `colour` adds terminal escapes.
std::string compare_text(const Comparison& comparison, const std::string& title, bool colour = false);

/// Everything except the series, as one object.
std::string compare_json(const Comparison& comparison, const std::string& model_name, const std::string& model_path);

/// Both runs' forces at the joints that differ most, and the difference.
Plot compare_plot(const Comparison& comparison, const std::string& title);

/// Several runs side by side: a table of runs, and a table of joints with changes in percent of the first run.
std::string variants_text(const Variants& variants, bool colour = false);

/// Everything except the series, as one object. `model_paths` has one entry per run.
std::string variants_json(const Variants& variants, const std::vector<std::string>& model_paths);

/// The forces of all runs at the joints whose peaks differ most.
Plot variants_plot(const Variants& variants, const std::string& title);

}  // namespace pintle

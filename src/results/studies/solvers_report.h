// The comparison of the integration methods as text, as JSON and as a picture.
#pragma once

#include <string>

#include "pintle/solvers.h"
#include "results/plots/svg_plot.h"

namespace pintle {

/// Tables for the console; `colour` adds terminal escapes.
std::string solvers_text(const SolverStudy& study, const std::string& title, bool colour = false);

/// Everything as JSON, one object.
std::string solvers_json(const SolverStudy& study, const std::string& model_name, const std::string& model_path);

/// Joint-force error against wall time and against evaluations, all axes logarithmic, one curve per method.
Plot solvers_plot(const SolverStudy& study, const std::string& title);

/// "completed", "stopped", "failed" or "interrupted".
std::string to_text(SolverEnd end);

}  // namespace pintle

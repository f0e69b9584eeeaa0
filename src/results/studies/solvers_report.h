// The comparison of the integration methods, for people, for programs and as a picture.
#pragma once

#include <string>

#include "pintle/solvers.h"
#include "results/plots/svg_plot.h"

namespace pintle {

/// Tables for the console; `colour` adds terminal escapes.
std::string solvers_text(const SolverStudy& study, const std::string& title, bool colour = false);

/// Everything as JSON, one object.
std::string solvers_json(const SolverStudy& study, const std::string& model_name, const std::string& model_path);

/// Joint-force error over wall time and over evaluations, both axes logarithmic, a curve for each method.
Plot solvers_plot(const SolverStudy& study, const std::string& title);

/// "completed", "stopped", "failed" or "interrupted".
std::string to_text(SolverEnd end);

}  // namespace pintle

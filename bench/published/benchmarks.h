// Published benchmark problems: each is run, and measured as in its source.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle::published {

/// One measure of one run.
struct Row {
  std::string problem, joints, measure;
  double tolerance = 0, error = 0;
  std::uint64_t steps = 0;
  double seconds = 0;
  bool digits = false;  ///< `error` is a number of digits, at least `tolerance`; else an error, at most that
  bool judged = true;   ///< false: joints softer than the problem's, so that a miss is due to them
  bool passes() const { return digits ? error >= tolerance : error <= tolerance; }
};

struct Report {
  std::vector<Row> rows;
  std::vector<std::string> skipped;
  std::vector<std::string> pages;  ///< longer tables, as text
};

void measure_a01(Report& report);
void measure_a02(Report& report);
void measure_a03(Report& report);
void measure_ivp_andrews(Report& report);

/// bench/published/<name>.json
nlohmann::json read_facts(const std::string& name);
/// A model from mechanisms/ or, if the name contains a slash, from the source tree.
Model model_of(const std::string& name, const std::vector<std::string>& overrides = {});
void set_joints(Model& model, double stiffness, double damping);

/// simulate(), with multipliers if `ideal` and the model chooses no other way to enforce constraints; false, with a line in the report, if they are not available.
bool run(Model model, bool ideal, Report& report, Trajectory& out);

/// "k = 1e10" or "ideal".
std::string joints_text(double stiffness, bool ideal);

double value(const Trajectory& run, std::size_t row, const std::string& column);
/// Row of time t, or -1.
long row_at(const Trajectory& run, double t);
/// Largest change of kinetic and potential energy minus the energy supplied by motors; energy lost in dampers counts as an error [J].
double energy_error(const Trajectory& run);
/// Largest |x|, |y| difference of a point from rows (t, x, y) of a table up to `until`; the point is offset + scale * column.
double point_error(const Trajectory& run, const nlohmann::json& rows, const std::string& body, double scale, double until);

}  // namespace pintle::published

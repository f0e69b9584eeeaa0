// The columns of a run that plots need, and the messages if they are missing.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// A request that the run cannot satisfy: no such joint, column or component; with a suggestion of what was probably meant.
class PlotRequestError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "Did you mean ...?", or the list of all words.
std::string hint_of(const std::string& word, const std::vector<std::string>& words, std::string_view list_name);

/// Throws PlotRequestError if the run has no such column or joint.
int find_column(const Trajectory& trajectory, const std::string& name);
const LoadSummary& find_joint(const Trajectory& trajectory, const std::string& name);

std::vector<double> values_of(const Trajectory& trajectory, int column);
/// Fraction of a peak at which a picture shows it: an arrow of 200 pixels is then at most two pixels short.
inline constexpr double kSeenByArrow = 0.99;
/// States what a picture of the rows misses of a joint's force: "between the rows joint O reaches 28077 N". Empty if a row reaches the fraction `seen` of the
/// peak, and if the run did not record the force.
std::string peak_between_rows(const Trajectory& trajectory, const LoadSummary& joint, double seen = kSeenByArrow);

/// sqrt(x^2 + y^2), row by row.
std::vector<double> magnitude(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace pintle

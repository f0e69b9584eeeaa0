// The columns of a run that plots are made of, and what is said where there are none.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// A request that the run cannot meet: no such joint, column or component; with what was probably meant.
class PlotRequestError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "Did you mean ...?", or the list of all words.
std::string hint_of(const std::string& word, const std::vector<std::string>& words, std::string_view list_name);

/// Throws PlotRequestError where the run has no such column, or no such joint.
int find_column(const Trajectory& trajectory, const std::string& name);
const LoadSummary& find_joint(const Trajectory& trajectory, const std::string& name);

std::vector<double> values_of(const Trajectory& trajectory, int column);
/// Of a peak: what an arrow of 200 pixels shows of it but for two.
inline constexpr double kSeenByArrow = 0.99;
/// What a picture of the rows does not show of a joint's force: "between the rows joint O reaches 28077 N". Empty where a row has `seen` of the peak, and where
/// the run did not record the force.
std::string peak_between_rows(const Trajectory& trajectory, const LoadSummary& joint, double seen = kSeenByArrow);

/// sqrt(x^2 + y^2), row by row.
std::vector<double> magnitude(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace pintle

// The bearings of a run for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// Numbers about bearings in the units of a designer. A value that cannot be had is not a number.
struct BearingTable {
  struct Head {
    std::string text, unit;
    bool estimate = false;  ///< an error: two digits will do
  };
  struct Row {
    std::string joint;
    std::vector<double> values;
  };
  std::string title;
  std::vector<Head> heads;  ///< of the values
  std::vector<Row> rows;
};

/// The duty of each pin; life and static safety; pressure and sliding; depth of wear. Those without rows are left out.
std::vector<BearingTable> bearing_tables(const std::vector<BearingSummary>& bearings);

/// What pins with clearance and their bushes rub off each other, and in which direction most.
BearingTable wear_table(const std::vector<JointWear>& wear);
/// For the console, beginning with an empty line; nothing where there is no wear.
std::string wear_text(const std::vector<JointWear>& wear, const std::string& bold = "", const std::string& plain = "");

/// "joint B: state ...", once for each size that is missing and each remark.
std::vector<std::string> bearing_notes(const std::vector<BearingSummary>& bearings);

/// Both for the console, beginning with an empty line; nothing where there are no bearings. Heads of tables stand between `bold` and `plain`.
std::string bearing_text(const std::vector<BearingSummary>& bearings, const std::string& bold = "", const std::string& plain = "");

/// The list that stands under "bearings" in summary.json, in an object of its own.
std::string bearing_json(const std::vector<BearingSummary>& bearings);

}  // namespace pintle

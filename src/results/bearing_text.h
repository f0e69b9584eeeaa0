// The bearings of a run, formatted for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// Numbers about bearings in a designer's units. Values that are not available are NaN.
struct BearingTable {
  struct Head {
    std::string text, unit;
    bool estimate = false;  ///< an error estimate: two digits suffice
  };
  struct Row {
    std::string joint;
    std::vector<double> values;
  };
  std::string title;
  std::vector<Head> heads;  ///< of the value columns
  std::vector<Row> rows;
};

/// The duty of each pin; life and static safety; pressure and sliding; depth of wear. Tables without rows are omitted.
std::vector<BearingTable> bearing_tables(const std::vector<BearingSummary>& bearings);

/// Material that pins with clearance and their bushes wear off each other, and the direction of most wear.
BearingTable wear_table(const std::vector<JointWear>& wear);
/// For the console, starting with an empty line; empty if there is no wear.
std::string wear_text(const std::vector<JointWear>& wear, const std::string& bold = "", const std::string& plain = "");

/// "joint B: state ...", one for each missing dimension and each remark.
std::vector<std::string> bearing_notes(const std::vector<BearingSummary>& bearings);

/// Tables and notes for the console, starting with an empty line; empty if there are no bearings. Table headers are enclosed in `bold` and `plain`.
std::string bearing_text(const std::vector<BearingSummary>& bearings, const std::string& bold = "", const std::string& plain = "");

/// The list under "bearings" in summary.json, as an object of its own.
std::string bearing_json(const std::vector<BearingSummary>& bearings);

}  // namespace pintle

// The tables and texts of a report's page, as HTML that reads without its script.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/results.h"

namespace pintle {

/// What became of the run, in a line: how accurate the joint forces are, or where it stopped.
struct Verdict {
  enum Kind { kGood, kDoubtful, kBad } kind = kGood;
  std::string text;  ///< plain text
};
Verdict verdict_on(const Trajectory& trajectory);

std::string facts_line(const Model& model, const Trajectory& trajectory);  ///< "0.63 s · 3 bodies · ..."
std::string force_table(const Trajectory& trajectory);
std::string horizon_table(const Trajectory& trajectory);  ///< "" unless the motion is chaotic
std::string event_table(const Trajectory& trajectory);    ///< "" without any
std::string couple_table(const Trajectory& trajectory);   ///< "" without any
std::string heat_table(const Trajectory& trajectory);     ///< "" where joints lose next to nothing
std::string drive_tables(const Trajectory& trajectory);   ///< springs and motors
std::string bearing_section(const std::vector<BearingSummary>& bearings);
/// Where pins that are not held by springs go in their bushes: a picture of each; empty where there is none.
std::string orbit_section(const RunRecord& run);
/// What pins with clearance wear off, with a picture of each; empty where nothing has worn.
std::string wear_section(const RunRecord& run);
std::string energy_table(const EnergyAccount& energy);
std::string assumption_list(const Model& model, const Trajectory& trajectory);
std::string counter_table(const Trajectory& trajectory);
std::string provenance(const RunStamp& stamp);

}  // namespace pintle

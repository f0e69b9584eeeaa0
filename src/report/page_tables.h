// The tables and texts of a report's page, as HTML that is readable without its script.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/results.h"

namespace pintle {

/// The result of the run in one line: how accurate the joint forces are, or where it stopped.
struct Verdict {
  enum Kind { kGood, kDoubtful, kBad } kind = kGood;
  std::string text;  ///< plain text
};
Verdict verdict_on(const Trajectory& trajectory);

std::string facts_line(const Model& model, const Trajectory& trajectory);  ///< "0.63 s · 3 bodies · ..."
std::string force_table(const Trajectory& trajectory);
std::string horizon_table(const Trajectory& trajectory);  ///< "" unless the motion is chaotic
std::string event_table(const Trajectory& trajectory);    ///< "" if there are none
std::string couple_table(const Trajectory& trajectory);   ///< "" if there are none
std::string heat_table(const Trajectory& trajectory);     ///< "" if joint losses are negligible
std::string drive_tables(const Trajectory& trajectory);   ///< springs and motors
std::string bearing_section(const std::vector<BearingSummary>& bearings);
/// The paths of pins in their bushes, if no springs hold the pins: a picture of each; empty if there are none.
std::string orbit_section(const RunRecord& run);
/// The wear of pins with clearance, with a picture of each; empty if nothing has worn.
std::string wear_section(const RunRecord& run);
std::string energy_table(const EnergyAccount& energy);
std::string assumption_list(const Model& model, const Trajectory& trajectory);
std::string counter_table(const Trajectory& trajectory);
std::string provenance(const RunStamp& stamp);

}  // namespace pintle

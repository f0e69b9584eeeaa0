#include "results/bearing_text.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "base/constants.h"
#include "bearings/worn_sector.h"
#include "results/text_table.h"

namespace pintle {
namespace {

constexpr double kPerMinute = 60 / kTurn, kDegrees = 360 / kTurn, kMega = 1e6;

BearingTable duty_table(const std::vector<BearingSummary>& bearings) {
  BearingTable table{"Pins in their bearings (the run counts as a load cycle that repeats)",
                     {{"turns", ""}, {"swing", "deg"}, {"mean speed", "1/min"}, {"peak speed", "1/min"}, {"mean force", "N"}, {"peak force", "N"}}, {}};
  for (const BearingSummary& one : bearings)
    table.rows.push_back({one.joint, {one.path / kTurn, one.swing * kDegrees, one.mean_speed * kPerMinute, one.peak_speed * kPerMinute, one.mean_force, one.peak_force}});
  return table;
}

BearingTable life_table(const std::vector<BearingSummary>& bearings) {
  BearingTable table{"Rolling bearings (P: equivalent load; life L10 of ISO 281)",
                     {{"P", "N"}, {"error est.", "N", true}, {"L10", "10^6 turns"}, {"L10h", "h"}, {"error est.", "-", true}, {"C0/peak", "-"}, {"Cu/P", "-"}}, {}};
  for (const BearingSummary& one : bearings)
    if (!std::isnan(one.equivalent_load) || !std::isnan(one.static_safety))
      table.rows.push_back({one.joint, {one.equivalent_load, one.equivalent_load_error, one.life, one.life_hours, one.life_error, one.static_safety, one.fatigue_ratio}});
  return table;
}

BearingTable pressure_table(const std::vector<BearingSummary>& bearings) {
  BearingTable table{"Plain bearings (p: force over projected area; v: sliding speed)",
                     {{"mean p", "MPa"}, {"peak p", "MPa"}, {"mean v", "m/s"}, {"peak v", "m/s"}, {"mean pv", "MPa*m/s"}, {"peak pv", "MPa*m/s"}}, {}};
  for (const BearingSummary& one : bearings)
    if (!std::isnan(one.mean_pressure))
      table.rows.push_back({one.joint, {one.mean_pressure / kMega, one.peak_pressure / kMega, one.mean_sliding, one.peak_sliding, one.mean_pv / kMega, one.peak_pv / kMega}});
  return table;
}

BearingTable depth_table(const std::vector<BearingSummary>& bearings) {
  BearingTable table{"Worn bushes (depth that this run has worn off where it is most)", {{"depth", "um"}, {"at", "deg"}}, {}};
  for (const BearingSummary& one : bearings)
    if (!std::isnan(one.bush_depth)) table.rows.push_back({one.joint, {1e6 * one.bush_depth, kDegrees * one.bush_depth_angle}});
  return table;
}

std::string text_of(const BearingTable& from, const std::string& bold, const std::string& plain) {
  TextTable table;
  table.add_column("joint", TextTable::Align::kLeft);
  for (const BearingTable::Head& head : from.heads) table.add_column(head.text, TextTable::Align::kNumber, head.unit);
  for (const BearingTable::Row& row : from.rows) {
    std::vector<std::string> cells{row.joint};
    for (std::size_t i = 0; i < row.values.size(); ++i) cells.push_back(std::isnan(row.values[i]) ? "-" : from.heads[i].estimate ? exponent(row.values[i]) : engineering(row.values[i]));
    table.add_row(std::move(cells));
  }
  return fmt::format("\n{}\n{}", from.title, table.text(bold, plain));
}

}  // namespace

BearingTable wear_table(const std::vector<JointWear>& wear) {
  BearingTable table{"Wear of pins with clearance (normal force times way of slip; directions from the x axes of the markers)", {{"work", "J"}, {"bush most at", "deg"}, {"pin most at", "deg"}}, {}};
  for (const JointWear& one : wear)
    if (const double work = std::accumulate(one.bush.begin(), one.bush.end(), 0.0); work > 0) table.rows.push_back({one.joint, {work, most_worn(one.bush).degrees(), most_worn(one.pin).degrees()}});
  return table;
}

std::string wear_text(const std::vector<JointWear>& wear, const std::string& bold, const std::string& plain) {
  const BearingTable table = wear_table(wear);
  return table.rows.empty() ? "" : text_of(table, bold, plain);
}

std::vector<BearingTable> bearing_tables(const std::vector<BearingSummary>& bearings) {
  std::vector<BearingTable> tables{duty_table(bearings), life_table(bearings), pressure_table(bearings), depth_table(bearings)};
  std::erase_if(tables, [](const BearingTable& table) { return table.rows.empty(); });
  return tables;
}

std::vector<std::string> bearing_notes(const std::vector<BearingSummary>& bearings) {
  std::vector<std::string> notes;
  for (const BearingSummary& one : bearings)
    for (const auto* list : {&one.wants, &one.remarks})
      for (const std::string& text : *list) notes.push_back(fmt::format("joint {}: {}", one.joint, text));
  return notes;
}

std::string bearing_text(const std::vector<BearingSummary>& bearings, const std::string& bold, const std::string& plain) {
  std::string text;
  for (const BearingTable& from : bearing_tables(bearings)) text += text_of(from, bold, plain);
  for (const std::string& note : bearing_notes(bearings)) text += "  " + note + "\n";
  return text;
}

}  // namespace pintle

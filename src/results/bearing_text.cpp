#include "results/bearing_text.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "results/text_table.h"

namespace pintle {
namespace {

using Align = TextTable::Align;

constexpr double kTurn = 2 * std::numbers::pi, kMinute = 60, kMega = 1e6;

std::string value(double x) { return std::isnan(x) ? "-" : engineering(x); }
std::string estimate(double x) { return std::isnan(x) ? "-" : exponent(x); }

std::string section(const std::string& title, const TextTable& table, const std::string& bold, const std::string& plain) {
  return table.empty() ? "" : fmt::format("\n{}\n{}", title, table.text(bold, plain));
}

TextTable duty_table(const std::vector<BearingSummary>& bearings) {
  TextTable table;
  table.add_column("pin", Align::kLeft);
  table.add_column("turns", Align::kNumber);
  table.add_column("swing", Align::kNumber, "deg");
  for (const char* head : {"mean speed", "peak speed"}) table.add_column(head, Align::kNumber, "1/min");
  for (const char* head : {"mean force", "peak force"}) table.add_column(head, Align::kNumber, "N");
  for (const BearingSummary& one : bearings)
    table.add_row({one.joint, value(one.path / kTurn), value(one.swing * 360 / kTurn), value(one.mean_speed * kMinute / kTurn), value(one.peak_speed * kMinute / kTurn),
                   value(one.mean_force), value(one.peak_force)});
  return table;
}

TextTable life_table(const std::vector<BearingSummary>& bearings) {
  TextTable table;
  table.add_column("pin", Align::kLeft);
  table.add_column("P", Align::kNumber, "N");
  table.add_column("error est.", Align::kNumber, "N");
  table.add_column("L10", Align::kNumber, "10^6 turns");
  table.add_column("L10", Align::kNumber, "h");
  table.add_column("error est.", Align::kNumber, "-");
  table.add_column("C0/peak", Align::kNumber, "-");
  table.add_column("Cu/P", Align::kNumber, "-");
  for (const BearingSummary& one : bearings)
    if (!std::isnan(one.equivalent_load) || !std::isnan(one.static_safety))
      table.add_row({one.joint, value(one.equivalent_load), estimate(one.equivalent_load_error), value(one.life), value(one.life_hours), estimate(one.life_error),
                     value(one.static_safety), value(one.fatigue_ratio)});
  return table;
}

TextTable pressure_table(const std::vector<BearingSummary>& bearings) {
  TextTable table;
  table.add_column("pin", Align::kLeft);
  for (const char* head : {"mean p", "peak p"}) table.add_column(head, Align::kNumber, "MPa");
  for (const char* head : {"mean v", "peak v"}) table.add_column(head, Align::kNumber, "m/s");
  for (const char* head : {"mean pv", "peak pv"}) table.add_column(head, Align::kNumber, "MPa*m/s");
  for (const BearingSummary& one : bearings)
    if (!std::isnan(one.mean_pressure))
      table.add_row({one.joint, value(one.mean_pressure / kMega), value(one.peak_pressure / kMega), value(one.mean_sliding), value(one.peak_sliding), value(one.mean_pv / kMega),
                     value(one.peak_pv / kMega)});
  return table;
}

}  // namespace

std::vector<std::string> bearing_notes(const std::vector<BearingSummary>& bearings) {
  std::vector<std::string> notes;
  for (const BearingSummary& one : bearings)
    for (const auto& list : {one.wants, one.remarks})
      for (const std::string& text : list) notes.push_back(fmt::format("joint {}: {}", one.joint, text));
  return notes;
}

std::string bearing_text(const std::vector<BearingSummary>& bearings, const std::string& bold, const std::string& plain) {
  if (bearings.empty()) return "";
  std::string text = section("Pins in their bearings (the run counts as a load cycle that repeats)", duty_table(bearings), bold, plain);
  text += section("Rolling bearings (life L10 of ISO 281)", life_table(bearings), bold, plain);
  text += section("Plain bearings (pressure on the projected area)", pressure_table(bearings), bold, plain);
  for (const std::string& note : bearing_notes(bearings)) text += "  " + note + "\n";
  return text;
}

}  // namespace pintle

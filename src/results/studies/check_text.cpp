// The report of a check as text.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "results/studies/check_report.h"
#include "results/text_table.h"

namespace pintle {
namespace {

using Align = TextTable::Align;

constexpr std::size_t kMaxLoops = 12, kMaxNames = 12, kMaxGroups = 8, kMaxComponents = 24, kMaxSmallMotions = 6;

struct Look {
  bool details;
  std::string bold, good, warn, plain;
  Look(bool show_details, bool colour)
      : details(show_details),
        bold(colour ? "\x1b[1m" : ""),
        good(colour ? "\x1b[32m" : ""),
        warn(colour ? "\x1b[1;31m" : ""),
        plain(colour ? "\x1b[0m" : "") {}
};

std::string counted(int n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::string names(const std::vector<std::string>& list, bool all) {
  const std::size_t shown = all || list.size() <= kMaxNames ? list.size() : kMaxNames - 1;
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : ", ") + list[i];
  if (shown < list.size()) text += fmt::format(" and {} more", list.size() - shown);
  return text;
}

// `what`: one of them; its plural ends in -s.
std::string more(std::size_t total, std::size_t shown, const char* what) {
  if (shown >= total) return "";
  const bool one = total - shown == 1;
  return fmt::format("  and {} more {}{} (--details lists {})\n", total - shown, what, one ? "" : "s", one ? "it" : "them");
}

std::string heading(const CheckReport& r, const std::string& title, const Look& look) {
  return fmt::format("{}{}{}\n{}, {}, {}, {}, {}; total mass {} kg, centre at ({}, {}) m\n", look.bold, title,
                     look.plain, counted(r.n_bodies, "moving body", "moving bodies"),
                     counted(r.n_joints, "joint", "joints"), counted(r.n_springs, "spring", "springs"),
                     counted(r.n_forces, "force", "forces"), counted(r.n_motors, "motor", "motors"),
                     engineering(r.total_mass), engineering(r.mass_centre[0]), engineering(r.mass_centre[1]));
}

std::string mobility_section(const CheckMobility& m, const Look& look) {
  std::string text = fmt::format("\n{}Mobility{}\n", look.bold, look.plain);
  text += fmt::format("  Gruebler's count: {} degrees of freedom - {} = {}\n", m.freedoms,
                      counted(m.constraints, "constraint", "constraints"), m.gruebler);
  if (m.rank < 0) return text + fmt::format("  true mobility: not determined, {}\n", m.remark);
  text += fmt::format("  true mobility: {}{}{} ({} degrees of freedom - rank {}, by {}, relative tolerance {:.1e})\n", look.bold,
                      m.mobility, look.plain, m.freedoms, m.freedoms - m.mobility, m.method, m.rank_tolerance);
  if (m.servos > 0)
    text += fmt::format(
        "  with {} holding: {}{}\n", counted(m.servos, "motor", "motors"), m.mobility_driven,
        m.freedoms - m.rank - m.mobility_driven < m.servos ? "; motors and joints conflict" : "");
  if (m.singular_position())
    text += fmt::format(
        "  {}singular position{}: the rank is {} here and {} nearby; here it has {} instantaneous degrees of freedom\n",
        look.warn, look.plain, m.rank, m.rank_nearby, m.freedoms - m.rank);
  if (m.smallest_kept > 0 && m.smallest_kept < 1e-4)
    text +=
        fmt::format("  close to one more degree of freedom: the smallest pivot counted is {:.1e} of the largest\n",
                    m.smallest_kept);
  if (!m.remark.empty()) text += fmt::format("  {}\n", m.remark);
  return text;
}

std::string redundancy_section(const CheckReport& report, const Look& look) {
  if (report.redundancies.empty()) return "";
  std::string text = fmt::format("\n{}Redundant connections{}\n", look.bold, look.plain);
  const std::size_t shown =
      look.details ? report.redundancies.size() : std::min(kMaxGroups, report.redundancies.size());
  for (std::size_t g = 0; g < shown; ++g) {
    const CheckRedundancy& group = report.redundancies[g];
    std::vector<std::string> members;
    for (const auto& m : group.members)
      members.push_back(m.share > 0
                            ? fmt::format("{}.{} ({:.0f} %)", m.joint, m.component, 100 * m.share / group.degree)
                            : fmt::format("{}.{}", m.joint, m.component));
    text += fmt::format("  {} among {}\n", counted(group.degree, "redundant constraint", "redundant constraints"), names(members, look.details));
  }
  text += more(report.redundancies.size(), shown, "group");
  return text +
         "  They can load each other: stiffness and misfit decide how much. Ideal joints leave the load sharing undetermined.\n";
}

std::string loop_section(const CheckTopology& t, const Look& look) {
  std::string text = fmt::format("\n{}Loops{}\n", look.bold, look.plain);
  if (t.n_loops == 0) text += "  none: the joints form a tree\n";
  const std::size_t shown = look.details ? t.loops.size() : std::min(kMaxLoops, t.loops.size());
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("  {}  {}\n", i + 1, names(t.loops[i].joints, look.details));
  text += more(static_cast<std::size_t>(t.n_loops), shown, "loop");
  for (const auto& group : t.floating)
    text += fmt::format("  not connected to the ground by joints: {}\n", names(group, look.details));
  return text;
}

std::string gear_section(const CheckReport& report, const Look& look) {
  TextTable table;
  for (const char* head : {"gear", "type", "first", "second"}) table.add_column(head, Align::kLeft);
  table.add_column("second per first", Align::kNumber);
  table.add_column("unit", Align::kLeft);
  for (const CheckGear& gear : report.gears)
    table.add_row({gear.joint, gear.type, gear.first_body, gear.second_body, engineering(gear.ratio), gear.unit});
  if (table.empty()) return "";
  std::string text = fmt::format("\n{}Gear ratios{} (line of centres fixed)\n{}", look.bold, look.plain,
                                 table.text(look.bold, look.plain));
  for (const CheckTransmission& t : report.transmission)
    text += fmt::format("  {}.{} moves {} {} of {}\n", t.joint, t.coordinate, engineering(t.ratio),
                        t.unit == "-" ? "times the rate" : t.unit + " times the rate", report.transmission_of);
  return text;
}

std::string hertz(double radians) {
  return engineering(radians / (2 * std::numbers::pi));
}

TextTable frequency_table(const char* first) {
  TextTable table;
  for (const char* head : {first, "joint", "component"}) table.add_column(head, Align::kLeft);
  table.add_column("frequency", Align::kNumber, "rad/s");
  table.add_column("", Align::kNumber, "Hz");
  table.add_column("damping ratio", Align::kNumber, "-");
  return table;
}

std::string mode_section(const CheckFrequencies& f, const Look& look) {
  if (f.modes.empty()) return "";
  TextTable table = frequency_table("mode");
  table.add_column("energy share", Align::kNumber, "%");
  const auto add = [&table](const std::string& which, const CheckMode& m) {
    table.add_row({which, m.joint, m.component, engineering(m.frequency), hertz(m.frequency),
                   engineering(m.damping_ratio), engineering(100 * m.share)});
  };
  if (look.details) {
    for (std::size_t i = 0; i < f.modes.size(); ++i) add(fmt::format("{}", i + 1), f.modes[i]);
  } else {
    if (f.complete) add("slowest", f.modes.front());
    add("fastest", f.modes.back());
    const auto less_damped = [](const CheckMode& a, const CheckMode& b) { return a.damping_ratio < b.damping_ratio; };
    if (f.complete) {
      add("least damped", *std::min_element(f.modes.begin(), f.modes.end(), less_damped));
      add("most damped", *std::max_element(f.modes.begin(), f.modes.end(), less_damped));
    }
  }
  std::string text =
      fmt::format("\n{}Vibration modes{} (of the joints alone, as assembled, without springs; with the joint that stores most of the energy)\n{}",
                  look.bold, look.plain, table.text(look.bold, look.plain));
  if (!f.remark.empty()) text += fmt::format("  {}\n", f.remark);
  if (f.explicit_step > 0)
    text += fmt::format("  An explicit method (dopri5) needs steps below {} s; the implicit one has no such limit.\n",
                        engineering(f.explicit_step));
  return text;
}

// Motions that grow, and the slowest of the others.
std::string small_motion_section(const CheckSmallMotions& s, const Look& look) {
  std::string text = fmt::format("\n{}Small motions about the position of rest{}", look.bold, look.plain);
  if (!s.known) return s.remark.empty() ? "" : text + fmt::format(": {}\n", s.remark);
  TextTable table;
  for (const char* head : {"motion", "body", "direction"}) table.add_column(head, Align::kLeft);
  table.add_column("energy share", Align::kNumber, "%");
  table.add_column("frequency", Align::kNumber, "rad/s");
  table.add_column("", Align::kNumber, "Hz");
  table.add_column("damping ratio", Align::kNumber, "-");
  table.add_column("time constant", Align::kNumber, "s");
  std::size_t shown = 0;
  bool grows = false;
  for (const CheckSmallMotion& m : s.modes) {
    const bool growing = m.real > s.resolved;
    grows = grows || growing;
    if (!look.details && !growing && shown >= kMaxSmallMotions) continue;
    ++shown;
    const bool vibrates = m.imaginary > 0;
    table.add_row({growing ? "grows" : vibrates ? "vibrates" : "decays", m.body, m.direction, engineering(100 * m.share), vibrates ? engineering(m.frequency) : "",
                   vibrates ? hertz(m.frequency) : "", vibrates ? engineering(m.damping_ratio) : "", std::abs(m.real) > s.resolved ? engineering(1 / std::abs(m.real)) : ""});
  }
  text += " (with all forces, and the coordinate that moves most)\n";
  if (!table.empty()) text += table.text(look.bold, look.plain);
  text += more(s.modes.size(), shown, "faster one");
  if (s.n_free > 0) text += fmt::format("  {} free, or slower than {} rad/s\n", counted(s.n_free, "motion is", "motions are"), engineering(s.resolved));
  if (grows) text += fmt::format("  {}The position is unstable{}: a disturbance grows by a factor of e in the time constant.\n", look.warn, look.plain);
  return text;
}

std::string component_section(const CheckFrequencies& f, const Look& look) {
  if (f.components.empty()) return "";
  TextTable table = frequency_table("type");
  table.add_column("stiffness", Align::kNumber);
  table.add_column("effective mass", Align::kNumber, "kg, kg*m^2");
  const std::size_t shown = look.details ? f.components.size() : std::min(kMaxComponents, f.components.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const CheckComponent& c = f.components[i];
    table.add_row({c.type, c.joint, c.component, engineering(c.frequency), hertz(c.frequency),
                   engineering(c.damping_ratio), engineering(c.stiffness), engineering(c.effective_mass)});
  }
  return fmt::format("\n{}Each joint alone{}\n{}", look.bold, look.plain, table.text(look.bold, look.plain)) +
         more(f.components.size(), shown, "component");
}

std::string battery_section(const char* title, const CheckBattery& battery, const Look& look) {
  const bool passed = battery.passed();
  long comparisons = 0, kinks = 0;
  for (const CheckItem& item : battery.items) comparisons += item.comparisons, kinks += item.at_kinks;
  std::string text = fmt::format("\n{}{}{}: {}{}{}, {} comparisons", look.bold, title, look.plain,
                                 passed ? look.good : look.warn, passed ? "passed" : "FAILED", look.plain, comparisons);
  text += kinks > 0 ? fmt::format(", {} omitted at kinks\n", kinks) : "\n";
  TextTable table;
  table.add_column("compared", Align::kLeft);
  table.add_column("worst mismatch", Align::kNumber, "-");
  table.add_column("allowed", Align::kNumber, "-");
  table.add_column("where", Align::kLeft);
  for (const CheckItem& item : battery.items)
    if ((look.details && item.comparisons > 0) || !item.passed())
      table.add_row({item.what, exponent(item.worst), exponent(item.tolerance), item.place});
  if (!table.empty()) return text + table.text(look.bold, look.plain);
  const auto worst = std::max_element(battery.items.begin(), battery.items.end(),
                                      [](const CheckItem& a, const CheckItem& b) { return a.worst < b.worst; });
  if (worst != battery.items.end() && worst->worst > 0)
    text += fmt::format("  worst: {}, {} of {} allowed, {}\n", worst->what, exponent(worst->worst),
                        exponent(worst->tolerance), worst->place);
  return text;
}

}  // namespace

std::string check_text(const CheckReport& report, const std::string& title, bool details, bool colour) {
  const Look look(details, colour);
  std::string text = heading(report, title, look);
  text += mobility_section(report.mobility, look);
  text += redundancy_section(report, look);
  text += loop_section(report.topology, look);
  text += gear_section(report, look);
  text += small_motion_section(report.small_motions, look);
  text += mode_section(report.frequencies, look);
  text += component_section(report.frequencies, look);
  text += battery_section("Jacobians against finite differences", report.jacobians, look);
  text += battery_section("Energy and balance", report.energy, look);
  if (!report.notes.empty()) text += fmt::format("\n{}Notes{}\n", look.bold, look.plain);
  for (const std::string& note : report.notes) text += fmt::format("  {}\n", note);
  return text;
}

}  // namespace pintle

#include "results/event_kinds.h"

#include <algorithm>
#include <string_view>

namespace pintle {
namespace {

std::size_t place_of(const JointEvents& joint, std::string_view name) {
  return static_cast<std::size_t>(std::find_if(joint.columns.begin(), joint.columns.end(), [&](const Column& column) { return column.name == name; }) - joint.columns.begin());
}

// The column of the approach speed; a joint with stops and a contact has two of these, a guide one for each end.
std::size_t approach_of(const JointEvents& joint, const std::string& what) {
  if (what.find("touch") == std::string::npos) return joint.columns.size();  // surfaces that slip were already in contact
  if (what.ends_with(" stop")) return place_of(joint, "stop_approach_speed");
  const std::size_t of_end = place_of(joint, "approach_speed_" + what.substr(0, what.find(' ')));
  return of_end < joint.columns.size() ? of_end : place_of(joint, "approach_speed");
}

EventKind kind_of(const JointEvents& joint, const std::string& what) {
  EventKind out;
  out.joint = joint.joint;
  out.what = what;
  const std::size_t heat = place_of(joint, "heat"), approach = approach_of(joint, what);
  for (const JointEvent& event : joint.events) {
    if (event.what != what) continue;
    if (out.count++ == 0) out.first = event.t;
    out.last = event.t;
    if (approach < event.values.size()) out.fastest_approach = std::max(out.fastest_approach, event.values[approach]);
    if (heat < event.values.size()) out.most_heat = std::max(out.most_heat, event.values[heat]);
  }
  if (out.fastest_approach > 0) out.approach_unit = joint.columns[approach].unit;
  return out;
}

}  // namespace

std::vector<EventKind> kinds_of_events(const Trajectory& run) {
  if (run.events.empty()) return run.event_kinds;
  std::vector<EventKind> kinds;
  for (const JointEvents& joint : run.events)
    for (const JointEvent& event : joint.events) {
      const bool known = std::any_of(kinds.begin(), kinds.end(), [&](const EventKind& kind) { return kind.joint == joint.joint && kind.what == event.what; });
      if (!known) kinds.push_back(kind_of(joint, event.what));
    }
  return kinds;
}

}  // namespace pintle

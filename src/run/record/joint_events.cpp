#include "run/record/joint_events.h"

#include <algorithm>
#include <utility>

namespace pintle {

template <class S>
std::vector<JointEvents> events_of_joints(const BasicSystem<S>& system, const std::vector<LawCrossing>& crossings, const std::vector<double>& heat) {
  std::vector<JointEvents> of_joint(system.joints.size());
  const bool with_heat = heat.size() == crossings.size();
  std::vector<double> lost(system.joints.size(), 0);
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const LawCrossing& crossing = crossings[i];
    const auto j = static_cast<std::size_t>(crossing.joint);
    JointEvent event{crossing.t, system.joints[j].law.parts()[static_cast<std::size_t>(crossing.part)]->border_name(crossing.border, crossing.rising), crossing.seen};
    if (with_heat) {
      event.values.push_back(std::max(0.0, heat[i] - lost[j]));
      lost[j] = std::max(lost[j], heat[i]);
    }
    of_joint[j].events.push_back(std::move(event));
  }
  std::vector<JointEvents> out;
  for (std::size_t j = 0; j < of_joint.size(); ++j) {
    if (of_joint[j].events.empty()) continue;
    of_joint[j].joint = system.joints[j].name;
    for (const LawColumn& column : system.joints[j].law.columns()) of_joint[j].columns.push_back({column.name, column.unit, column.meaning});
    if (with_heat) of_joint[j].columns.push_back({"heat", "J", "what the joint has turned into heat since its event before; of surfaces that stick, what their springs do not give back"});
    out.push_back(std::move(of_joint[j]));
  }
  return out;
}

template std::vector<JointEvents> events_of_joints(const BasicSystem<Planar>& system, const std::vector<LawCrossing>& crossings, const std::vector<double>& heat);
PINTLE_IN_SPACE(template std::vector<JointEvents> events_of_joints(const BasicSystem<Spatial>& system, const std::vector<LawCrossing>& crossings, const std::vector<double>& heat);)

}  // namespace pintle

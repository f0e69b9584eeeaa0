#include "run/record/creeping_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pintle {
namespace {

// Judged by the law's columns.
template <class S>
bool is_contact(const BasicLaw<S>& law) {
  const std::vector<LawColumn> columns = law.columns();
  return std::any_of(columns.begin(), columns.end(), [](const LawColumn& column) { return column.name == "approach_speed"; });
}

struct Creep {
  double share = 0, slowest = 0;  // damping over the whole force; damping over stiffness [s]
};

// How components 0 to n - 1 of a law's force `size` [N or N*m] creep; all zero if none does.
template <class S>
Creep creep_of(const BasicLaw<S>& law, const BasicLawPoint<S>& at, double size, int n, double duration) {
  constexpr double kShare = 0.02, kSlow = 0.02;  // share of the force that is damping; damping over stiffness, as a fraction of the run
  BasicLawTangents<S> tangents;
  law.linearize(at, tangents);
  Creep out;
  for (int k = 0; k < n; ++k) {
    const double stiffness = std::abs(tangents.stiffness(k, k)), damping = std::abs(tangents.damping(k, k)), share = damping * std::abs(at.rate[k]) / size;
    if (!(share > kShare) || !(damping > kSlow * duration * stiffness) || stiffness == 0) continue;
    out.share = std::max(out.share, share);
    out.slowest = std::max(out.slowest, damping / stiffness);
  }
  return out;
}

// The same of the stops of a free coordinate, without what else acts there, such as friction.
template <class S>
Creep creep_of_stops(const BasicLaw<S>& law, BasicLawPoint<S> at, double duration) {
  for (const auto& part : law.parts()) {
    if (part->stops()) {
      BasicLaw<S> alone;
      alone.add(part->clone());
      const double size = alone.force(at).cwiseAbs().maxCoeff();
      return size > 0 ? creep_of(alone, at, size, S::kDof, duration) : Creep{};
    }
    at.state += part->n_states();
  }
  return {};
}

}  // namespace

template <class S>
std::string note_on_creeping_contacts(const BasicSystem<S>& system, const BasicState<S>& end, double duration) {
  std::string names;
  Creep worst;
  bool contacts = false, stops = false;
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[j];
    const auto at = law_point(system, j, end);
    const double force = end.force[j].template head<S::kDim>().norm();
    const Creep contact = force > 0 && is_contact(joint.law) ? creep_of(joint.law, at, force, S::kDim, duration) : Creep{};
    const Creep stop = creep_of_stops(joint.law, at, duration);
    if (contact.share == 0 && stop.share == 0) continue;
    contacts = contacts || contact.share > 0;
    stops = stops || stop.share > 0;
    names += (names.empty() ? "" : ", ") + joint.name;
    worst = {std::max({worst.share, contact.share, stop.share}), std::max({worst.slowest, contact.slowest, stop.slowest})};
  }
  if (names.empty()) return "";
  const char* what = !stops ? "contacts" : contacts ? "contacts and stops" : "stops";
  const char* key = !stops ? "least_approach_speed" : contacts ? "least_approach_speed or stop_least_speed" : "stop_least_speed";
  const std::string share = worst.share <= 1 ? fmt::format("up to {:.2g} of their force is damping", worst.share) : fmt::format("their damping is up to {:.2g} times the force that they carry", worst.share);
  return fmt::format("{0} that are still settling under their load at the end ({1}): {2}, which makes them take {3:.2g} s to follow the load, and loads shared with other joints are still shifting. "
                     "A slowly loaded one is damped as in an impact at {4}; with a larger one, or a restitution nearer to 1, it settles sooner",
                     what, names, share, worst.slowest, key);
}

template std::string note_on_creeping_contacts(const System& system, const State& end, double duration);
PINTLE_IN_SPACE(template std::string note_on_creeping_contacts(const BasicSystem<Spatial>& system, const BasicState<Spatial>& end, double duration);)

}  // namespace pintle

// Locks: springs that hold one component of a joint while a start is computed. They are joints of their own, after the others: anything else that acts in the component
// that they hold, such as pressure in a cylinder, is a load on them.
#pragma once

#include <memory>
#include <string_view>
#include <utility>

#include "laws/law.h"
#include "start/settle_joints.h"
#include "system/system.h"

namespace pintle {

/// A part of a law that does nothing. It has as many states as the part, or the law, whose place it takes while a start is computed, so that the states of all laws keep their places.
struct InertStates {
  static constexpr std::string_view kWord = "inert states";
  static constexpr bool kHolds = false, kRubs = false;
  int states = 0;

  int n_states() const { return states; }
  template <class T>
  void evaluate(const LawInput<T>&, LawOutput<T>&) const {}
};

inline std::unique_ptr<BasicLawPart<Planar>> inert_states(int states) { return BasicLaw<Planar>(InertStates{states}).parts().front()->clone(); }

/// Holds one component at its present value.
struct LockLaw {
  static constexpr std::string_view kWord = "lock";
  int component = 0;
  double k = 1, at = 0;  // [N/m or N*m/rad]; the gap at which it holds
  double preload = 0;    // force there [N or N*m]

  template <class T>
  T force_at(const T& gap) const {
    return T(preload) - k * (gap - T(at));
  }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const T off = in.gap[component] - T(at);
    out.force[component] = force_at(in.gap[component]);
    out.energy = 0.5 * k * (off * off) - preload * off;
  }
  Planar::Vec engaged_stiffness() const { return k * Planar::Vec::Unit(component); }
};

/// The same system with a lock for each of `held`, which have the index of a `joint` and its `lock`.
template <class Held>
System with_locks(const System& system, const Held& held) {
  System locked = system;
  for (const auto& one : held) {
    const JointData& joint = system.joints[static_cast<std::size_t>(one.joint)];
    JointData added;
    added.name = joint.name;
    added.type = joint.type;
    added.at = joint.at;
    added.displacement = joint.displacement;
    added.law = BasicLaw<Planar>(one.lock);
    added.free_mask = Planar::Vec::Ones() - Planar::Vec::Unit(one.lock.component);
    added.held[one.lock.component] = true;
    locked.joints.push_back(std::move(added));
  }
  locked.finish();
  return locked;
}

/// Removes the locks, all that comes after the first n_joints, from a start.
inline void remove_locks(int n_joints, BasicSettledStart<Planar>& start) {
  State& state = start.state;
  for (Vecs* of_joints : {&state.gap, &state.gap_rate, &state.gap_accel, &state.force, &start.effective_mass})
    if (!of_joints->empty()) of_joints->resize(static_cast<std::size_t>(n_joints));
}

}  // namespace pintle

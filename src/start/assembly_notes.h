// What assembly has made of stated positions and velocities, where a user would not expect it.
#pragma once

#include <string>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

/// Bodies that came to lie far from where the file states them: these were meant otherwise, or their markers, or a unit is missing. `guess` has the stated
/// positions.
void note_moved_bodies(const Model& model, const Vecs& guess, const Vecs& q, std::vector<std::string>& notes);

/// Stated velocities that joints or motors have replaced by those of v.
void note_changed_velocities(const Model& model, const Vecs& v, std::vector<std::string>& notes);

/// Teeth that are away from each other, and pulleys that overlap, would still carry their load.
void note_discs_apart(const System& system, const Vecs& q, std::vector<std::string>& notes);

/// The joints whose pins stand free in the middle of their play, where assembly puts them; "" where there are none.
template <class S>
std::string joints_in_play(const BasicSystem<S>& system) {
  std::string names;
  for (const BasicJointData<S>& joint : system.joints)
    if (!joint.law.ideal_limit() && joint.law.engaged_stiffness().template head<S::kDim>().minCoeff() > 0 && is_in_play<S>(joint.law, S::Vec::Zero(), S::Vec::Zero()))
      names += (names.empty() ? "" : ", ") + joint.name;
  return names;
}

}  // namespace pintle

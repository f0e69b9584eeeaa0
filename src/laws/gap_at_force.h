// The gap that carries a force. theory/assembly Eqs. (3.3), (3.6).
#pragma once

#include "laws/law.h"

namespace pintle {

/// The gap at which a law gives `force` at `rate`, starting from the given one; components without stiffness do not change. False if the law was found
/// unable to carry the force: the gap is then not a solution.
template <class S>
bool gap_at_force(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap);

/// Moves the gap outwards, against the force, until the law pushes back with as much of it, as a pin that crosses its play to its bush. If that never
/// happens, returns false and leaves the gap unchanged.
template <class S>
bool go_out_against(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap);

/// One step of Newton's method towards it, with the law's tangent at the given gap, in the components that are 1 in `moved`.
template <class S>
void newton_step_to_force(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, const typename S::Vec& moved, typename S::Vec& gap);

/// Whether both gaps are on the same sides of all borders of the law.
template <class S>
bool on_same_sides(const BasicLaw<S>& law, const typename S::Vec& a, const typename S::Vec& b, const typename S::Vec& rate);

}  // namespace pintle

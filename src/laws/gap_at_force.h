// The gap that carries a force. theory/assembly Eqs. (3.3), (3.6).
#pragma once

#include "laws/law.h"

namespace pintle {

/// The gap at which a law gives `force` at `rate`, from the given one; components without stiffness stay. False where the law has been found not to carry
/// the force: then the gap is none that does.
template <class S>
bool gap_at_force(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap);

/// Moves the gap out along the way that the force opposes, until the law pushes back with as much of it, as a pin that goes through its play to its bush.
/// False, and the gap as it was, where it never does.
template <class S>
bool go_out_against(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap);

/// One step of Newton's method to it, with the law's tangent at the given gap, in the components that are 1 in `moved`.
template <class S>
void newton_step_to_force(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, const typename S::Vec& moved, typename S::Vec& gap);

/// Whether both gaps are on the same sides of all borders of the law.
template <class S>
bool on_same_sides(const BasicLaw<S>& law, const typename S::Vec& a, const typename S::Vec& b, const typename S::Vec& rate);

}  // namespace pintle

// The gap that carries a force. theory/assembly Eqs. (3.3), (3.6).
#pragma once

#include "laws/law.h"

namespace pintle {

/// The gap at which a law gives `force` at `rate`, from the given one; components without stiffness stay. False where the law has been found not to carry
/// the force: then the gap is none that does.
template <class S>
bool gap_at_force(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap);

}  // namespace pintle

// The gap that carries a force. theory/assembly Eqs. (3.3), (3.6).
#pragma once

#include "laws/law.h"

namespace pintle {

/// The gap at which a law gives `force` at `rate`, from the given one; components without stiffness stay.
template <class S>
void gap_at_force(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap);

}  // namespace pintle

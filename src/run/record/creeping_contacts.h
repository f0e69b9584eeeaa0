// Tells the user of contacts whose damping still holds them back at the end of a run: loads that others share with them have not come to them yet.
#pragma once

#include <string>

#include "system/state.h"

namespace pintle {

/// A note on the contacts of which a good part of the force at `end` is damping that lets them follow their load slowly beside a run of `duration` [s]; empty: there are none.
template <class S>
std::string note_on_creeping_contacts(const BasicSystem<S>& system, const BasicState<S>& end, double duration);

}  // namespace pintle

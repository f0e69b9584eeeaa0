// Tells the user of contacts and stops whose damping still holds them back at the end of a run: they have not yet taken their part of the loads that others share with them.
#pragma once

#include <string>

#include "system/state.h"

namespace pintle {

/// A note on contacts and stops in which much of the force at `end` is damping, so that they follow their load slowly compared with a run of `duration` [s]; empty if there are none.
template <class S>
std::string note_on_creeping_contacts(const BasicSystem<S>& system, const BasicState<S>& end, double duration);

}  // namespace pintle

// What works on fleets is compiled for registers of 128, 256 and 512 bits: fleet_128.cpp and its like say which with PINTLE_FLEET, a
// namespace of their own, and the compiler's target. The bits of the results are the same.
#pragma once

#include "fleet/fleet_mechanism.h"

#ifndef PINTLE_FLEET
#error "for fleet_128.cpp and its like"
#endif

/// Before a function of some size: one piece of code, into which all that it calls of lanes and blocks is inlined. None takes or gives
/// an Each by value: code for narrow and for wide registers disagrees on how that is done, and g++ 12 with itself.
#define PINTLE_PART [[gnu::noinline, gnu::flatten]]

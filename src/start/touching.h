// Surfaces that touch at the start, such as a wheel placed on its road: they press on each other from the first instant.
#pragma once

#include <vector>

#include "start/assembly.h"
#include "start/locks.h"

namespace pintle {

/// A joint whose coordinate starts at one of its stops, and the lock that acts for the stop.
struct StopLock {
  int joint;
  LockLaw lock;
  double stop, sign;  // where the stop begins, in the lock's component [m] or [rad]; 1 for an upper stop, -1 for a lower one
};

/// Moves the bodies so that one-sided contacts and stops that touch without approaching each other have the depth at which they carry the forces that the motion needs.
/// Contacts that would have to pull stay where they are, and a note names them; everything does if no forces are found. theory/assembly section 3.
/// Returns locks that replace the stops while the rest of the start is computed, each along the tangent of its law at the load that it carries: as a load that follows from the
/// positions, a stop would be stiffer than whatever else holds its coordinate, such as a motor, and passes that correct the one by the other would diverge.
std::vector<StopLock> press_touching_surfaces(Assembly& assembly);

/// The same system with these locks, after its other joints, in place of the stops. The joints keep the states of their stops.
System with_locks_for_stops(const System& system, const std::vector<StopLock>& stops);

/// The loads of a start may push a coordinate past a stop that was a little way off as assembled, as where a motor is much softer than the stop. Adds locks for such stops,
/// with a note, and returns whether there are any: the start is then computed again.
bool hold_at_stops_passed(Assembly& unloaded, const Assembly& started, std::vector<StopLock>& stops);

/// Puts the stops of `system`, from which with_locks_for_stops made the present one, back into an assembly that has been started with locks.
void put_stops_back(const System& system, const std::vector<StopLock>& stops, Assembly& assembly);

}  // namespace pintle

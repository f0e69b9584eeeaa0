// Shared by live motion and linkages moved by hand: the pin by which the hand holds a body.
#pragma once

#include <string>
#include <vector>

#include "pintle/live.h"
#include "system/system.h"

namespace pintle {

/// A pin of stiffness k [N/m] between the world and a point of a body (in body axes [m]).
JointData mouse_spring(const std::string& name, int body, const Vec2& point, double k);

/// A point of a body at q, in world axes [m].
Planar::Point in_world(const Planar::Vec& q, const Vec2& point);

/// The largest stiffness of any joint along x or y; 0 when there is none [N/m].
double largest_stiffness(const System& system);

std::vector<PlanarPose> rows(const Vecs& x);

}  // namespace pintle

// A picture of the mechanism at one instant, as SVG.
#pragma once

#include <string>
#include <array>
#include <vector>

#include "report/poses.h"
#include "report/scene.h"

namespace pintle {

struct StillOptions {
  double width = 760;       ///< [px]
  double most_height = 1e9; ///< [px]; a taller picture is made narrower
  bool forces = true;       ///< arrows at joints, and their scale
  bool whole_arrows = false;  ///< no arrow is cut: if the run's scale is too large for this instant, the still gets its own
  bool names = true;        ///< of joints
  bool masses = false;      ///< marks at the centres of mass
  bool clock = true;        ///< the time, in a corner
  bool dark = false;
};

/// The path of a point over a run.
struct Trace {
  std::string name;
  std::vector<Vec2> points;  ///< world axes [m]
};

/// Throws std::invalid_argument, listing the available points, if the scene has no such point.
Trace make_trace(const Scene& scene, const Trajectory& trajectory, const std::string& point);

/// The mapping from world to picture, the same for every instant of a run.
struct StillFrame {
  double width = 0, height = 0;  ///< [px], even whole numbers
  double scale = 1;              ///< [px/m]
  Vec2 corner{0, 0};             ///< world point at the bottom left [m]
};
StillFrame frame_for(const Scene& scene, const StillOptions& options);

std::string still_svg(const Scene& scene, const Instant& instant, const StillOptions& options, const std::vector<Trace>& traces = {});

/// Both ends of a belt between discs about `a` and `b`; a radius is positive if the belt is on the left of its disc.
std::array<Vec2, 2> belt_run(const Vec2& a, const Vec2& b, const std::array<double, 2>& radii);

/// The zigzag of a spring of length 1 along x, from 0 to 1; y is in units.
std::vector<Vec2> spring_zigzag(int teeth);

}  // namespace pintle

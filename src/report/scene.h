// A mechanism as a drawing: shapes fixed to bodies, springs and rods between them, arrows for joint forces. It is made once per
// run; stills, films and report pages are all drawn from it. World axes, metres, y upwards.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle {

inline constexpr int kWorld = -1;  ///< the body index of the ground

/// A point and a direction fixed to a body (given by its index in the model) or to the world.
struct Anchor {
  int body = kWorld;
  Vec2 point{0, 0};  ///< [m]
  double axis = 0;   ///< [rad]
};

/// A moving place: an anchor, optionally shifted by a fraction of the way to another anchor, or offset in the axes of that anchor's body.
struct MovingPoint {
  Anchor at;
  Anchor toward{};
  double share = 0;
  Vec2 off{0, 0};  ///< [m]
  bool is_anchor() const { return share == 0 && off[0] == 0 && off[1] == 0; }
};

/// What a shape represents; paints.h states how each is drawn.
enum class Paint { kEarth, kHatch, kGuide, kLink, kGear, kPitch, kHole, kBlock, kWeld, kPin, kBall, kOil, kRubber, kMass, kMassLight, kSpring, kRod, kRope, kBarrel, kBlade, kMotor, kStop };

enum class Form {
  kBar,     ///< paths drawn with a round pen as wide as `size`, outlined as one; closed paths are filled
  kLine,    ///< thin lines
  kArea,    ///< filled polygons with an outline
  kCircle,  ///< around the first point of each path, of radius `size`
};

struct Shape {
  Form form = Form::kLine;
  Paint paint = Paint::kLink;
  int body = kWorld;
  std::vector<std::vector<Vec2>> paths;  ///< body axes [m]
  double size = 0;                       ///< [m]
  bool closed = false;
};

/// Drawn between two moving anchors: a spring as a zigzag, a rod, a rope, a belt from disc to disc, a cylinder as a barrel with its rod, a blade as a curve tangent to the axes of both anchors.
struct Connector {
  std::string name;
  Paint paint = Paint::kSpring;
  Anchor from, to;
  int teeth = 0;      ///< of a spring's zigzag
  double length = 0;  ///< of a blade; of a cylinder's barrel and of its rod, from the piston to the rod's end [m]
  std::array<double, 2> radii{0, 0};  ///< of the discs of a belt, positive if the belt is on the left of its disc [m]
  static constexpr double kHalfBarrel = 1.1;  ///< half the width of a cylinder's barrel, in units
};

struct NamedPoint {
  std::string name;  ///< "coupler.B", or the names of the joints at this point
  MovingPoint at;
};

/// The force on the second body of a joint, as columns of the trajectory.
struct ForceArrow {
  std::string joint, on;
  MovingPoint at;
  int fx = -1, fy = -1;
};

/// The markers of a revolute joint; its polar load diagram may be drawn in their axes.
struct PinMarkers {
  std::string joint;
  Anchor first, second;
  MarkerRef first_marker, second_marker;
};

/// An applied force, as columns of the trajectory.
struct LoadArrow {
  std::string name;
  Anchor at;
  int fx = -1, fy = -1;
};

/// Columns of a body's pose; -1: not recorded by the run, and the body is not drawn.
struct BodyTrack {
  std::string name;
  int x = -1, y = -1, angle = -1;
  bool recorded() const { return x >= 0 && y >= 0 && angle >= 0; }
};

struct Box {
  Vec2 low{0, 0}, high{0, 0};
  void cover(const Vec2& p, double around = 0);  ///< grows to include p, if p is finite
  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
};

struct Scene {
  std::vector<BodyTrack> bodies;
  std::vector<Shape> shapes;  ///< back to front
  std::vector<Connector> connectors;
  std::vector<NamedPoint> points;  ///< those a trace can follow
  std::vector<NamedPoint> labels;
  std::vector<ForceArrow> arrows;
  std::vector<LoadArrow> loads;
  std::vector<PinMarkers> pins;  ///< those between recorded bodies
  Box box;                   ///< extent of the mechanism and its arrows during the run [m]
  double unit = 1;           ///< size of a symbol [m]; a link is 1.5 units wide
  double arrow_length = 0;   ///< of an arrow for the force `arrow_force` [m]
  double arrow_force = 0;    ///< [N]; 0: nothing to draw
  static constexpr double kLongestArrow = 1.25;  ///< as a multiple of arrow_length; a longer arrow is cut there and gets a second head
  int time_decimals = 4;     ///< needed to distinguish consecutive rows
  std::size_t n_unseen = 0;  ///< bodies that the run did not record
};

/// Throws std::invalid_argument for a model that is not planar.
Scene make_scene(const Model& model, const Trajectory& trajectory);

}  // namespace pintle

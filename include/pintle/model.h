// The model: values and names, as the user stated them. It knows no indices, files or solvers.
// Everything is SI and radians. A planar quantity uses x and y; angles turn about +z, counter-clockwise.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "pintle/expression.h"

namespace pintle {

using Vec2 = std::array<double, 2>;

/// A point and an axis, fixed in a body (body axes, origin at the centre of mass) or in the ground.
struct Marker {
  std::string name;
  Vec2 position{0, 0};  ///< [m]
  double axis = 0;      ///< direction of the marker's x axis in body axes [rad]
  friend bool operator==(const Marker&, const Marker&) = default;
};

/// A rigid body. Positions and velocities are those of the centre of mass; absent values are found by assembly.
struct Body {
  std::string name;
  double mass = 1;     ///< [kg]
  double inertia = 1;  ///< about the centre of mass [kg*m^2]
  std::optional<Vec2> position;  ///< guess [m]
  std::optional<double> angle;   ///< guess [rad]
  std::optional<Vec2> velocity;  ///< [m/s]
  std::optional<double> spin;    ///< [rad/s]
  std::array<bool, 3> hold{false, false, false};  ///< x, y, angle: assembly must not change these
  std::vector<Marker> markers;
  friend bool operator==(const Body&, const Body&) = default;
};

/// "body.marker"; the body "ground" is the world.
struct MarkerRef {
  std::string body;
  std::string marker;
  friend bool operator==(const MarkerRef&, const MarkerRef&) = default;
};

/// A joint law by its word in the catalog, with its parameters by name; a list has one value for each gap component it covers.
struct LawChoice {
  std::string word = "linear";
  std::map<std::string, std::vector<double>> values;
  friend bool operator==(const LawChoice&, const LawChoice&) = default;
};

/// The bearing of a pin: a rolling bearing by its catalogue data, a plain one by its size. Values that are not stated are absent. theory/bearing_life
struct Bearing {
  std::string type;  ///< "ball" or "roller"; empty: not stated
  std::optional<double> dynamic_load_rating{};  ///< C of ISO 281 [N]
  std::optional<double> static_load_rating{};   ///< C_0 of ISO 76 [N]
  std::optional<double> fatigue_load_limit{};   ///< C_u of ISO 281 [N]
  std::optional<double> pin_diameter{}, pin_length{};  ///< of a plain bearing [m]
  std::optional<double> wear_coefficient{};            ///< of its bush: worn volume per unit force and sliding distance [m^2/N]
  friend bool operator==(const Bearing&, const Bearing&) = default;
};

/// Whether two functions of one variable are the same. Their texts may have been read with different parameters, so values between two places are compared
/// as well.
inline bool same_profile(const Expression& a, const Expression& b, double from, double to) {
  bool same = a.text() == b.text() && a.variables() == b.variables();
  for (int i = 0; same && i < 60; ++i) {
    const std::array<double, 1> at{from + (to - from) * i / 60};
    const double x = a.value(at), y = b.value(at);
    same = x == y || (x != x && y != y);
  }
  return same;
}

/// A cam and its follower. theory/cams
struct Cam {
  Expression lift;           ///< above the base circle, as a function of the angle on the cam [m]
  double base_radius = 0;    ///< of the base circle [m]
  double roller_radius = 0;  ///< of the follower; 0: a pin [m]
  bool flat = false;         ///< the follower is a flat face
  friend bool operator==(const Cam& a, const Cam& b) {
    return a.base_radius == b.base_radius && a.roller_radius == b.roller_radius && a.flat == b.flat && same_profile(a.lift, b.lift, 0, 6.283185307179586);
  }
};

/// A curved edge and the roller above it. theory/cams section 4
struct Edge {
  Expression height;         ///< above the x axis of the first marker, as a function of x along it [m]
  double roller_radius = 0;  ///< of the roller or wheel; 0: a point [m]
  double from = 0, to = 0;   ///< range of x that is drawn and checked; beyond it the edge continues as its expression does [m]
  friend bool operator==(const Edge& a, const Edge& b) {
    return a.roller_radius == b.roller_radius && a.from == b.from && a.to == b.to && same_profile(a.height, b.height, a.from, a.to);
  }
};

/// A joint: a joint displacement (its `type`) between two markers and a law. F is on the first marker, M on the second.
struct Joint {
  std::string name;
  std::string type;  ///< revolute, prismatic, fixed, slot, rod, rope, belt, cylinder, gear, rack, cam, edge
  MarkerRef first, second;
  std::map<std::string, double> geometry;  ///< rod, rope: length [m] (absent: as assembled, less stretch [m]); cylinder: closed_length, stroke, bore, rod_diameter [m], its pressures [Pa]; gear: radius_first, radius_second [m], internal (0 or 1); rack: radius [m]
  LawChoice law;
  LawChoice friction{"", {}};  ///< in the free directions of the joint; no word: none
  LawChoice stops{"", {}};     ///< for its angle or slide; no word: none
  LawChoice detent{"", {}};    ///< for its angle or slide; no word: none
  std::map<std::string, Expression> functions{};  ///< keys of its type that are functions and therefore not in geometry: a rod's or rope's `length` of t [m], the pressures in a cylinder [Pa]
  bool ideal = false;  ///< with Equations::kRelative: no force law, the coordinates satisfy the joint exactly
  std::optional<Cam> cam{};    ///< of a cam joint
  std::optional<Edge> edge{};  ///< of an edge joint
  std::optional<Bearing> bearing{};  ///< of a pin; it does not affect the motion
  /// Functions are compared by their text.
  friend bool operator==(const Joint& a, const Joint& b) {
    const auto values = [](const Joint& j) { return std::tie(j.name, j.type, j.first, j.second, j.geometry, j.law, j.friction, j.stops, j.detent, j.ideal, j.cam, j.edge, j.bearing); };
    return values(a) == values(b) && std::equal(a.functions.begin(), a.functions.end(), b.functions.begin(), b.functions.end(),
                                                [](const auto& f, const auto& g) { return f.first == g.first && f.second.text() == g.second.text(); });
  }
};

/// A spring-damper along the line between two markers, or (torsion) in the angle between them.
struct Spring {
  std::string name;
  bool torsion = false;
  MarkerRef first, second;
  double stiffness = 0;  ///< [N/m] or [N*m/rad]
  double damping = 0;    ///< [N*s/m] or [N*m*s/rad]
  std::optional<double> free_length;  ///< [m] or [rad]; absent: as assembled
  std::optional<double> preload;      ///< tension at the assembled length [N], or moment on the second body, towards smaller angles [N*m]
  friend bool operator==(const Spring&, const Spring&) = default;
};

/// A force and a torque on a body at a marker, functions of t.
struct AppliedForce {
  std::string name;
  MarkerRef on;
  std::array<Expression, 2> force;  ///< [N]
  Expression torque;                ///< [N*m]
  bool body_axes = false;
};

enum class MotorKind { kEffort, kSpeed, kPosition };

/// A motor in a joint's free coordinate. kEffort: torque or force as an expression of t, the coordinate ("angle" or
/// "slide"), "rate", and "J.angle", "J.slide", "J.rate" of other joints. kSpeed: an expression of t or a constant; a
/// servo moves the coordinate at this speed, starting from its assembled value. kPosition: an expression of t, followed by a servo.
struct Motor {
  std::string name;
  std::string joint;
  MotorKind kind = MotorKind::kEffort;
  Expression law;
  double stiffness = 1e6;  ///< servo [N*m/rad] or [N/m]
  double damping = 1e3;    ///< servo [N*m*s/rad] or [N*s/m]
};

/// What a run starts from. kAssembled: consistent positions, velocities and preloads. kSeated: the same, but joints with play start on the side to
/// which their load presses them instead of in the middle. kSettled: the positions in which the assembled mechanism is at rest under the loads of t =
/// 0. kUnloaded: no preloads. kRaw: as stated.
enum class Start { kAssembled, kSeated, kSettled, kUnloaded, kRaw };

/// The equations of motion. kNewtonian: every joint is a force law. kRelative: joints marked `ideal` are satisfied by relative coordinates over a spanning tree, every other joint is a force law. kIdeal:
/// every joint with a linear law is a constraint with a Lagrange multiplier. kPenalty: the same constraints, each opposed by a penalty on its acceleration, rate and violation. kAugmentedLagrangian: the same
/// constraints, with multipliers found in the iteration of an implicit step. kRelativeAugmented: the same in relative coordinates, for the constraints that close their loops.
enum class Equations { kNewtonian, kRelative, kIdeal, kPenalty, kAugmentedLagrangian, kRelativeAugmented };

/// The word of the model file.
inline const char* to_word(Equations equations) {
  switch (equations) {
    case Equations::kNewtonian: return "newtonian";
    case Equations::kRelative: return "relative";
    case Equations::kIdeal: return "ideal";
    case Equations::kPenalty: return "penalty";
    case Equations::kAugmentedLagrangian: return "augmented_lagrangian";
    case Equations::kRelativeAugmented: return "relative_augmented_lagrangian";
  }
  return "";
}

/// From a word of the model file; kNewtonian for all other words.
inline Equations to_equations(std::string_view word) {
  for (const Equations e : {Equations::kRelative, Equations::kIdeal, Equations::kPenalty, Equations::kAugmentedLagrangian, Equations::kRelativeAugmented})
    if (word == to_word(e)) return e;
  return Equations::kNewtonian;
}

/// Whether joints with a linear law are constraints.
constexpr bool has_constraints(Equations e) { return e != Equations::kNewtonian && e != Equations::kRelative; }

/// Settings for kPenalty.
struct PenaltySettings {
  double factor = 1e7;    ///< penalty of a constraint over the mass that resists it at the start [-]
  double frequency = 10;  ///< at which violations decay [rad/s]
  double damping = 1;     ///< damping ratio of that decay [-]
};

/// What the tolerance applies to. kForces: each joint force, relative to its peak. kMotion: the position of every body,
/// relative to the longest distance that a body has travelled; vibrations too small to matter for that are damped out instead
/// of followed, and the joint forces are as accurate as their error estimates say.
enum class ToleranceOf { kForces, kMotion };

/// Settings of a run.
struct SimulateSettings {
  double duration = 0;       ///< [s]; 0: not stated
  double output_step = 0;    ///< [s]; 0: duration / 500, longer beyond 20,000 joints
  double tolerance = 1e-5;   ///< of the quantities that tolerance_of names [-]
  ToleranceOf tolerance_of = ToleranceOf::kForces;
  std::string method = "auto";  ///< auto, radau, dopri5, ode45, ode23t, ode15s, ode113, hht, generalised_alpha
  Equations equations = Equations::kNewtonian;
  Start start = Start::kAssembled;
  double max_step = 0;       ///< [s]; 0: none
  /// Bodies and joints whose columns the results keep: "joint.pin", "body.*", "all". Empty: all, unless there are very many.
  std::vector<std::string> record;
  PenaltySettings penalty;
};

struct Model {
  std::string name;
  std::string description;
  std::string space = "planar";
  Vec2 gravity{0, -9.80665};  ///< [m/s^2]
  SimulateSettings simulate;
  std::vector<Marker> ground;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Spring> springs;
  std::vector<AppliedForce> forces;
  std::vector<Motor> motors;
  std::vector<std::string> notes;  ///< what reading the model left out, for the notes of runs and checks
};

}  // namespace pintle

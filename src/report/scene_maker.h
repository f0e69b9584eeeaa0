// Builds a scene from a model and the motion of its run; there is one source for bodies and one for joints.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "report/poses.h"
#include "report/scene.h"

namespace pintle {

/// A straight part of a body that something slides or rolls along.
struct Track {
  Vec2 from{0, 0}, to{0, 0};  ///< body axes [m]
  enum Kind { kGuide, kSlot, kRack } kind = kGuide;
  Vec2 other_side{0, 0};  ///< of a rack: unit vector away from its pinion
};

struct Wheel {
  Vec2 centre{0, 0};
  double radius = 0;
  bool ring = false;  ///< teeth inside
};

/// What the joints require of a body's drawing.
struct BodySketch {
  std::vector<Vec2> points;   ///< its markers, without coincident ones
  std::vector<Track> tracks;
  std::vector<Wheel> wheels;
  std::vector<Anchor> blocks;  ///< where the body is a slider
  std::vector<std::vector<Vec2>> cams;   ///< their outlines
  std::vector<Wheel> rollers;            ///< on cams and edges; radius 0: a pin
  std::vector<std::vector<Vec2>> faces;  ///< flat faces on cams, edges: polylines
};

class SceneMaker {
 public:
  SceneMaker(const Model& model, const Trajectory& trajectory);
  Scene make();

 private:
  enum Layer { kBack, kWheels, kPlates, kBars, kHoles, kBlocks, kPins, kMarks, kLayers };

  // scene.cpp
  void measure();
  void add_points();
  void add_labels();
  void add_connectors();
  void add_arrows();
  double largest_load() const;  ///< of the applied forces [N]
  void scale_arrows();
  std::optional<Anchor> find(const MarkerRef& ref) const;  ///< empty: its body was not recorded
  Pose pose(int body, std::size_t row) const;
  std::optional<MovingPoint> spot_of(const Joint& joint) const;  ///< where its force acts
  Vec2 place(const MovingPoint& spot, std::size_t row) const;
  /// Of an arrow with these columns [N].
  Vec2 force_in_row(std::size_t row, int fx, int fy) const {
    return {trajectory_.at(row, static_cast<std::size_t>(fx)), trajectory_.at(row, static_cast<std::size_t>(fy))};
  }
  Vec2 towards_rack(const Anchor& pinion, const Anchor& rack) const;
  void put(Layer layer, Shape shape) { layers_[layer].push_back(std::move(shape)); }
  std::size_t drawable_rows() const;
  std::vector<std::size_t> sample_rows(std::size_t most) const;

  // scene_bodies.cpp
  void add_body(int body);
  void add_tracks(int body, const BodySketch& sketch);
  void add_link(int body, const BodySketch& sketch);
  void add_lone_link(int body, const Vec2& pin);
  void add_wheels(int body, const BodySketch& sketch);
  void add_cams(int body, const BodySketch& sketch);
  void add_rack_teeth(int body, const Track& track);
  void add_block(const Anchor& at);
  void add_mass_mark(int body);
  double gyration(int body) const;  ///< radius [m]

  // scene_joints.cpp
  void sketch_joints();
  void sketch_slider(const Joint& joint, const Anchor& first, const Anchor& second);
  void sketch_rack(const Joint& joint, const Anchor& first, const Anchor& second);
  void sketch_discs(const Joint& joint, const Anchor& first, const Anchor& second);
  void sketch_cam(const Joint& joint, const Anchor& first, const Anchor& second);
  void sketch_straight_edge(const Joint& joint, const Anchor& first, const Anchor& second);
  void sketch_edge(const Joint& joint, const Anchor& first, const Anchor& second);
  static constexpr double kThick = 0.5;  ///< thickness of faces and edges [units]
  BodySketch& sketch_of(int body) { return body == kWorld ? ground_ : sketches_[static_cast<std::size_t>(body)]; }
  void show(int body, const Track& track);
  void show(int body, const Vec2& centre, double radius);
  void add_joint(const Joint& joint);
  void add_ground_pin(const Vec2& at, int body);
  Vec2 usual_way(const Vec2& from, int body) const;
  void add_ground_ways(const Track& track);
  void add_ground_slots();
  void add_ground_end(const Anchor& end, const Anchor& other);
  void add_wall(const Vec2& at, const Vec2& out);
  void add_weld(const Anchor& at);
  void add_motor(const Motor& motor);
  void add_stops(const Joint& joint);
  void add_spiral(const Anchor& at);
  void hatch(const Vec2& from, const Vec2& to, const Vec2& side);
  Track slide_range(const Anchor& guide, const Anchor& block) const;
  bool first_at(const Vec2& at, std::vector<Vec2>& known) const;  ///< true if nothing is there yet; the place is then remembered

  // scene_bearings.cpp
  void add_bearing_ring(const Joint& joint, const Anchor& bush);

  // scene_flexures.cpp
  bool add_flexure(const Joint& joint, const Anchor& first, const Anchor& second);  ///< false: not a flexure law
  void add_blade(const std::string& name, const Anchor& first, const Anchor& second, double length);
  void add_neck(const Anchor& at);

  const Model& model_;
  const Trajectory& trajectory_;
  ColumnIndex columns_;
  std::map<std::string, int> body_index_;
  std::vector<BodySketch> sketches_;  // per body
  BodySketch ground_;
  std::vector<Vec2> ground_pins_, ground_ends_;
  std::vector<std::vector<Shape>> layers_;
  Scene scene_;
};

}  // namespace pintle

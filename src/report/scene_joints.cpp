// How joints are drawn: pins, supports, guides, slots, meshes, welds; and the motors and springs in them.
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "joints/cam_profile.h"
#include "joints/edge_profile.h"
#include "report/outline.h"
#include "report/scene_maker.h"

namespace pintle {
namespace {

bool is_ground(const MarkerRef& ref) { return ref.body == "ground"; }

}  // namespace

bool SceneMaker::first_at(const Vec2& at, std::vector<Vec2>& known) const {
  if (std::any_of(known.begin(), known.end(), [&](const Vec2& p) { return length(p - at) < 0.3 * scene_.unit; })) return false;
  known.push_back(at);
  return true;
}

void SceneMaker::sketch_joints() {
  for (const Joint& joint : model_.joints) {
    const auto first = find(joint.first), second = find(joint.second);
    if (!first || !second) continue;
    if (joint.type == "slot" && joint.law.word == "contact") sketch_straight_edge(joint, *first, *second);
    else if (joint.type == "prismatic" || joint.type == "slot") sketch_slider(joint, *first, *second);
    if (joint.type == "rack") sketch_rack(joint, *first, *second);
    if (joint.type == "belt") sketch_discs(joint, *first, *second);
    if (joint.cam) sketch_cam(joint, *first, *second);
    if (joint.edge) sketch_edge(joint, *first, *second);
    if (joint.type != "gear") continue;
    const auto radius = [&joint](const char* key) { return joint.geometry.contains(key) ? joint.geometry.at(key) : 0.0; };
    const bool internal = radius("internal") > 0;
    const double a = radius("radius_first"), b = radius("radius_second");
    if (first->body != kWorld) sketches_[static_cast<std::size_t>(first->body)].wheels.push_back({first->point, a, internal && a > b});
    else ground_.wheels.push_back({first->point, a, internal && a > b});
    if (second->body != kWorld) sketches_[static_cast<std::size_t>(second->body)].wheels.push_back({second->point, b, internal && b > a});
    else ground_.wheels.push_back({second->point, b, internal && b > a});
  }
}

// The runs of a belt share their discs, so each disc is added only once.
void SceneMaker::sketch_discs(const Joint& joint, const Anchor& first, const Anchor& second) {
  const auto add = [&](const Anchor& at, const char* key) {
    const auto radius = joint.geometry.find(key);
    if (radius == joint.geometry.end() || !(radius->second > 0)) return;
    std::vector<Wheel>& wheels = sketch_of(at.body).wheels;
    const auto same = [&](const Wheel& wheel) { return wheel.radius == radius->second && wheel.centre == at.point; };
    if (std::none_of(wheels.begin(), wheels.end(), same)) wheels.push_back({at.point, radius->second, false});
    if (at.body == kWorld) scene_.box.cover(at.point, radius->second + 2 * scene_.unit);
  };
  add(first, "first_radius");
  add(second, "second_radius");
}

Track SceneMaker::slide_range(const Anchor& guide, const Anchor& block) const {
  const Vec2 along = direction(guide.axis);
  double low = 0, high = 0;
  bool first = true;
  for (const std::size_t row : sample_rows(400)) {
    const Vec2 at = pose(guide.body, row).local(pose(block.body, row).world(block.point));
    const double s = dot(at - guide.point, along);
    if (!std::isfinite(s)) continue;
    low = first ? s : std::min(low, s);
    high = first ? s : std::max(high, s);
    first = false;
  }
  return {guide.point + low * along, guide.point + high * along};
}

// The guide is the ground if either body is the ground, else the first body, whose axes are the joint's.
void SceneMaker::sketch_slider(const Joint& joint, const Anchor& first, const Anchor& second) {
  const bool slot = joint.type == "slot", turned = !slot && is_ground(joint.second) && !is_ground(joint.first);
  const Anchor &guide = turned ? second : first, &block = turned ? first : second;
  Track track = slide_range(guide, block);
  const Vec2 along = direction(guide.axis);
  const double room = (slot ? 0.5 : 2.9) * scene_.unit;
  track.from = track.from - room * along;
  track.to = track.to + room * along;
  track.kind = slot ? Track::kSlot : Track::kGuide;
  (guide.body == kWorld ? ground_ : sketches_[static_cast<std::size_t>(guide.body)]).tracks.push_back(track);
  show(guide.body, track);
  if (!slot && block.body != kWorld) sketches_[static_cast<std::size_t>(block.body)].blocks.push_back(block);
}

/// Extends the picture so that it contains the track at every position of its body.
void SceneMaker::show(int body, const Track& track) {
  for (const std::size_t row : sample_rows(100))
    for (const Vec2& end : {track.from, track.to}) scene_.box.cover(pose(body, row).world(end), 2.5 * scene_.unit);
}

void SceneMaker::show(int body, const Vec2& centre, double radius) {
  for (const std::size_t row : sample_rows(100)) scene_.box.cover(pose(body, row).world(centre), radius + scene_.unit);
}

/// Unit vector from the pinion towards its rack, in the rack's axes.
Vec2 SceneMaker::towards_rack(const Anchor& pinion, const Anchor& rack) const {
  const Vec2 centre = pose(rack.body, 0).local(pose(pinion.body, 0).world(pinion.point)), side = normal(direction(rack.axis));
  return dot(centre - rack.point, side) > 0 ? -1.0 * side : side;
}

void SceneMaker::sketch_rack(const Joint& joint, const Anchor& first, const Anchor& second) {
  Track track = slide_range(second, first);
  const double radius = joint.geometry.contains("radius") ? joint.geometry.at("radius") : 0;
  const Vec2 along = direction(second.axis), room = (0.8 * radius + 2 * scene_.unit) * along;
  track.from = track.from - room;
  track.to = track.to + room;
  track.kind = Track::kRack;
  track.other_side = towards_rack(first, second);
  (second.body == kWorld ? ground_ : sketches_[static_cast<std::size_t>(second.body)]).tracks.push_back(track);
  show(second.body, track);
  if (first.body != kWorld) sketches_[static_cast<std::size_t>(first.body)].wheels.push_back({first.point, radius, false});
}

void SceneMaker::add_joint(const Joint& joint) {
  const auto first = find(joint.first), second = find(joint.second);
  if (!first || !second) return;
  const double u = scene_.unit;
  if (joint.type == "revolute") {
    if (first->body == kWorld) add_ground_pin(first->point, second->body);
    else if (second->body == kWorld) add_ground_pin(second->point, first->body);
    add_bearing_ring(joint, *first);
    put(kPins, {Form::kCircle, Paint::kPin, second->body == kWorld ? first->body : second->body,
                {{second->body == kWorld ? first->point : second->point}}, 0.5 * u});
  } else if (joint.type == "slot") {
    put(kPins, {Form::kCircle, Paint::kPin, second->body, {{second->point}}, 0.5 * u});
  } else if (joint.type == "fixed" && !add_flexure(joint, *first, *second)) {
    if (first->body == kWorld || second->body == kWorld) {
      const Anchor &wall = first->body == kWorld ? *first : *second, &held = first->body == kWorld ? *second : *first;
      const Pose at = pose(held.body, 0);
      add_wall(wall.point, unit(Vec2{at.x, at.y} - wall.point));
    }
    add_weld(second->body == kWorld ? *first : *second);
  }
}

void SceneMaker::add_weld(const Anchor& at) {
  const double u = scene_.unit;
  put(kPins, {Form::kArea, Paint::kWeld, at.body, {rectangle(at.point, direction(at.axis), {0.45 * u, 0.45 * u})}});
}

/// Short strokes from the line towards `side` (of length 1).
void SceneMaker::hatch(const Vec2& from, const Vec2& to, const Vec2& side) {
  const double u = scene_.unit, total = length(to - from);
  const int n = std::clamp(static_cast<int>(std::lround(total / (0.75 * u))), 3, 300);
  const Vec2 along = unit(to - from), stroke = 0.75 * u * (side - 0.8 * along);
  Shape lines{Form::kLine, Paint::kHatch, kWorld, {}};
  for (int i = 0; i < n; ++i) {
    const Vec2 start = from + total * (i + 0.8) / n * along;
    lines.paths.push_back({start, start + stroke});
  }
  put(kBack, std::move(lines));
  put(kBack, {Form::kLine, Paint::kEarth, kWorld, {{from, to}}});
}

/// Average direction of a body from a point of the ground: of length 1 if the direction never changes.
Vec2 SceneMaker::usual_way(const Vec2& from, int body) const {
  Vec2 sum{0, 0};
  const std::vector<std::size_t> rows = sample_rows(60);
  for (const std::size_t row : rows) {
    const Pose at = pose(body, row);
    if (const Vec2 d = Vec2{at.x, at.y} - from; length(d) > 0.1 * scene_.unit) sum = sum + 1.0 / static_cast<double>(rows.size()) * unit(d);
  }
  return sum;
}

// A support: a triangle on hatched ground, below the pin as gravity points, or above the pin if the body hangs from it.
void SceneMaker::add_ground_pin(const Vec2& at, int body) {
  if (!first_at(at, ground_pins_)) return;
  constexpr double kHangs = 0.35;
  const double u = scene_.unit;
  const Vec2 g = model_.gravity;
  Vec2 down = length(g) > 0 ? unit(g) : Vec2{0, -1};
  if (dot(usual_way(at, body), down) > kHangs) down = -1.0 * down;
  const Vec2 across = normal(down);
  const Vec2 base = at + 2.1 * u * down;
  put(kBack, {Form::kArea, Paint::kEarth, kWorld, {{at, base + 1.25 * u * across, base - 1.25 * u * across}}});
  hatch(base - 1.9 * u * across, base + 1.9 * u * across, down);
}

void SceneMaker::add_wall(const Vec2& at, const Vec2& out) {
  const double u = scene_.unit;
  hatch(at - 2.2 * u * normal(out), at + 2.2 * u * normal(out), -1.0 * out);
}

/// The hatching where a spring, a rod or a rope is attached to the ground.
void SceneMaker::add_ground_end(const Anchor& end, const Anchor& other) {
  if (!first_at(end.point, ground_ends_)) return;
  if (std::any_of(ground_pins_.begin(), ground_pins_.end(), [&](const Vec2& p) { return length(p - end.point) < 0.3 * scene_.unit; })) return;
  const Vec2 out = unit(pose(other.body, 0).world(other.point) - end.point);
  // The nearest of the four axis directions looks best.
  const Vec2 main = std::abs(out[0]) > std::abs(out[1]) ? Vec2{std::copysign(1.0, out[0]), 0} : Vec2{0, std::copysign(1.0, out[1])};
  const double u = scene_.unit;
  hatch(end.point - 1.6 * u * normal(main), end.point + 1.6 * u * normal(main), -1.0 * main);
}

void SceneMaker::add_ground_ways(const Track& track) {
  const double half = 1.3 * scene_.unit;
  const Vec2 across = normal(unit(track.to - track.from));
  hatch(track.from + half * across, track.to + half * across, across);
  hatch(track.to - half * across, track.from - half * across, -1.0 * across);
}

void SceneMaker::sketch_cam(const Joint& joint, const Anchor& first, const Anchor& second) {
  constexpr int kPoints = 240;
  const CamProfile profile(*joint.cam);
  const Vec2 x = direction(first.axis), y = normal(x);
  std::vector<Vec2> outline;
  double size = 0, reach = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Planar::Point p = profile.surface(2 * kPi * i / kPoints);
    outline.push_back(first.point + p[0] * x + p[1] * y);
    size = std::max(size, p.norm());
    reach = std::max(reach, std::abs(profile.radius(2 * kPi * i / kPoints)[1]));
  }
  sketch_of(first.body).cams.push_back(std::move(outline));
  show(first.body, first.point, size);
  if (!joint.cam->flat) {
    sketch_of(second.body).rollers.push_back({second.point, joint.cam->roller_radius});
    show(second.body, second.point, joint.cam->roller_radius);
    return;
  }
  const Vec2 along = (1.1 * reach + scene_.unit) * direction(second.axis);  // the contact's offset along the face is the slope of the lift
  sketch_of(second.body).faces.push_back({second.point - along, second.point + along});
  show(second.body, second.point, length(along));
}

// Extends from its marker, where it is attached to its body, as far as anything that rests on it or flies over it gets.
void SceneMaker::sketch_straight_edge(const Joint& joint, const Anchor& first, const Anchor& second) {
  const auto stated = joint.law.values.find("pin_radius");
  const double radius = stated != joint.law.values.end() && !stated->second.empty() ? stated->second.front() : 0;
  const Vec2 along = direction(first.axis);
  Track reach = slide_range(first, second);
  if (dot(reach.from - first.point, along) > 0) reach.from = first.point;
  if (dot(reach.to - first.point, along) < 0) reach.to = first.point;
  const Vec2 room = (radius + 2 * scene_.unit) * along, below = -0.5 * kThick * scene_.unit * normal(along);
  sketch_of(first.body).faces.push_back({reach.from - room + below, reach.to + room + below});
  show(first.body, {reach.from - room, reach.to + room});
  sketch_of(second.body).rollers.push_back({second.point, radius});
  show(second.body, second.point, radius);
}

// The upper side of the drawn band is the edge.
void SceneMaker::sketch_edge(const Joint& joint, const Anchor& first, const Anchor& second) {
  constexpr int kPoints = 240;
  const EdgeProfile profile(*joint.edge);
  const Vec2 x = direction(first.axis), y = normal(x);
  std::vector<Vec2> line;
  for (int i = 0; i <= kPoints; ++i) {
    const CurvePoint at = profile.at(profile.from() + (profile.to() - profile.from()) * i / kPoints);
    const Planar::Point below = at.p - 0.5 * kThick * scene_.unit * at.normal();
    line.push_back(first.point + below[0] * x + below[1] * y);
    show(first.body, line.back(), 0);
  }
  sketch_of(first.body).faces.push_back(std::move(line));
  sketch_of(second.body).rollers.push_back({second.point, profile.roller_radius()});
  show(second.body, second.point, profile.roller_radius());
}

// Fixed tracks and wheels. Crossing slots become one opening.
void SceneMaker::add_ground_slots() {
  const double u = scene_.unit;
  Shape frame{Form::kBar, Paint::kEarth, kWorld, {}, 2.5 * u}, opening{Form::kBar, Paint::kHole, kWorld, {}, 1.15 * u};
  for (const Track& track : ground_.tracks) {
    if (track.kind == Track::kGuide) add_ground_ways(track);
    if (track.kind == Track::kRack) {
      const Vec2 off = 1.05 * u * track.other_side;
      put(kBack, {Form::kBar, Paint::kEarth, kWorld, {{track.from + off, track.to + off}}, 1.5 * u});
      add_rack_teeth(kWorld, track);
    }
    if (track.kind != Track::kSlot) continue;
    frame.paths.push_back({track.from, track.to});
    opening.paths.push_back({track.from, track.to});
  }
  // Rings first, because other wheels are inside them.
  std::stable_partition(ground_.wheels.begin(), ground_.wheels.end(), [](const Wheel& wheel) { return wheel.ring; });
  for (const Wheel& wheel : ground_.wheels) {
    put(kBack, {Form::kCircle, Paint::kEarth, kWorld, {{wheel.centre}}, wheel.radius + (wheel.ring ? 1.6 : 0.3) * u});
    if (wheel.ring) put(kBack, {Form::kCircle, Paint::kHole, kWorld, {{wheel.centre}}, wheel.radius - 0.3 * u});
    put(kBack, {Form::kCircle, Paint::kPitch, kWorld, {{wheel.centre}}, wheel.radius});
  }
  if (!ground_.cams.empty()) put(kBack, {Form::kArea, Paint::kEarth, kWorld, ground_.cams});
  if (!ground_.faces.empty()) put(kBack, {Form::kBar, Paint::kEarth, kWorld, ground_.faces, kThick * u});
  for (const Wheel& roller : ground_.rollers) put(kBack, {Form::kCircle, Paint::kEarth, kWorld, {{roller.centre}}, std::max(roller.radius, 0.25 * u)});
  if (frame.paths.empty()) return;
  put(kBack, std::move(frame));
  put(kBack, std::move(opening));
}

// A rotary motor: three quarters of a turn around its pin, with a head; a linear one: a straight double arrow.
void SceneMaker::add_motor(const Motor& motor) {
  const auto joint = std::find_if(model_.joints.begin(), model_.joints.end(), [&](const Joint& j) { return j.name == motor.joint; });
  if (joint == model_.joints.end()) return;
  const auto at = find(joint->first), second = find(joint->second);
  if (!at || !second) return;
  const double u = scene_.unit;
  Shape shaft{Form::kLine, Paint::kMotor, at->body, {}}, heads{Form::kArea, Paint::kMotor, at->body, {}};
  const auto head = [&](const Vec2& tip, const Vec2& along) {
    heads.paths.push_back({tip, tip - 0.8 * u * along + 0.38 * u * normal(along), tip - 0.8 * u * along - 0.38 * u * normal(along)});
  };
  if (joint->type == "revolute") {
    const double r = 1.7 * u, end = 1.25 * kPi;
    shaft.paths.push_back(arc(at->point, r, -0.2 * kPi, end - 0.3));
    head(at->point + r * direction(end), unit(normal(direction(end - 0.2))));
  } else {
    const Anchor slider = joint->second.body == "ground" ? *at : *second;
    shaft.body = heads.body = slider.body;
    const Vec2 along = direction(slider.axis), from = slider.point + 1.9 * u * normal(along);
    shaft.paths.push_back({from - 1.2 * u * along, from + 1.2 * u * along});
    head(from + 1.9 * u * along, along);
    head(from - 1.9 * u * along, -1.0 * along);
  }
  put(kMarks, std::move(shaft));
  put(kMarks, std::move(heads));
}

// At each stop, a stroke across the slide, or one pointing away from the pin, in the axes of the first body, in which the coordinate is measured. The stroke
// of an angle marks where the stop halts the centre of the second body.
void SceneMaker::add_stops(const Joint& joint) {
  const auto first = find(joint.first), second = find(joint.second);
  if (joint.stops.word.empty() || joint.type == "cylinder" || !first || !second) return;
  const double u = scene_.unit;
  const bool turns = joint.type == "revolute";
  const bool centred = length(second->point) < 1e-6 * u || second->body == kWorld;
  const double centre = centred ? 0 : std::atan2(-second->point[1], -second->point[0]) - second->axis;
  Shape marks{Form::kLine, Paint::kStop, first->body, {}};
  for (const char* key : {"lower_stop", "upper_stop"}) {
    const auto stop = joint.stops.values.find(key);
    if (stop == joint.stops.values.end()) continue;
    const double at = stop->second.front();
    const Vec2 along = direction(turns ? first->axis + at + centre : first->axis), across = normal(along);
    if (turns) marks.paths.push_back({first->point + 1.2 * u * along, first->point + 3.4 * u * along});
    else marks.paths.push_back({first->point + at * along - 1.3 * u * across, first->point + at * along + 1.3 * u * across});
  }
  put(kMarks, std::move(marks));
}

void SceneMaker::add_spiral(const Anchor& at) {
  std::vector<Vec2> spiral;
  constexpr int kTurns = 3, kPerTurn = 24;
  for (int i = 0; i <= kTurns * kPerTurn; ++i) {
    const double share = static_cast<double>(i) / (kTurns * kPerTurn);
    spiral.push_back(at.point + (0.6 + 1.3 * share) * scene_.unit * direction(at.axis + 2 * kPi * kTurns * share));
  }
  put(kMarks, {Form::kLine, Paint::kSpring, at.body, {std::move(spiral)}});
}

}  // namespace pintle

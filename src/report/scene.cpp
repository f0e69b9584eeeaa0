#include "report/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "joints/belt.h"
#include "joints/catalog.h"
#include "report/outline.h"
#include "report/scene_maker.h"

namespace pintle {
namespace {

constexpr double kSymbolOfBox = 0.021, kSymbolOfSpan = 0.11, kSymbolOfShortest = 0.24;
constexpr double kSymbolAtLeast = 0.007;  // of the box. A trough of a metre on an eccentric of 5 mm: with half of it supports are specks, with twice it the pin hides the eccentric
constexpr double kArrowOfBox = 0.2;  // of the geometric mean of the box's sides

double distance(const Vec2& a, const Vec2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

double span(const std::vector<Vec2>& points) {
  double largest = 0;
  for (const Vec2& a : points)
    for (const Vec2& b : points) largest = std::max(largest, distance(a, b));
  return largest;
}

// The piston stays inside the barrel at both ends of the stroke, as far as a single stage allows.
double barrel_length(double closed_length, double stroke) { return std::clamp((closed_length + stroke) / 2, 0.93 * closed_length, closed_length); }

}  // namespace

void Box::cover(const Vec2& p, double around) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (!std::isfinite(p[k])) continue;
    low[k] = std::min(low[k], p[k] - around);
    high[k] = std::max(high[k], p[k] + around);
  }
}

SceneMaker::SceneMaker(const Model& model, const Trajectory& trajectory)
    : model_(model), trajectory_(trajectory), columns_(trajectory.columns), layers_(kLayers) {
  sketches_.resize(model.bodies.size());
  for (const Body& body : model.bodies) {
    const std::string p = "body." + body.name + ".";
    body_index_[body.name] = static_cast<int>(scene_.bodies.size());
    scene_.bodies.push_back({body.name, columns_.find(p + "x"), columns_.find(p + "y"), columns_.find(p + "angle")});
    if (!scene_.bodies.back().recorded()) ++scene_.n_unseen;
  }
}

Scene SceneMaker::make() {
  if (trajectory_.n_rows() == 0) return std::move(scene_);
  const double span = trajectory_.at(trajectory_.n_rows() - 1, 0) - trajectory_.at(0, 0), step = span / static_cast<double>(trajectory_.n_rows());
  if (step > 0) scene_.time_decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(step))), 2, 9);
  add_points();
  measure();
  sketch_joints();
  for (std::size_t i = 0; i < model_.bodies.size(); ++i)
    if (scene_.bodies[i].recorded()) add_body(static_cast<int>(i));
  for (const Joint& joint : model_.joints) {
    add_joint(joint);
    add_stops(joint);
  }
  add_ground_slots();
  for (const Motor& motor : model_.motors) add_motor(motor);
  add_connectors();
  add_labels();
  add_arrows();
  scale_arrows();
  for (std::vector<Shape>& layer : layers_)
    std::move(layer.begin(), layer.end(), std::back_inserter(scene_.shapes));
  return std::move(scene_);
}

std::optional<Anchor> SceneMaker::find(const MarkerRef& ref) const {
  const bool world = ref.body == "ground";
  const auto body = world ? body_index_.end() : body_index_.find(ref.body);
  if (!world && (body == body_index_.end() || !scene_.bodies[static_cast<std::size_t>(body->second)].recorded()))
    return std::nullopt;
  const std::vector<Marker>& markers = world ? model_.ground : model_.bodies[static_cast<std::size_t>(body->second)].markers;
  for (const Marker& marker : markers)
    if (marker.name == ref.marker) return Anchor{world ? kWorld : body->second, marker.position, marker.axis};
  return std::nullopt;
}

Pose SceneMaker::pose(int body, std::size_t row) const {
  return body == kWorld ? Pose{} : pose_of(scene_.bodies[static_cast<std::size_t>(body)], trajectory_, row);
}

// A failed run may end in an unbounded motion, which must not determine the extent of the picture.
std::size_t SceneMaker::drawable_rows() const {
  const std::size_t n = trajectory_.n_rows();
  return trajectory_.outcome == Outcome::kFailed && n > 3 ? n - 1 - n / 50 : n;
}

std::vector<std::size_t> SceneMaker::sample_rows(std::size_t most) const {
  const std::size_t n = drawable_rows(), step = std::max<std::size_t>(1, n / std::max<std::size_t>(1, most));
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < n; i += step) rows.push_back(i);
  if (rows.back() + 1 != n) rows.push_back(n - 1);
  return rows;
}

void SceneMaker::add_points() {
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    if (!scene_.bodies[i].recorded()) continue;
    std::vector<Vec2>& points = sketches_[i].points;
    for (const Marker& marker : model_.bodies[i].markers) {
      scene_.points.push_back({model_.bodies[i].name + "." + marker.name, {{static_cast<int>(i), marker.position, marker.axis}}});
      points.push_back(marker.position);
    }
    const double near = 1e-6 * span(points);
    std::vector<Vec2> apart;
    for (const Vec2& p : points)
      if (std::none_of(apart.begin(), apart.end(), [&](const Vec2& q) { return distance(p, q) <= near; })) apart.push_back(p);
    points = std::move(apart);
  }
}

void SceneMaker::measure() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (const Joint& joint : model_.joints)
    for (const MarkerRef* ref : {&joint.first, &joint.second})
      if (const auto at = find(*ref); at && at->body == kWorld) box.cover(at->point);
  for (const Spring& spring : model_.springs)
    for (const MarkerRef* ref : {&spring.first, &spring.second})
      if (const auto at = find(*ref); at && at->body == kWorld) box.cover(at->point);
  std::vector<double> spans;
  for (std::size_t i = 0; i < sketches_.size(); ++i) {
    if (!scene_.bodies[i].recorded()) continue;
    const std::vector<Vec2>& points = sketches_[i].points;
    if (const double s = span(points); s > 0) spans.push_back(s);
    for (const std::size_t row : sample_rows(400)) {
      const Pose at = pose(static_cast<int>(i), row);
      for (const Vec2& p : points) box.cover(at.world(p));
      if (points.size() < 2) box.cover({at.x, at.y});
    }
  }
  if (!(box.low[0] <= box.high[0] && box.low[1] <= box.high[1])) box = {{-0.5, -0.5}, {0.5, 0.5}};
  const double size = std::max({box.width(), box.height(), 1e-9});
  double unit = kSymbolOfBox * size;
  if (!spans.empty()) {
    std::sort(spans.begin(), spans.end());
    unit = std::min({unit, kSymbolOfSpan * spans[spans.size() / 2], kSymbolOfShortest * spans.front()});
  }
  scene_.unit = std::max(unit, kSymbolAtLeast * size);
  const double margin = 3 * scene_.unit;
  scene_.box = {{box.low[0] - margin, box.low[1] - margin}, {box.high[0] + margin, box.high[1] + margin}};
}

void SceneMaker::add_connectors() {
  const auto connect = [this](const std::string& name, const MarkerRef& first, const MarkerRef& second, Paint paint) {
    const auto a = find(first), b = find(second);
    if (!a || !b) return;
    const double apart = distance(pose(a->body, 0).world(a->point), pose(b->body, 0).world(b->point));
    const int teeth = paint == Paint::kSpring ? std::clamp(static_cast<int>(apart / (0.55 * scene_.unit)), 8, 24) : 0;
    scene_.connectors.push_back({name, paint, *a, *b, teeth});
    const double pin = (paint == Paint::kSpring ? 0.24 : 0.36) * scene_.unit;
    for (const auto& end : {*a, *b}) put(kPins, {Form::kCircle, Paint::kPin, end.body, {{end.point}}, pin});
    if (a->body == kWorld) add_ground_end(*a, *b);
    if (b->body == kWorld) add_ground_end(*b, *a);
  };
  for (const Joint& joint : model_.joints) {
    if (joint.type == "rod") connect(joint.name, joint.first, joint.second, Paint::kRod);
    if (joint.type == "rope") connect(joint.name, joint.first, joint.second, Paint::kRope);
    const auto belt = belt_of(find_joint_type(joint.type)->make(joint.geometry));
    const bool cylinder = joint.type == "cylinder";
    if (!belt && !cylinder) continue;
    const std::size_t before = scene_.connectors.size();
    connect(joint.name, joint.first, joint.second, belt ? Paint::kRope : Paint::kBarrel);
    for (std::size_t i = before; i < scene_.connectors.size(); ++i) {
      if (belt) scene_.connectors[i].radii = {belt->radius_first, belt->radius_second};
      else scene_.connectors[i].length = barrel_length(joint.geometry.at("closed_length"), joint.geometry.at("stroke"));
    }
  }
  for (const Spring& spring : model_.springs) {
    if (!spring.torsion) connect(spring.name, spring.first, spring.second, Paint::kSpring);
    else if (const auto at = find(spring.second)) add_spiral(*at);
  }
}

// A gear mesh acts where the pitch circles touch, a rack where its pitch line touches the pinion's circle, every other joint at the second marker.
std::optional<MovingPoint> SceneMaker::spot_of(const Joint& joint) const {
  const auto first = find(joint.first), second = find(joint.second);
  if (!second) return first ? std::optional(MovingPoint{*first}) : std::nullopt;
  if (first && joint.type == "rack") return MovingPoint{*first, *second, 0, joint.geometry.at("radius") * towards_rack(*first, *second)};
  if (joint.type != "gear" || !first) return MovingPoint{*second};
  const double a = joint.geometry.at("radius_first"), b = joint.geometry.at("radius_second");
  const bool internal = joint.geometry.contains("internal") && joint.geometry.at("internal") > 0;
  const double apart = internal ? a - b : a + b;
  return apart == 0 ? MovingPoint{*second} : MovingPoint{*first, *second, a / apart};
}

Vec2 SceneMaker::place(const MovingPoint& spot, std::size_t row) const {
  return place_of(spot, pose(spot.at.body, row), pose(spot.toward.body, row));
}

// Joints at the same place share a label.
void SceneMaker::add_labels() {
  const std::size_t middle = trajectory_.n_rows() / 2;
  struct Known {
    Vec2 start, middle;
  };
  std::vector<Known> known;
  for (const Joint& joint : model_.joints) {
    const auto at = spot_of(joint);
    if (!at || joint.type == "rod" || joint.type == "rope" || joint.type == "belt") continue;
    const Known here{place(*at, 0), place(*at, middle)};
    const auto same = std::find_if(known.begin(), known.end(), [&](const Known& other) {
      return distance(here.start, other.start) < scene_.unit && distance(here.middle, other.middle) < scene_.unit;
    });
    if (same != known.end()) {
      scene_.labels[static_cast<std::size_t>(same - known.begin())].name += ", " + joint.name;
    } else {
      known.push_back(here);
      scene_.labels.push_back({joint.name, *at});
    }
  }
}

void SceneMaker::add_arrows() {
  for (const Joint& joint : model_.joints) {
    const auto at = spot_of(joint);
    const std::string p = "joint." + joint.name + ".on_" + joint.second.body + ".";
    const int fx = columns_.find(p + "fx[world]"), fy = columns_.find(p + "fy[world]");
    if (at && fx >= 0 && fy >= 0) scene_.arrows.push_back({joint.name, joint.second.body, *at, fx, fy});
    const auto first = find(joint.first), second = find(joint.second);
    if (joint.type == "revolute" && first && second) scene_.pins.push_back({joint.name, *first, *second, joint.first, joint.second});
  }
  for (const AppliedForce& load : model_.forces) {
    const auto at = find(load.on);
    const std::string p = "force." + load.name + ".";
    const int fx = columns_.find(p + "fx[world]"), fy = columns_.find(p + "fy[world]");
    if (at && fx >= 0 && fy >= 0) scene_.loads.push_back({load.name, *at, fx, fy});
  }
}

double SceneMaker::largest_load() const {
  double largest = 0;
  for (const std::size_t row : sample_rows(400))
    for (const LoadArrow& load : scene_.loads) {
      const Vec2 f = force_in_row(row, load.fx, load.fy);
      if (const double size = std::hypot(f[0], f[1]); std::isfinite(size)) largest = std::max(largest, size);
    }
  return largest;
}

// A momentary shock must not shrink the arrows of the whole run: if the peak is far above the RMS, the scale follows the RMS.
void SceneMaker::scale_arrows() {
  constexpr double kPeakOfRms = 3;
  double peak = 0, rms = 0;
  for (const LoadSummary& joint : trajectory_.joints) {
    if (std::isfinite(joint.peak)) peak = std::max(peak, joint.peak);
    if (std::isfinite(joint.rms)) rms = std::max(rms, joint.rms);
  }
  scene_.arrow_force = std::min(peak, kPeakOfRms * rms);
  if (!(scene_.arrow_force > 0)) scene_.arrow_force = largest_load();
  scene_.arrow_length = kArrowOfBox * std::sqrt(std::max(scene_.box.width() * scene_.box.height(), 1e-18));
  if (!(scene_.arrow_force > 0)) return;
  const auto show_tip = [this](const Vec2& at, const Vec2& f) {
    const double force = std::hypot(f[0], f[1]), size = std::min(force / scene_.arrow_force, Scene::kLongestArrow) * scene_.arrow_length;
    if (std::isfinite(force) && force > 0) scene_.box.cover({at[0] + size * f[0] / force, at[1] + size * f[1] / force});
  };
  for (const std::size_t row : sample_rows(400)) {
    for (const ForceArrow& arrow : scene_.arrows) show_tip(place(arrow.at, row), force_in_row(row, arrow.fx, arrow.fy));
    for (const LoadArrow& load : scene_.loads) show_tip(place(MovingPoint{load.at}, row), force_in_row(row, load.fx, load.fy));
  }
}

Scene make_scene(const Model& model, const Trajectory& trajectory) {
  if (model.space != "planar") throw std::invalid_argument("only planar mechanisms can be drawn");
  return SceneMaker(model, trajectory).make();
}

}  // namespace pintle

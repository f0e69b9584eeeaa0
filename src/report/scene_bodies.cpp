// How bodies are drawn: links, plates, bobs, wheels, sliders.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "report/outline.h"
#include "report/scene_maker.h"

namespace pintle {
namespace {

constexpr double kLinkWidth = 1.5, kSlottedWidth = 2.5, kRodWidth = 0.8, kSlotWidth = 1.15;  // units

}  // namespace

double SceneMaker::gyration(int body) const {
  const Body& b = model_.bodies[static_cast<std::size_t>(body)];
  return b.mass > 0 ? std::sqrt(b.inertia / b.mass) : 0;
}

void SceneMaker::add_body(int body) {
  const BodySketch& sketch = sketches_[static_cast<std::size_t>(body)];
  add_wheels(body, sketch);
  add_cams(body, sketch);
  if (!sketch.tracks.empty()) add_tracks(body, sketch);
  else add_link(body, sketch);
  for (const Anchor& block : sketch.blocks) add_block(block);
  add_mass_mark(body);
}

// A body that guides another: its tracks, joined together, and an arm from each of its other points to the nearest place on a track.
void SceneMaker::add_tracks(int body, const BodySketch& sketch) {
  const double u = scene_.unit;
  const bool slotted = std::any_of(sketch.tracks.begin(), sketch.tracks.end(), [](const Track& t) { return t.kind == Track::kSlot; });
  Shape bar{Form::kBar, Paint::kLink, body, {}, (slotted ? kSlottedWidth : kLinkWidth) * u};
  Shape rods{Form::kBar, Paint::kGuide, body, {}, kRodWidth * u};
  for (const Track& track : sketch.tracks) {
    const Vec2 off = track.kind == Track::kRack ? (0.5 * kLinkWidth * u + 0.3 * u) * track.other_side : Vec2{0, 0};
    (track.kind == Track::kGuide ? rods : bar).paths.push_back({track.from + off, track.to + off});
    if (track.kind == Track::kRack) add_rack_teeth(body, track);
    if (track.kind == Track::kSlot)
      put(kHoles, {Form::kBar, Paint::kHole, body, {{track.from, track.to}}, kSlotWidth * u});
  }
  // Adds an arm from whichever of these places is nearest to the first `tracks` tracks.
  const auto join = [&](const std::vector<Vec2>& places, std::size_t tracks) {
    std::vector<Vec2> arm;
    for (const Vec2& p : places)
      for (const Track& track : std::span(sketch.tracks).first(tracks)) {
        const Vec2 q = nearest_on(track.from, track.to, p);
        if (arm.empty() || length(p - q) < length(arm[0] - arm[1])) arm = {p, q};
      }
    if (!arm.empty() && length(arm[0] - arm[1]) > 0.2 * u) bar.paths.push_back(std::move(arm));
  };
  for (const Vec2& p : sketch.points) join({p}, sketch.tracks.size());
  for (std::size_t i = 1; i < sketch.tracks.size(); ++i) {
    const Track& track = sketch.tracks[i];
    std::vector<Vec2> places{track.from, track.to};
    for (const Track& before : std::span(sketch.tracks).first(i))
      for (const Vec2& end : {before.from, before.to}) places.push_back(nearest_on(track.from, track.to, end));
    join(places, i);
  }
  if (!rods.paths.empty()) put(kBars, std::move(rods));
  if (!bar.paths.empty()) put(kBars, std::move(bar));
}

void SceneMaker::add_link(int body, const BodySketch& sketch) {
  const double u = scene_.unit;
  const std::vector<Vec2> hull = convex_hull(sketch.points, 0.6 * u);
  // A wheel is the whole body if it contains the centre of mass; a lid with a pinion at its hinge extends beyond the wheel.
  const bool wheeled = std::any_of(sketch.wheels.begin(), sketch.wheels.end(), [](const Wheel& wheel) { return length(wheel.centre) <= wheel.radius; });
  const bool covered = wheeled || !sketch.blocks.empty() || !sketch.cams.empty() || !sketch.rollers.empty() || !sketch.faces.empty();
  if (hull.size() > 2) {
    put(kPlates, {Form::kBar, Paint::kLink, body, {hull}, kLinkWidth * u, true});
  } else if (hull.size() == 2) {
    put(kBars, {Form::kBar, Paint::kLink, body, {hull}, kLinkWidth * u});
  } else if (hull.size() == 1 && !covered && length(hull[0]) > 0.5 * u) {
    add_lone_link(body, hull[0]);
  } else if (!covered) {
    const double radius = std::clamp(std::numbers::sqrt2 * gyration(body), 1.3 * u, 4 * u);
    put(kWheels, {Form::kCircle, Paint::kLink, body, {{{0, 0}}}, radius});
    show(body, {0, 0}, radius);
  }
}

// A body on a single joint: a uniform rod if its inertia fits, else a bob on an arm.
void SceneMaker::add_lone_link(int body, const Vec2& pin) {
  const double u = scene_.unit, arm = length(pin), rod = std::numbers::sqrt3 * gyration(body);
  const Vec2 away = -1 / arm * pin;
  if (rod > 0.8 * arm && rod < 1.4 * arm) {
    put(kBars, {Form::kBar, Paint::kLink, body, {{pin, rod * away}}, kLinkWidth * u});
    show(body, rod * away, kLinkWidth * u);
    return;
  }
  const double radius = std::clamp(std::numbers::sqrt2 * gyration(body), 1.6 * u, std::max(1.6 * u, 0.5 * arm));
  put(kBars, {Form::kBar, Paint::kLink, body, {{pin, {0, 0}}}, kRodWidth * u});
  put(kBars, {Form::kCircle, Paint::kLink, body, {{{0, 0}}}, radius});
  show(body, {0, 0}, radius);
}

void SceneMaker::add_wheels(int body, const BodySketch& sketch) {
  const double u = scene_.unit;
  std::vector<Wheel> wheels = sketch.wheels;
  std::sort(wheels.begin(), wheels.end(), [](const Wheel& a, const Wheel& b) { return a.radius > b.radius; });
  for (const Wheel& wheel : wheels) {
    const double tooth = std::min(0.45 * u, 0.12 * wheel.radius);
    show(body, wheel.centre, wheel.radius + (wheel.ring ? 1.6 * u : tooth));
    if (wheel.ring) {
      put(kBack, {Form::kCircle, Paint::kGear, body, {{wheel.centre}}, wheel.radius + 1.6 * u});
      put(kBack, {Form::kCircle, Paint::kHole, body, {{wheel.centre}}, wheel.radius - tooth});
    } else {
      put(kWheels, {Form::kCircle, Paint::kGear, body, {{wheel.centre}}, wheel.radius + tooth});
    }
    put(kWheels, {Form::kCircle, Paint::kPitch, body, {{wheel.centre}}, wheel.radius});
    if (wheel.ring || wheel.radius < 2.5 * u) continue;
    // Holes in the web make the rotation visible.
    Shape holes{Form::kCircle, Paint::kHole, body, {}, 0.17 * wheel.radius};
    for (int k = 0; k < 5; ++k) holes.paths.push_back({wheel.centre + 0.6 * wheel.radius * direction(2 * std::numbers::pi * k / 5)});
    put(kWheels, std::move(holes));
  }
}

void SceneMaker::add_cams(int body, const BodySketch& sketch) {
  const double u = scene_.unit;
  if (!sketch.cams.empty()) put(kWheels, {Form::kArea, Paint::kGear, body, sketch.cams});
  for (const Wheel& roller : sketch.rollers) {
    put(kBlocks, {Form::kCircle, Paint::kGear, body, {{roller.centre}}, std::max(roller.radius, 0.25 * u)});
    if (roller.radius > u) put(kPins, {Form::kCircle, Paint::kPin, body, {{roller.centre}}, 0.4 * u});
  }
  if (!sketch.faces.empty()) put(kBars, {Form::kBar, Paint::kLink, body, sketch.faces, kThick * u});
}

void SceneMaker::add_rack_teeth(int body, const Track& track) {
  const double u = scene_.unit, pitch = 0.9 * u;
  const Vec2 along = unit(track.to - track.from);
  const double total = length(track.to - track.from);
  const int n = std::clamp(static_cast<int>(total / pitch), 2, 400);
  const Vec2 root = 0.4 * u * track.other_side, tip = -0.35 * u * track.other_side;
  Shape teeth{Form::kArea, Paint::kLink, body, {{}}};
  std::vector<Vec2>& path = teeth.paths.front();
  for (int i = 0; i < n; ++i) {
    const Vec2 start = track.from + total * i / n * along;
    for (const auto& [share, at] : {std::pair(0.0, root), std::pair(0.25, root), std::pair(0.4, tip), std::pair(0.75, tip), std::pair(0.9, root)})
      path.push_back(start + share * total / n * along + at);
  }
  path.push_back(track.to + root);
  put(kBars, std::move(teeth));
}

void SceneMaker::add_block(const Anchor& at) {
  const double u = scene_.unit;
  put(kBlocks, {Form::kArea, Paint::kBlock, at.body, {rectangle(at.point, direction(at.axis), {1.9 * u, 1.15 * u})}});
}

// The draughtsman's symbol for a centre of mass: a circle with two black quarters.
void SceneMaker::add_mass_mark(int body) {
  const double r = 0.5 * scene_.unit, quarter = std::numbers::pi / 2;
  put(kMarks, {Form::kCircle, Paint::kMassLight, body, {{{0, 0}}}, r});
  Shape dark{Form::kArea, Paint::kMass, body, {}};
  for (const double from : {0.0, 2 * quarter}) {
    std::vector<Vec2> sector = arc({0, 0}, r, from, from + quarter);
    sector.push_back({0, 0});
    dark.paths.push_back(std::move(sector));
  }
  put(kMarks, std::move(dark));
}

}  // namespace pintle

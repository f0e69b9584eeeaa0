#include "joints/edge_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/expression/switching_points.h"

namespace pintle {
namespace {

constexpr int kPoints = 720;       // points at which a range is examined
constexpr double kSmooth = 1e-3;  // change of slope that rounded numbers may cause [-]

// Places at which an edge is examined, ascending: the ends of equal parts, and points within each piece between kinks of its height, which may be shorter than a part.
std::vector<double> places_looked_at(const Edge& edge) {
  constexpr int kParts = 2000, kOfPiece = 16;
  constexpr std::size_t kMostPieces = 200;  // with more pieces, as in a measured road, the ends of the parts suffice
  std::vector<double> places, kinks = switching_points(edge.height, edge.from, edge.to, kPoints, kMostPieces);
  for (int i = 0; i <= kParts; ++i) places.push_back(edge.from + (edge.to - edge.from) * i / kParts);
  for (std::size_t k = 1; k < kinks.size() && kinks.size() <= kMostPieces; ++k)
    for (int i = 0; i < kOfPiece; ++i) places.push_back(kinks[k - 1] + (kinks[k] - kinks[k - 1]) * (i + 0.5) / kOfPiece);
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace

CurvePoint EdgeProfile::at(double x) const {
  const auto [h, slope, bend] = edge_.height.is_constant() ? std::array{edge_.height.value({}), 0.0, 0.0} : edge_.height.second_order(std::array{x}, 0);
  return {{x, h}, {-1, -slope}, {0, bend}};
}

EdgeProfile::EdgeProfile(const Edge& edge) : edge_(edge) {
  const std::vector<double> places = places_looked_at(edge);
  std::vector<double> bend;
  double most_hollow = 0;
  for (const double x : places) {
    const CurvePoint point = at(x);
    bend.push_back(point.dd[1]);
    most_hollow = std::max(most_hollow, -point.curvature());
  }
  hollow_ = 1 / most_hollow;
  bends_ = bends_between(places, bend);
}

// Points within the distance `way` of c are within the same distance of it along x.
double EdgeProfile::nearest(const Planar::Point& c) const {
  const auto point = [this](double u) { return Planar::Point(-u, edge_.height.value(std::array{-u})); };
  return -nearest_parameter([this](double u) { return at(-u); }, point, c, -c[0], hollow_, [](double way) { return way; }, {});
}

std::array<GapFunction, 2> EdgeGap::gap_and_slip(const Planar::Vec& z) const {
  const Planar::Point c(z[0], z[1]);
  std::array<GapFunction, 2> g = gap_and_slip_over(profile->at(profile->nearest(c)), c, profile->roller_radius());
  g[0].gap -= profile->roller_radius();
  g[1].gradient = -g[1].gradient;  // along x
  g[1].hessian = -g[1].hessian;
  return g;
}

std::optional<double> EdgeProfile::undefined_at() const {
  const double length = edge_.to - edge_.from;
  for (int i = 1; i <= kPoints; ++i)
    for (const double x : {edge_.to + length * i / kPoints, edge_.from - length * i / kPoints})
      if (const CurvePoint there = at(x); !there.p.allFinite() || !there.d.allFinite()) return x;
  return std::nullopt;
}

std::string EdgeProfile::fault() const {
  const double apart = (edge_.to - edge_.from) / kPoints;
  for (int i = 0; i <= kPoints; ++i) {
    const double x = edge_.from + apart * i;
    const CurvePoint here = at(x);
    if (!here.p.allFinite() || !here.d.allFinite() || !here.dd.allFinite()) return fmt::format("the height or a derivative of it is not finite at {:.4g} m", x);
    if (i > 0 && !edge_.height.is_constant())
      if (const auto corner = corner_between(edge_.height, x - apart, x, kSmooth))
        return fmt::format("the edge has a corner at {:.4g} m: its slope jumps from {:.4g} to {:.4g}", corner->at, corner->slope_before, corner->slope_behind);
  }
  if (!(hollow_ < edge_.roller_radius)) return {};
  for (const double x : places_looked_at(edge_))
    if (const double curvature = at(x).curvature(); curvature * edge_.roller_radius < -1)
      return fmt::format("at {:.4g} m the edge is more hollow (radius of curvature {:.4g} m) than the roller is round: it would touch in two places", x, -1 / curvature);
  return {};
}

}  // namespace pintle

#include "joints/edge_profile.h"

#include <fmt/format.h>

#include <cmath>

namespace pintle {
namespace {

constexpr int kPoints = 4000;      // parts of the stretch, at whose ends it is looked at. With 720 a wheel passes a dip of 1/500 of the stretch unseen
constexpr double kSmooth = 1e-3;  // change of slope that rounded numbers may make [-]

}  // namespace

CurvePoint EdgeProfile::at(double x) const {
  const auto [h, slope, bend] = edge_.height.is_constant() ? std::array{edge_.height.value({}), 0.0, 0.0} : edge_.height.second_order(std::array{x}, 0);
  return {{x, h}, {-1, -slope}, {0, bend}};
}

EdgeProfile::EdgeProfile(const Edge& edge) : edge_(edge), hollow_(least_hollow_radius([this](double u) { return at(-u); }, -edge.to, -edge.from, kPoints)), bends_(find_bends([this](double x) { return at(x).dd[1]; }, edge.from, edge.to, kPoints)) {}

// What is no further from c than `way` is within this way along the line.
double EdgeProfile::nearest(const Planar::Point& c) const {
  const auto point = [this](double u) { return Planar::Point(-u, edge_.height.value(std::array{-u})); };
  return -nearest_parameter([this](double u) { return at(-u); }, point, c, -c[0], hollow_, [](double way) { return way; });
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
    if (const double curvature = here.curvature(); curvature * edge_.roller_radius < -1)
      return fmt::format("at {:.4g} m the edge is more hollow (radius of curvature {:.4g} m) than the roller is round: it would touch in two places", x, -1 / curvature);
  }
  return {};
}

}  // namespace pintle

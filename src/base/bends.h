// Where a curve changes the way it bends: what a step must not fly past.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pintle {

/// Places along a curve, ascending, at which straight, convex and hollow parts of it meet: a bump has them on either side. With a period the curve goes on in the same way.
struct Bends {
  std::vector<double> places;
  double period = 0;  // 0: none

  bool empty() const { return places.empty(); }
  /// The share of the way between two places that leads to the second bend on it; 1 if there are fewer. With the start at a bend this is none.
  double share_to_second(double from, double to) const {
    if (empty() || !(std::abs(to - from) > 0)) return 1;
    const bool forward = to > from;
    double at = from;
    for (int i = 0; i < 2; ++i) at = forward ? next(at) : -next_below(-at);
    const double share = (at - from) / (to - from);
    return share < 1 ? share : 1;
  }

 private:
  double next(double from) const {
    const double turns = period > 0 ? std::floor((from - places.front()) / period) * period : 0;
    const auto above = std::upper_bound(places.begin(), places.end(), from - turns);
    if (above != places.end()) return *above + turns;
    return period > 0 ? places.front() + turns + period : std::numeric_limits<double>::infinity();
  }
  // Of the mirrored curve.
  double next_below(double from) const {
    const double turns = period > 0 ? std::ceil((-from - places.back()) / period) * period : 0;
    const auto above = std::lower_bound(places.begin(), places.end(), -from - turns);
    if (above != places.begin()) return -(*(above - 1) + turns);
    return period > 0 ? -(places.back() + turns - period) : std::numeric_limits<double>::infinity();
  }
};

/// Of a curve between two parameters, by its curvature at many points: to within 1/720 of the way between them. What bends less than a ten-thousandth of the most is
/// straight.
template <class Curvature>
Bends find_bends(const Curvature& curvature, double low, double high) {
  constexpr int kPoints = 720;
  constexpr double kStraight = 1e-4;
  std::vector<double> values;
  double most = 0;
  for (int i = 0; i <= kPoints; ++i) {
    values.push_back(curvature(low + (high - low) * i / kPoints));
    most = std::max(most, std::abs(values.back()));
  }
  const auto way = [&](double value) { return std::abs(value) <= kStraight * most ? 0 : value > 0 ? 1 : -1; };
  Bends bends;
  for (int i = 1; i <= kPoints; ++i)
    if (way(values[i]) != way(values[i - 1])) bends.places.push_back(low + (high - low) * (i - 0.5) / kPoints);
  return bends;
}

}  // namespace pintle

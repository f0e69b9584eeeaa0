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
    const double first = next(from, forward), share = (next(first, forward) - from) / (to - from);
    return share < 1 ? share : 1;
  }

 private:
  // Beyond `from` by more than rounding.
  double next(double from, bool forward) const {
    constexpr double kRounding = 1e-12;
    if (std::isinf(from)) return from;
    const double beyond = (forward ? 1 : -1) * kRounding * std::max(std::abs(from), places.back() - places.front());
    const double turns = period > 0 ? std::floor((from - places.front()) / period) : 0;
    for (int i = 0; i < (period > 0 ? 3 : 1); ++i) {
      const double shift = (turns + (forward ? i - 1 : 1 - i)) * period, wanted = from + beyond - shift;
      if (forward) {
        if (const auto above = std::upper_bound(places.begin(), places.end(), wanted); above != places.end()) return *above + shift;
      } else {
        if (const auto above = std::lower_bound(places.begin(), places.end(), wanted); above != places.begin()) return *(above - 1) + shift;
      }
    }
    return forward ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  }
};

/// Between two parameters, by the curvature at equidistant ones, the first of which is `low`. What bends less than a ten-thousandth of the most, or than `rounding`, is
/// straight.
inline Bends bends_of(const std::vector<double>& curvature, double low, double apart, double rounding = 0) {
  constexpr double kStraight = 1e-4;
  double straight = 0;
  for (const double x : curvature) straight = std::max(straight, std::abs(x));
  straight = std::max(kStraight * straight, rounding);
  const auto way = [&](std::size_t i) { return !(std::abs(curvature[i]) > straight) ? 0 : curvature[i] > 0 ? 1 : -1; };
  Bends bends;
  for (std::size_t i = 1; i < curvature.size(); ++i) {
    if (way(i) == way(i - 1) || (way(i) == 0 && i + 1 < curvature.size() && way(i + 1) == -way(i - 1))) continue;  // a zero between two signs is at one bend
    bends.places.push_back(low + apart * (static_cast<double>(i) - 0.5));
  }
  return bends;
}

/// Of a curve of which the curvature is known, to within 1/720 of the way.
template <class Curvature>
Bends find_bends(const Curvature& curvature, double low, double high) {
  constexpr int kPoints = 720;
  const double apart = (high - low) / kPoints;
  std::vector<double> values;
  for (int i = 0; i <= kPoints; ++i) values.push_back(curvature(low + apart * i));
  return bends_of(values, low, apart);
}

/// Of the graph of a function, by the second differences of its values at the ends of so many parts of the way. What is narrower may be missed.
template <class Function>
Bends find_bends_of_graph(const Function& f, double low, double high, int parts) {
  constexpr double kRounding = 1e-14;  // of the largest value
  constexpr double kSmooth = 1e-5;     // of the range of values: what bends so little from one part to the next is as long as hundreds of them
  const double apart = (high - low) / parts;
  std::vector<double> values, curvature;
  for (int i = 0; i <= parts; ++i) {
    values.push_back(f(low + apart * i));
    if (i > 1) curvature.push_back(values[i] - 2 * values[i - 1] + values[i - 2]);
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return bends_of(curvature, low + apart, apart, std::max(kRounding * std::max(std::abs(*least), std::abs(*most)), kSmooth * (*most - *least)));
}

}  // namespace pintle

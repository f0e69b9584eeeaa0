// Where a curve changes the way it bends: what a step must not fly past.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pintle {

/// Places along a curve, ascending, at which straight, convex and hollow parts of it meet: a bump has them on either side. With a period the curve goes on in the same way.
struct Bends {
  std::vector<double> places;
  double period = 0;  // 0: none

  bool empty() const { return places.empty(); }
  /// The share of the way between two places that leads to the second bend on it; 1 if there are fewer, or where the way ends little behind the second one. With the
  /// start at a bend this is none.
  double share_to_second(double from, double to) const {
    if (empty() || !(std::abs(to - from) > 0)) return 1;
    const bool forward = to > from;
    const double second = next(next(from, forward), forward);
    const auto share_to = [&](double place) { return (place - from) / (to - from); };
    return share_of_way(share_to(second), share_to(next(second, forward)));
  }
  /// The same from the shares that lead to the second and the third bend.
  static double share_of_way(double second, double third) {
    constexpr double kBarely = 0.9;  // a way that was to end at the second bend may go so much further
    return second < kBarely || third < 1 ? second : 1;
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

/// Calls visit(i) where the curvatures i - 1 and i have other signs; those up to `straight` have none, and a single one of these between two signs is at one bend.
template <class Curvature, class Visit>
void visit_bends(const Curvature& curvature, std::size_t n, double straight, Visit&& visit) {
  const auto way = [&](std::size_t i) { return !(std::abs(curvature(i)) > straight) ? 0 : curvature(i) > 0 ? 1 : -1; };
  for (std::size_t i = 1; i < n; ++i)
    if (way(i) != way(i - 1) && !(way(i) == 0 && i + 1 < n && way(i + 1) == -way(i - 1))) visit(i);
}

/// Of a curve of which the curvature is known, to within 1/720 of the way. What bends less than a ten-thousandth of the most is straight.
template <class Curvature>
Bends find_bends(const Curvature& curvature, double low, double high) {
  constexpr int kPoints = 720;
  constexpr double kStraight = 1e-4;
  const double apart = (high - low) / kPoints;
  std::vector<double> values;
  double most = 0;
  for (int i = 0; i <= kPoints; ++i) {
    values.push_back(curvature(low + apart * i));
    most = std::max(most, std::abs(values.back()));
  }
  Bends bends;
  visit_bends([&](std::size_t i) { return values[i]; }, values.size(), kStraight * most, [&](std::size_t i) { bends.places.push_back(low + apart * (static_cast<double>(i) - 0.5)); });
  return bends;
}

/// The graph of a function, by its values at the ends of equal parts of a way; what is narrower than a part may be missed.
class GraphSamples {
 public:
  /// Takes room for so many parts: no more is allocated then.
  explicit GraphSamples(int most_parts) { values_.reserve(static_cast<std::size_t>(most_parts) + 1); }

  template <class Function>
  void take(const Function& f, double low, double high, int parts) {
    values_.clear();
    for (int i = 0; i <= parts; ++i) values_.push_back(f(low + (high - low) * i / parts));
  }
  /// Calls visit(part) at the bends, by second differences: part is where it is, counted from the start of the way.
  template <class Visit>
  void visit_bends_in_parts(Visit&& visit) const {
    constexpr double kRounding = 1e-14;  // of the largest value
    constexpr double kStraight = 1e-4;   // of the largest second difference
    constexpr double kSmooth = 1e-5;     // of the range of values: what bends so little from one part to the next is as long as hundreds of them
    if (values_.size() < 3) return;
    const auto curvature = [this](std::size_t i) { return values_[i + 2] - 2 * values_[i + 1] + values_[i]; };
    const std::size_t n = values_.size() - 2;
    double most = 0;
    for (std::size_t i = 0; i < n; ++i) most = std::max(most, std::abs(curvature(i)));
    const auto [least, largest] = std::minmax_element(values_.begin(), values_.end());
    const double straight = std::max({kStraight * most, kRounding * std::max(std::abs(*least), std::abs(*largest)), kSmooth * (*largest - *least)});
    visit_bends(curvature, n, straight, [&](std::size_t i) { visit(static_cast<double>(i) + 0.5); });
  }

 private:
  std::vector<double> values_;
};

}  // namespace pintle

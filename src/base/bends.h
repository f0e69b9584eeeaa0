// Places where the curvature of a curve changes sign: steps must not skip them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pintle {

/// Places along a curve, ascending, at which straight, convex and concave parts meet; a bump has such places on either side. With a period the pattern repeats.
struct Bends {
  std::vector<double> places;
  double period = 0;  // 0: none

  bool empty() const { return places.empty(); }
  /// The fraction of the interval between two places that leads to the second bend in it; 1 if there are fewer bends, or if the interval ends just after the second
  /// one. A bend at the start does not count.
  double share_to_second_bend(double from, double to) const {
    if (empty() || !(std::abs(to - from) > 0)) return 1;
    const bool forward = to > from;
    const double second = next_bend(next_bend(from, forward), forward);
    const auto share_at = [&](double place) { return (place - from) / (to - from); };
    return share_of_way(share_at(second), share_at(next_bend(second, forward)));
  }
  /// The same from the fractions that lead to the second and the third bend.
  static double share_of_way(double second, double third) {
    constexpr double kBarely = 0.99;  // an interval due to end at the second bend may be longer by this ratio. With 0.5 a bump is missed, with 1 steps end where rounding puts a bend
    return second < kBarely || third < 1 ? second : 1;
  }

 private:
  // The next bend, beyond `from` by more than rounding.
  double next_bend(double from, bool forward) const {
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

/// Calls use(i) where the curvatures i - 1 and i of n have different signs. Curvatures up to `least`, or up to a ten-thousandth of the largest, count as zero; a single zero
/// between two signs counts as one bend.
template <class Curvature, class Use>
void for_each_bend(const Curvature& curvature, std::size_t n, double least, Use&& use) {
  constexpr double kStraight = 1e-4;  // as a fraction of the largest. With 0 bumps are missed
  double straight = 0;
  for (std::size_t i = 0; i < n; ++i) straight = std::max(straight, std::abs(curvature(i)));
  straight = std::max(kStraight * straight, least);
  const auto way = [&](std::size_t i) { return !(std::abs(curvature(i)) > straight) ? 0 : curvature(i) > 0 ? 1 : -1; };
  for (std::size_t i = 1; i < n; ++i)
    if (way(i) != way(i - 1) && !(way(i) == 0 && i + 1 < n && way(i + 1) == -way(i - 1))) use(i);
}

/// The bends of a curve whose curvature is known at places along it, ascending: each lies between two of them.
inline Bends bends_between(const std::vector<double>& places, const std::vector<double>& curvature) {
  Bends bends;
  for_each_bend([&](std::size_t i) { return curvature[i]; }, places.size(), 0, [&](std::size_t i) { bends.places.push_back(0.5 * (places[i - 1] + places[i])); });
  return bends;
}

/// The same from the curvature at the ends of 720 equal parts.
template <class Curvature>
Bends find_bends(const Curvature& curvature, double low, double high) {
  constexpr int kParts = 720;
  std::vector<double> places, values;
  for (int i = 0; i <= kParts; ++i) {
    places.push_back(low + (high - low) * i / kParts);
    values.push_back(curvature(places.back()));
  }
  return bends_between(places, values);
}

/// The graph of a function, by its values at the ends of equal parts of an interval; features narrower than a part may be missed.
class SampledGraph {
 public:
  /// Allocates memory for this many parts; nothing more is allocated later.
  explicit SampledGraph(int most_parts) { values_.reserve(static_cast<std::size_t>(most_parts) + 1); }

  template <class Function>
  void take(const Function& f, double low, double high, int parts) {
    values_.clear();
    for (int i = 0; i <= parts; ++i) values_.push_back(f(low + (high - low) * i / parts));
  }
  /// Calls use(part) at the bends, found by second differences: part is the position, in parts from the start of the interval.
  template <class Use>
  void for_each_bend(Use&& use) const {
    constexpr double kRounding = 1e-14;  // as a fraction of the largest value: a sum that should be constant has no bends
    constexpr double kSmooth = 1e-5;     // as a fraction of the range of values: a curve that bends so little from one part to the next is smooth over hundreds of them. With 0 a toggle press takes 12 times the steps
    if (values_.size() < 3) return;
    const auto curvature = [this](std::size_t i) { return values_[i + 2] - 2 * values_[i + 1] + values_[i]; };
    const auto [least, largest] = std::minmax_element(values_.begin(), values_.end());
    const double smooth = std::max(kRounding * std::max(std::abs(*least), std::abs(*largest)), kSmooth * (*largest - *least));
    pintle::for_each_bend(curvature, values_.size() - 2, smooth, [&](std::size_t i) { use(static_cast<double>(i) + 0.5); });
  }

 private:
  std::vector<double> values_;
};

}  // namespace pintle

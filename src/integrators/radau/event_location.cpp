#include "integrators/radau/event_location.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pintle {
namespace {

constexpr int kHalvings = 46;     // halvings of an interval between two samples that give the resolution of an event
constexpr double kInside = 1e-6;  // fraction of an interval: an extremum this close to its end is taken to be the end
constexpr double kUnsure = 0.1;   // fraction of a parabola's curvature, the error that two estimates may have even if they agree; or of the values beside a corner, the height at which it is still looked at
constexpr int kSecants = 16;      // secant steps before the search continues by bisection

// Second divided difference over three points.
double curvature(double x0, double y0, double x1, double y1, double x2, double y2) {
  return ((y2 - y1) / (x2 - x1) - (y1 - y0) / (x1 - x0)) / (x2 - x0);
}

// A sample of one function, its value taken as positive.
struct Point {
  double x, y;
};

// Where the lines through two samples before an interval and two after it meet inside it, near zero or beyond; 0: nowhere. A convex function lies above both: this finds the bottom of one
// with a corner, as that of the magnitude of a force that nearly vanishes, which no parabola follows. In the first or the last interval of a step, where its one line reaches zero.
double corner(const Point* before, Point left, Point right, const Point* beyond) {
  const double width = right.x - left.x;
  const double fall = before ? (left.y - before->y) / (left.x - before->x) : 0, rise = beyond ? (beyond->y - right.y) / (beyond->x - right.x) : 0;
  double inside = 0, bottom = 0;
  if (before && beyond) {
    if (!(fall < 0 && rise > 0)) return 0;
    inside = (left.y - right.y + rise * width) / (rise - fall);
    bottom = left.y + fall * inside;
  } else if (before ? fall < 0 : rise > 0) {
    inside = before ? -left.y / fall : width - right.y / rise;
  }
  return inside > kInside * width && inside < (1 - kInside) * width && bottom <= kUnsure * std::max(left.y, right.y) ? inside : 0;
}

}  // namespace

EventSearch::EventSearch(const std::vector<SwitchingFunction>& functions)
    : functions_(functions), start_(functions.size()), values_(functions.size() * (kMostSamples + kLevels + kTrials)) {}

SwitchingEvent EventSearch::first(const RadauTable& table, SwitchingValues values_at) {
  std::array<Sample, kMostSamples> samples;
  samples[0] = {0, start_.data()};
  const int n = 2 * table.n;
  for (int i = 1; i <= n; ++i) {
    const int node = i / 2;
    samples[i] = {i % 2 == 0 ? table.nodes[node] : 0.5 * (table.nodes[node] + table.nodes[node + 1]), row(i)};
    values_at(samples[i].share, samples[i].value);
  }
  SwitchingEvent event;
  for (int i = 0; i < n; ++i)
    if (search(i > 0 ? &samples[i - 1] : nullptr, samples[i], samples[i + 1], i + 1 < n ? &samples[i + 2] : nullptr, 0, values_at, event)) break;
  return event;
}

bool EventSearch::has_event(const Sample& from, const Sample& to) const {
  for (std::size_t f = 0; f < functions_.size(); ++f)
    if (functions_[f].is_event(from.value[f], to.value[f])) return true;
  return false;
}

// The first point between two samples where a function with the same sign at both may reach zero; 0: there is none. It is the
// extremum of a parabola through both, theory/time Eq. (7.3). Its position follows from the mean of the curvatures given by
// the neighbouring samples, its depth from the larger curvature and their difference. Or it is a corner.
double EventSearch::extremum(const Sample* before, const Sample& left, const Sample& right, const Sample* beyond) const {
  const double width = right.share - left.share;
  double first = right.share;
  for (std::size_t f = 0; f < functions_.size(); ++f) {
    const bool positive = left.value[f] > 0;
    if ((right.value[f] > 0) != positive) continue;
    const double sign = positive ? 1 : -1, y0 = sign * left.value[f], y1 = sign * right.value[f], slope = (y1 - y0) / width;
    const auto curved = [&](const Sample& beside) { return curvature(left.share, y0, right.share, y1, beside.share, sign * beside.value[f]); };
    const double c0 = curved(before ? *before : *beyond), c1 = curved(beyond ? *beyond : *before), mean = 0.5 * (c0 + c1);
    const double largest = (1 + kUnsure) * std::max(c0, c1) + std::abs(c0 - c1);
    double inside = 0.5 * width - 0.5 * slope / mean;
    const bool is_parabola = mean > 0 && inside > kInside * width && inside < (1 - kInside) * width && y0 + slope * inside - largest * inside * (width - inside) <= 0;
    if (!is_parabola) {
      const auto point = [&](const Sample& at) { return Point{at.share, sign * at.value[f]}; };
      const Point first_beside = point(before ? *before : left), last_beside = point(beyond ? *beyond : right);
      inside = corner(before ? &first_beside : nullptr, point(left), point(right), beyond ? &last_beside : nullptr);
    }
    if (!(inside > 0)) continue;
    first = std::min(first, left.share + inside);
  }
  return first < right.share ? first : 0;
}

// An interval in which a function may cross zero and return is split where the function is closest to zero.
bool EventSearch::search(const Sample* before, const Sample& left, const Sample& right, const Sample* beyond, int level, SwitchingValues values_at, SwitchingEvent& event) {
  const double share = level < kLevels && (before || beyond) ? extremum(before, left, right, beyond) : 0;
  if (share > 0) {
    const Sample middle{share, row(kMostSamples + level)};
    values_at(middle.share, middle.value);
    return search(before, left, middle, &right, level + 1, values_at, event) || search(&left, middle, right, beyond, level + 1, values_at, event);
  }
  if (!has_event(left, right)) return false;
  event = locate(left, right, values_at);
  return true;
}

// Which of the functions with an event between two points has it first, by linear interpolation, and where.
int EventSearch::first_crossing(const Sample& low, const Sample& high, double& share) const {
  int first = -1;
  share = high.share;
  for (int f = 0; f < static_cast<int>(functions_.size()); ++f) {
    const double a = low.value[f], b = high.value[f];
    if (!functions_[f].is_event(a, b)) continue;
    const double at = low.share + (high.share - low.share) * (a / (a - b));
    if (first < 0 || !(share <= at)) {
      first = f;
      share = at;
    }
  }
  return first;
}

// Narrows an interval down to its first event by secants. Where the same end stays twice, its value is given less weight (N.
// Anderson and A. Bjorck, 1973), so that both ends approach the event. What secants have not located is bisected.
SwitchingEvent EventSearch::locate(const Sample& left, const Sample& right, SwitchingValues values_at) {
  const double resolution = std::max(std::ldexp(right.share - left.share, -kHalvings), 4 * std::numeric_limits<double>::epsilon());
  std::array<double*, kTrials> free{row(kMostSamples + kLevels), row(kMostSamples + kLevels + 1), row(kMostSamples + kLevels + 2)};
  Sample low{left.share, free[0]}, high{right.share, free[1]};
  std::copy_n(left.value, start_.size(), low.value);
  std::copy_n(right.value, start_.size(), high.value);
  double* trial = free[2];
  double share = 0, weight = 1;  // weight of the value at the end that stayed
  bool was_high = false;
  int function = first_crossing(low, high, share);
  for (int k = 0; high.share - low.share > resolution; ++k) {
    const double middle = low.share + 0.5 * (high.share - low.share);
    double at = k < kSecants && std::isfinite(share) ? share : middle;
    at = std::clamp(at, low.share + 0.5 * resolution, high.share - 0.5 * resolution);
    if (!(at > low.share && at < high.share)) break;
    values_at(at, trial);
    const Sample tried{at, trial};
    const bool is_high = has_event(low, tried);
    Sample& end = is_high ? high : low;
    const double ratio = trial[function] / end.value[function];
    std::swap(end.value, trial);
    end.share = at;
    const int before = function;
    function = first_crossing(low, high, share);
    weight = function == before && k > 0 && is_high == was_high ? weight * (ratio < 1 ? 1 - ratio : 0.5) : 1;
    was_high = is_high;
    const double a = low.value[function] * (is_high ? weight : 1), b = high.value[function] * (is_high ? 1 : weight);
    share = low.share + (high.share - low.share) * (a / (a - b));
  }
  return {low.share, high.share, function, high.value[function] > 0, 0};
}

}  // namespace pintle

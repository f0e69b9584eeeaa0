#include "integrators/radau/event_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pintle {
namespace {

constexpr int kHalvings = 46;         // of an interval between two samples: how well an event is located
constexpr double kInside = 1e-6;      // of an interval: an extremum this close to its end is the end's
constexpr double kTruncation = 0.2;   // kappa_1 of the ITP method; kappa_2 is 2, n_0 is 1

// Second divided difference over three points.
double curvature(double x0, double y0, double x1, double y1, double x2, double y2) {
  return ((y2 - y1) / (x2 - x1) - (y1 - y0) / (x1 - x0)) / (x2 - x0);
}

}  // namespace

EventSearch::EventSearch(const std::vector<SwitchingFunction>& functions)
    : functions_(functions), start_(functions.size()), rows_(functions.size() * (kMostSamples + kLevels + kTrials)) {}

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
// extremum of a parabola through both, theory/time Eq. (7.3); its curvature is the largest of those that the samples beside them give, and by how
// much these differ.
double EventSearch::extremum(const Sample* before, const Sample& left, const Sample& right, const Sample* beyond) const {
  const double width = right.share - left.share;
  double first = right.share;
  for (std::size_t f = 0; f < functions_.size(); ++f) {
    const bool positive = left.value[f] > 0;
    if ((right.value[f] > 0) != positive) continue;
    const double sign = positive ? 1 : -1, y0 = sign * left.value[f], y1 = sign * right.value[f], slope = (y1 - y0) / width;
    const auto curved = [&](const Sample& beside) { return curvature(left.share, y0, right.share, y1, beside.share, sign * beside.value[f]); };
    double c = before ? curved(*before) : curved(*beyond);
    if (before && beyond) {
      const double other = curved(*beyond);
      c = std::max(c, other) + std::abs(c - other);
    }
    if (!(c > 0)) continue;
    const double inside = 0.5 * width - 0.5 * slope / c;
    if (!(inside > kInside * width && inside < (1 - kInside) * width)) continue;
    if (y0 + slope * inside - c * inside * (width - inside) > 0) continue;
    first = std::min(first, left.share + inside);
  }
  return first < right.share ? first : 0;
}

// An interval in which a function may be left and entered again is split where it is nearest to that.
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

// Which of the functions with an event between two points has it first, on a straight line, and where.
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

// Narrows an interval down to its first event by the ITP method (I. F. D. Oliveira and R. H. C. Takahashi, 2020): the secant's zero,
// moved a little towards the middle, and never so far from it that more than one evaluation beyond those of halving could be needed.
SwitchingEvent EventSearch::locate(const Sample& left, const Sample& right, SwitchingValues values_at) {
  const double width = right.share - left.share, resolution = std::ldexp(width, -kHalvings);
  std::array<double*, kTrials> free{row(kMostSamples + kLevels), row(kMostSamples + kLevels + 1), row(kMostSamples + kLevels + 2)};
  Sample low{left.share, free[0]}, high{right.share, free[1]};
  std::copy_n(left.value, start_.size(), low.value);
  std::copy_n(right.value, start_.size(), high.value);
  double* trial = free[2];
  double crossing = 0;
  int function = first_crossing(low, high, crossing);
  double most = width;  // half of it, halved with each evaluation, is how far from the middle a trial may be
  for (int k = 0; k <= kHalvings + 1 && high.share - low.share > resolution; ++k, most *= 0.5) {
    const double now = high.share - low.share, middle = low.share + 0.5 * now, towards = middle < crossing ? -1 : 1;
    const double shift = kTruncation * now * now / width;
    double at = std::isfinite(crossing) && shift <= std::abs(middle - crossing) ? crossing + towards * shift : middle;
    const double reach = most - 0.5 * now;
    if (std::abs(at - middle) > reach) at = middle - towards * reach;
    at = std::clamp(at, low.share + 0.5 * resolution, high.share - 0.5 * resolution);
    if (!(at > low.share && at < high.share)) break;
    values_at(at, trial);
    const Sample tried{at, trial};
    Sample& end = has_event(low, tried) ? high : low;
    std::swap(end.value, trial);
    end.share = at;
    function = first_crossing(low, high, crossing);
  }
  return {low.share, high.share, function, high.value[function] > 0};
}

}  // namespace pintle

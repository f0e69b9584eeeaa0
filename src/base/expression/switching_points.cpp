#include "base/expression/switching_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pintle {
namespace {

void take_signs(const Expression& f, double at, std::vector<double>& value) { f.evaluate_switching_functions(std::array{at}, value.data()); }

}  // namespace

std::pair<double, double> bracket_switch(const Expression& f, std::size_t k, double low, double high) {
  constexpr int kHalves = 50;
  std::vector<double> value(static_cast<std::size_t>(f.n_switches()));
  const auto side = [&](double at) { return take_signs(f, at, value), value[k] > 0; };
  const bool at_low = side(low);
  for (int i = 0; i < kHalves; ++i) {
    const double middle = 0.5 * (low + high);
    (side(middle) == at_low ? low : high) = middle;
  }
  return {low, high};
}

std::vector<double> switching_points(const Expression& f, double low, double high, int parts, std::size_t most) {
  const auto n = static_cast<std::size_t>(f.n_switches());
  std::vector<double> places;
  if (n == 0) return places;
  std::vector<char> known(n, 0);
  for (std::size_t k = 0; k < n; ++k)
    if (const auto of_table = f.kinks_of_table(k, low, high, most)) {
      known[k] = 1;
      places.insert(places.end(), of_table->begin(), of_table->end());
    }
  std::vector<double> before(n), behind(n);
  double from = low;
  take_signs(f, from, before);
  for (int i = 1; i <= parts && std::find(known.begin(), known.end(), 0) != known.end(); ++i) {
    const double to = low + (high - low) * i / parts;
    take_signs(f, to, behind);
    for (std::size_t k = 0; k < n; ++k)
      if (!known[k] && (before[k] > 0) != (behind[k] > 0)) places.push_back(bracket_switch(f, k, from, to).second);
    before.swap(behind);
    from = to;
  }
  std::sort(places.begin(), places.end());
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(low), std::abs(high));
  places.erase(std::unique(places.begin(), places.end(), [rounding](double a, double b) { return b - a <= rounding; }), places.end());
  return places;
}

}  // namespace pintle

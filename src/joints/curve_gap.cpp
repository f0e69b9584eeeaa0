#include "joints/curve_gap.h"

#include "base/expression/switching_points.h"

#include <vector>

namespace pintle {

std::array<GapFunction, 2> gap_and_slip_over(const CurvePoint& nearest, const Planar::Point& c, double radius) {
  const Planar::Point t = nearest.tangent(), n = nearest.normal();
  const double curvature = nearest.curvature(), e = (c - nearest.p).dot(n), bend = curvature / (1 + curvature * e);
  std::array<GapFunction, 2> g;
  g[0].gap = e;                                                   // (2.2)
  g[0].gradient << n[0], n[1], 0;                                 // (2.3)
  g[0].hessian.topLeftCorner<2, 2>() = bend * t * t.transpose();  // (2.4)
  g[1].gradient << t[0], t[1], -radius;                           // (2.8)
  g[1].hessian.topLeftCorner<2, 2>() = -bend * n * t.transpose();
  return g;
}

std::optional<Corner> corner_between(const Expression& f, double low, double high, double least) {
  const auto n = static_cast<std::size_t>(f.n_switches());
  std::vector<double> at_low(n), at_high(n);
  f.evaluate_switching_functions(std::array{low}, at_low.data());
  f.evaluate_switching_functions(std::array{high}, at_high.data());
  for (std::size_t k = 0; k < n; ++k) {
    if ((at_low[k] > 0) == (at_high[k] > 0)) continue;
    const auto [before, behind] = bracket_switch(f, k, low, high);
    const auto slope = [&](double at) { return f.second_order(std::array{at}, 0)[1]; };
    if (const Corner corner{before, slope(before), slope(behind)}; std::abs(corner.slope_behind - corner.slope_before) > least) return corner;
  }
  return {};
}

}  // namespace pintle

// J angle'' = -9.81 S cos(angle): the motion of the IFToMM library's N-four-bar on its regular branch, with all cranks parallel.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace pintle::bench {

struct CrankTop {
  double t, x, y;  // B0 relative to A0 [s, m, m]
};

/// B0 with N loops at `count` + 1 equally spaced times from 0 to `end`, by the classical Runge-Kutta method with steps of 1e-4 s or less.
inline std::vector<CrankTop> n_four_bar_tops(int n, double end, int count) {
  const double J = (n + 1) / 3.0 + n, S = (n + 1) / 2.0 + n;
  const int steps = static_cast<int>(std::ceil(end / count / 1e-4));
  const double h = end / count / steps;
  const auto accel = [&](double angle) { return -9.81 * S / J * std::cos(angle); };
  double angle = std::numbers::pi / 2, spin = -1;
  std::vector<CrankTop> rows{{0, 0, 1}};
  for (int row = 1; row <= count; ++row) {
    for (int i = 0; i < steps; ++i) {
      const double a1 = accel(angle), s1 = spin, a2 = accel(angle + h / 2 * s1), s2 = spin + h / 2 * a1, a3 = accel(angle + h / 2 * s2),
                   s3 = spin + h / 2 * a2, a4 = accel(angle + h * s3), s4 = spin + h * a3;
      angle += h / 6 * (s1 + 2 * s2 + 2 * s3 + s4);
      spin += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    rows.push_back({end * row / count, std::cos(angle), std::sin(angle)});
  }
  return rows;
}

}  // namespace pintle::bench

#include "laws/flexures/blade_basis.h"

#include <array>
#include <cmath>
#include <numbers>

namespace pintle {
namespace {

// P_0 .. P_n at x.
Eigen::VectorXd legendre(int n, double x) {
  Eigen::VectorXd p(n + 1);
  p[0] = 1;
  if (n > 0) p[1] = x;
  for (int i = 1; i < n; ++i) p[i + 1] = ((2 * i + 1) * x * p[i] - i * p[i - 1]) / (i + 1);
  return p;
}

}  // namespace

GaussLegendre::GaussLegendre(int n) : x(n), w(n) {
  constexpr int kNewton = 10;  // iterations for each node of Gauss-Legendre quadrature
  for (int k = 0; k < n; ++k) {
    double at = -std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5)), slope = 1;
    for (int i = 0; i < kNewton; ++i) {
      const Eigen::VectorXd p = legendre(n, at);
      slope = n * (at * p[n] - p[n - 1]) / (at * at - 1);
      at -= p[n] / slope;
    }
    x[k] = at;
    w[k] = 2 / ((1 - at * at) * slope * slope);
  }
}

BladeBasis::BladeBasis(int functions) : n(functions), n_points(functions + kMorePoints), s(n_points), w(n_points), angle(n_points, n), curvature(n_points, n) {
  const GaussLegendre gauss(n_points);
  s = 0.5 * (gauss.x.array() + 1);
  w = 0.5 * gauss.w;
  for (int q = 0; q < n_points; ++q) {
    const Eigen::VectorXd p = legendre(n + 1, gauss.x[q]);
    for (int i = 1; i <= n; ++i) {
      angle(q, i - 1) = 0.5 * (p[i + 1] - p[i - 1]) / (2 * i + 1);  // (2.4)
      curvature(q, i - 1) = p[i];
    }
  }
}

const BladeBasis& BladeBasis::at(int level) {
  static const std::array<BladeBasis, kLevels> all{BladeBasis(kFewest), BladeBasis(2 * kFewest), BladeBasis(4 * kFewest), BladeBasis(kMost)};
  return all[static_cast<std::size_t>(level)];
}

}  // namespace pintle

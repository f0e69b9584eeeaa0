// Chebyshev-Gauss-Lobatto nodes on [0, 1] and the matrix that differentiates polynomials there. theory/assembly section 4.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>

#include "linalg/lagrange_weights.h"

namespace pintle {

/// Weight of sample i of n, at the extrema of the Chebyshev polynomial of degree n - 1, in (n - 1)/2 times the coefficient of the polynomial of a lower
/// degree. For degree n - 1 itself it gives twice as much. The sign fits samples in either order.
inline double chebyshev_weight(int n, int degree, int i) {
  const double w = i == 0 || i == n - 1 ? 0.5 : 1;
  return w * std::cos(std::numbers::pi * i * degree / (n - 1));
}

struct ChebyshevNodes {
  static constexpr int kN = 7;
  std::array<double, kN> x;
  Eigen::Matrix<double, kN, kN> D;

  ChebyshevNodes() {
    for (int i = 0; i < kN; ++i) x[i] = 0.5 * (1 - std::cos(std::numbers::pi * i / (kN - 1)));
    std::array<double, kN> w;
    for (int i = 0; i < kN; ++i) {
      w[i] = 1;
      for (int j = 0; j < kN; ++j)
        if (j != i) w[i] /= x[i] - x[j];
    }
    D.setZero();
    for (int i = 0; i < kN; ++i)
      for (int j = 0; j < kN; ++j) {
        if (i == j) continue;
        D(i, j) = w[j] / w[i] / (x[i] - x[j]);
        D(i, i) -= D(i, j);
      }
  }
  /// Lagrange weights of the nodes at s.
  Eigen::Matrix<double, kN, 1> weights(double s) const {
    Eigen::Matrix<double, kN, 1> v;
    lagrange_weights(x, 0, kN, s, v);
    return v;
  }
};

}  // namespace pintle

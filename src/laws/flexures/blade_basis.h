// The functions of which the slope of a bent blade is composed, at the points of Gauss quadrature. theory/flexures section 2.
#pragma once

#include <Eigen/Core>

namespace pintle {

/// Nodes and weights of Gauss-Legendre quadrature on [-1, 1].
struct GaussLegendre {
  Eigen::VectorXd x, w;
  explicit GaussLegendre(int n);
};

/// One level of approximation. s runs from 0 to 1 along the blade, and x = 2 s - 1; P_i are Legendre polynomials.
struct BladeBasis {
  int n = 0, n_points = 0;   // number of functions that vanish at both ends; number of quadrature points
  Eigen::VectorXd s, w;      // points and weights on [0, 1]
  Eigen::MatrixXd angle;     // n_points x n: half the integral of P_i from -1 to x, i = 1 .. n                       Eq. (2.4)
  Eigen::MatrixXd curvature; // n_points x n: its derivative by s, P_i
  explicit BladeBasis(int functions);

  static constexpr int kFewest = 8, kMost = 64, kLevels = 4;  // each level has twice the functions of the previous one
  static constexpr int kMorePoints = 8;  // excess of quadrature points over functions
  static const BladeBasis& at(int level);
};

}  // namespace pintle

// The functions that the slope of a bent blade is put together from, at the points of Gauss' quadrature. theory/flexures section 2.
#pragma once

#include <Eigen/Core>

namespace pintle {

/// Nodes and weights of Gauss and Legendre on [-1, 1].
struct GaussLegendre {
  Eigen::VectorXd x, w;
  explicit GaussLegendre(int n);
};

/// One degree of approximation. Along the blade s runs from 0 to 1, and x = 2 s - 1; P_i are Legendre's polynomials.
struct BladeBasis {
  int n = 0, n_points = 0;   // of the functions that vanish at both ends; of the quadrature
  Eigen::VectorXd s, w;      // points and weights on [0, 1]
  Eigen::MatrixXd angle;     // n_points x n: half the integral of P_i from -1 to x, i = 1 .. n                       Eq. (2.4)
  Eigen::MatrixXd curvature; // n_points x n: its derivative by s, P_i
  explicit BladeBasis(int functions);

  static constexpr int kFewest = 8, kMost = 64, kLevels = 4;  // each level has twice the functions of the one before
  static constexpr int kMorePoints = 8;  // of the quadrature than functions
  static const BladeBasis& at(int level);
};

}  // namespace pintle

// Radau IIA with three stages, order 5, stiffly accurate: the table, and its inverse brought to diagonal form.
// Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.5 and IV.8.
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>

namespace pintle {

struct RadauTable {
  static constexpr int kStages = 3;
  using Mat = Eigen::Matrix3d;
  Mat A, A2;              // Runge-Kutta matrix and its square
  Eigen::Vector3d c, b;   // stage times; weights (the last row of A)
  double real_eigenvalue;             // of the inverse of A
  std::complex<double> eigenvalue;    // the complex one with positive imaginary part
  // inverse(A) = T diag(real, complex, conj) inverse(T); stage i of x is T(i,0) w0 + 2 Re(T(i,1) w1).
  Eigen::Vector3d T_real;
  Eigen::Vector3cd T_complex;
  Eigen::RowVector3d inverse_real;
  Eigen::RowVector3cd inverse_complex;

  RadauTable();
  static const RadauTable& get() {
    static const RadauTable table;
    return table;
  }
};

}  // namespace pintle

// Radau IIA with three or five stages, order 5 or 9, stiffly accurate: the table, its inverse in diagonal form, and the
// conversion of values at the nodes {0, c_1 .. c_n = 1} of a step into curves. Hairer and Wanner, Solving Ordinary
// Differential Equations II, sections IV.5 and IV.8; theory/time Eqs. (3.1)-(3.4).
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

namespace pintle {

struct RadauTable {
  static constexpr int kMaxStages = 5, kMaxPairs = 2, kMaxNodes = kMaxStages + 1;
  // Sized at run time, without the heap.
  using Mat = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxNodes, kMaxNodes>;
  using Vec = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxNodes, 1>;
  using ComplexVec = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 1, 0, kMaxNodes, 1>;

  int n = 3;      // stages
  int pairs = 1;  // of complex eigenvalues
  Mat A, A2;      // Runge-Kutta matrix and its square
  Vec c, b;       // stage times; weights (the last row of A)
  // inverse(A) = T diag(real, complex, conj ..) inverse(T); stage i of x is T_real(i) w0 + 2 Re sum_p T_complex[p](i) w_p.
  double real_eigenvalue = 0;
  Vec T_real, inverse_real;
  std::array<std::complex<double>, kMaxPairs> eigenvalue;  // with positive imaginary part
  std::array<ComplexVec, kMaxPairs> T_complex, inverse_complex;
  Vec nodes;        // {0, c_1 .. c_n}
  Mat to_legendre;  // values at the nodes -> coefficients of the Legendre polynomials on [0, 1]
  Mat to_powers;    // values at the nodes -> coefficients of 1, x, x^2 ..
  Mat stages_to_powers, stages_to_legendre;  // the same from values at {c_1 .. c_n}

  /// Lagrange weights of the nodes at x.
  Vec weights(double x) const;
  /// The same for the last `count` of them alone; zero for those before.
  Vec weights_of_last(int count, double x) const;

  /// Integral over [0, 1] of the product of two curves through values at the nodes; exact to degree 2n, quadrature at the stages to 2n - 2.
  double integral_of_product(const Vec& first, const Vec& second) const;

  /// Weights of the stages, c_1 .. c_n, in the first and the second integral from 0 to x of the curve through them.
  struct StageIntegrals {
    Vec first, second;
  };
  StageIntegrals stage_integrals(double x) const;

  /// The table with 3 or 5 stages.
  static const RadauTable& of(int stages);

 private:
  explicit RadauTable(int stages);
  void diagonalize();
};

}  // namespace pintle

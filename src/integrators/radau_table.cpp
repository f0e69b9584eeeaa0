#include "integrators/radau_table.h"

#include <Eigen/LU>

namespace pintle {

RadauTable::RadauTable() {
  const double s = std::sqrt(6.0);
  A << (88 - 7 * s) / 360, (296 - 169 * s) / 1800, (-2 + 3 * s) / 225,
      (296 + 169 * s) / 1800, (88 + 7 * s) / 360, (-2 - 3 * s) / 225,
      (16 - s) / 36, (16 + s) / 36, 1.0 / 9;
  A2 = A * A;
  c = A.rowwise().sum();
  b = A.row(2);
  const Eigen::EigenSolver<Mat> eigen(A.inverse());
  const Eigen::Matrix3cd T = eigen.eigenvectors(), inverse = T.inverse();
  for (int i = 0; i < 3; ++i) {
    const std::complex<double> value = eigen.eigenvalues()[i];
    if (std::abs(value.imag()) < 1e-9) {
      // The real eigenvector may carry a complex factor; the product with its row of the inverse does not.
      const std::complex<double> factor = T(2, i);
      real_eigenvalue = value.real();
      T_real = (T.col(i) / factor).real();
      inverse_real = (inverse.row(i) * factor).real();
    } else if (value.imag() > 0) {
      eigenvalue = value;
      T_complex = T.col(i);
      inverse_complex = inverse.row(i);
    }
  }
}

}  // namespace pintle

// The method's table against the conditions that define it: quadrature order 5, stage order 3, its spectrum, stability.
#include "integrators/radau_table.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace pintle {
namespace {

const RadauTable& table() { return RadauTable::get(); }
double power(double x, int k) { return std::pow(x, k); }

TEST(RadauTable, NodesAreThoseOfRadau) {
  EXPECT_NEAR(table().c[0], (4 - std::sqrt(6.0)) / 10, 1e-15);
  EXPECT_NEAR(table().c[1], (4 + std::sqrt(6.0)) / 10, 1e-15);
  EXPECT_NEAR(table().c[2], 1, 1e-15);
}

TEST(RadauTable, QuadratureIsOfOrderFiveAndNoMore) {
  const auto misses = [](int k) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += table().b[i] * power(table().c[i], k - 1);
    return std::abs(sum - 1.0 / k);
  };
  for (int k = 1; k <= 5; ++k) EXPECT_LT(misses(k), 1e-15) << k;
  EXPECT_GT(misses(6), 1e-4);
}

TEST(RadauTable, StagesAreOfOrderThree) {
  for (int k = 1; k <= 3; ++k)
    for (int i = 0; i < 3; ++i) {
      double sum = 0;
      for (int j = 0; j < 3; ++j) sum += table().A(i, j) * power(table().c[j], k - 1);
      EXPECT_NEAR(sum, power(table().c[i], k) / k, 1e-15) << k << " " << i;
    }
}

TEST(RadauTable, AdjointConditionHoldsToOrderTwo) {
  for (int k = 1; k <= 2; ++k)
    for (int j = 0; j < 3; ++j) {
      double sum = 0;
      for (int i = 0; i < 3; ++i) sum += table().b[i] * power(table().c[i], k - 1) * table().A(i, j);
      EXPECT_NEAR(sum, table().b[j] * (1 - power(table().c[j], k)) / k, 1e-15) << k << " " << j;
    }
}

TEST(RadauTable, LastStageIsTheEndOfTheStep) {
  EXPECT_EQ(table().b, Eigen::Vector3d(table().A.row(2)));
  EXPECT_LT((table().A2 - table().A * table().A).cwiseAbs().maxCoeff(), 1e-16);
  // A2 integrates twice: sum A2(i, j) c_j^(k-1) = c_i^(k+1) / (k (k+1)) for k = 1, 2.
  for (int k = 1; k <= 2; ++k)
    for (int i = 0; i < 3; ++i) {
      double sum = 0;
      for (int j = 0; j < 3; ++j) sum += table().A2(i, j) * power(table().c[j], k - 1);
      EXPECT_NEAR(sum, power(table().c[i], k + 1) / (k * (k + 1)), 1e-15);
    }
}

// The eigenvalues of the inverse are the roots of x^3 - 9 x^2 + 36 x - 60, the denominator of the (2, 3) Pade function.
TEST(RadauTable, EigenvaluesAreTheRootsOfThePadeDenominator) {
  const auto residual = [](std::complex<double> x) { return std::abs(((x - 9.0) * x + 36.0) * x - 60.0); };
  EXPECT_LT(residual(table().real_eigenvalue), 1e-11);
  EXPECT_LT(residual(table().eigenvalue), 1e-11);
  EXPECT_GT(table().eigenvalue.imag(), 0);
  EXPECT_GT(table().eigenvalue.real(), 0);
}

TEST(RadauTable, DiagonalFormGivesTheInverseBack) {
  const Eigen::Matrix3d inverse = table().A.inverse();
  for (int column = 0; column < 3; ++column) {
    const Eigen::Vector3d x = Eigen::Vector3d::Unit(column);
    const double w0 = table().inverse_real * x;
    const std::complex<double> w1 = table().inverse_complex * x.cast<std::complex<double>>();
    const Eigen::Vector3d same = table().T_real * w0 + 2 * (table().T_complex * w1).real();
    EXPECT_LT((same - x).norm(), 1e-13);
    const Eigen::Vector3d times = table().T_real * (table().real_eigenvalue * w0) + 2 * (table().T_complex * (table().eigenvalue * w1)).real();
    EXPECT_LT((times - inverse * x).norm(), 1e-12);
  }
}

std::complex<double> stability(std::complex<double> z) {
  const Eigen::Matrix3cd one = Eigen::Matrix3cd::Identity();
  const Eigen::Vector3cd k = (one - z * table().A.cast<std::complex<double>>()).inverse() * Eigen::Vector3cd::Ones();
  return 1.0 + z * table().b.cast<std::complex<double>>().dot(k);
}

TEST(RadauTable, IsAStableAndForgetsTheInfinitelyFast) {
  for (double y = 1e-3; y < 1e6; y *= 1.7) EXPECT_LE(std::abs(stability({0, y})), 1 + 1e-12) << y;
  for (double x = 1e-3; x < 1e6; x *= 1.7) EXPECT_LT(std::abs(stability({-x, 0.3 * x})), 1);
  EXPECT_LT(std::abs(stability({-1e9, 0})), 1e-8);
  for (const double z : {0.2, 0.1}) EXPECT_LT(std::abs(stability({z, 0}) - std::exp(z)), std::pow(z, 6) / 5000);
}

}  // namespace
}  // namespace pintle

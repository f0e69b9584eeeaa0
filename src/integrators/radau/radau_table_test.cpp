// The method's tables against the conditions that define them: quadrature order, stage order, spectrum, stability; and the first guess of a step that is
// extrapolated with them; for three and for five stages.
#include "integrators/radau/radau_table.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "integrators/radau/predictor.h"

namespace pintle {
namespace {

using Complex = std::complex<double>;

double power(double x, int k) { return std::pow(x, k); }

class RadauTables : public testing::TestWithParam<int> {
 protected:
  const RadauTable& table_ = RadauTable::of(GetParam());
  const int n_ = GetParam();
};

TEST(RadauTable, ThreeStagesHaveTheKnownNodes) {
  const RadauTable& table = RadauTable::of(3);
  EXPECT_NEAR(table.c[0], (4 - std::sqrt(6.0)) / 10, 1e-15);
  EXPECT_NEAR(table.c[1], (4 + std::sqrt(6.0)) / 10, 1e-15);
  EXPECT_EQ(table.c[2], 1);
}

// The eigenvalues of the inverse are the roots of x^3 - 9 x^2 + 36 x - 60, the denominator of the (2, 3) Pade function.
TEST(RadauTable, ThreeStagesHaveTheRootsOfThePadeDenominator) {
  const RadauTable& table = RadauTable::of(3);
  const auto residual = [](Complex x) { return std::abs(((x - 9.0) * x + 36.0) * x - 60.0); };
  EXPECT_LT(residual(table.real_eigenvalue), 1e-11);
  EXPECT_LT(residual(table.eigenvalue[0]), 1e-11);
}

TEST_P(RadauTables, HasItsStages) {
  EXPECT_EQ(table_.n, n_);
  EXPECT_EQ(table_.pairs, (n_ - 1) / 2);
  EXPECT_EQ(table_.nodes[0], 0);
  for (int i = 0; i < n_; ++i) {
    EXPECT_EQ(table_.nodes[i + 1], table_.c[i]);
    EXPECT_GT(table_.nodes[i + 1], table_.nodes[i]);
  }
  EXPECT_EQ(table_.c[n_ - 1], 1);
}

TEST_P(RadauTables, QuadratureIsOfOrderTwiceTheStagesLessOneAndNoMore) {
  const auto misses = [this](int k) {
    double sum = 0;
    for (int i = 0; i < n_; ++i) sum += table_.b[i] * power(table_.c[i], k - 1);
    return std::abs(sum - 1.0 / k);
  };
  for (int k = 1; k <= 2 * n_ - 1; ++k) EXPECT_LT(misses(k), 2e-15) << k;
  EXPECT_GT(misses(2 * n_), n_ == 3 ? 1e-4 : 1e-6);
}

TEST_P(RadauTables, StagesAreOfTheOrderOfTheirNumber) {
  for (int k = 1; k <= n_; ++k)
    for (int i = 0; i < n_; ++i) {
      double sum = 0;
      for (int j = 0; j < n_; ++j) sum += table_.A(i, j) * power(table_.c[j], k - 1);
      EXPECT_NEAR(sum, power(table_.c[i], k) / k, 2e-15) << k << " " << i;
    }
}

TEST_P(RadauTables, AdjointConditionHoldsToOneOrderLess) {
  for (int k = 1; k <= n_ - 1; ++k)
    for (int j = 0; j < n_; ++j) {
      double sum = 0;
      for (int i = 0; i < n_; ++i) sum += table_.b[i] * power(table_.c[i], k - 1) * table_.A(i, j);
      EXPECT_NEAR(sum, table_.b[j] * (1 - power(table_.c[j], k)) / k, 2e-15) << k << " " << j;
    }
}

TEST_P(RadauTables, LastStageIsTheEndOfTheStep) {
  for (int j = 0; j < n_; ++j) EXPECT_EQ(table_.b[j], table_.A(n_ - 1, j));
}

// A2 integrates twice: sum A2(i, j) c_j^(k-1) = c_i^(k+1) / (k (k+1)).
TEST_P(RadauTables, SquareIntegratesTwice) {
  for (int k = 1; k < n_; ++k)
    for (int i = 0; i < n_; ++i) {
      double sum = 0;
      for (int j = 0; j < n_; ++j) sum += table_.A2(i, j) * power(table_.c[j], k - 1);
      EXPECT_NEAR(sum, power(table_.c[i], k + 1) / (k * (k + 1)), 2e-15);
    }
}

TEST_P(RadauTables, EigenvaluesAreThoseOfTheInverse) {
  Complex sum = table_.real_eigenvalue, product = table_.real_eigenvalue;
  for (int p = 0; p < table_.pairs; ++p) {
    EXPECT_GT(table_.eigenvalue[p].imag(), 0);
    EXPECT_GT(table_.eigenvalue[p].real(), 0);
    sum += 2 * table_.eigenvalue[p].real();
    product *= std::norm(table_.eigenvalue[p]);
  }
  const Eigen::MatrixXd inverse = Eigen::MatrixXd(table_.A).inverse();
  EXPECT_NEAR(sum.real(), inverse.trace(), 1e-11);
  EXPECT_NEAR(product.real() / inverse.determinant(), 1, 1e-11);
}

TEST_P(RadauTables, DiagonalFormGivesTheInverseBack) {
  const Eigen::MatrixXd inverse = Eigen::MatrixXd(table_.A).inverse();
  for (int column = 0; column < n_; ++column) {
    const Eigen::VectorXd x = Eigen::VectorXd::Unit(n_, column);
    const double w = table_.inverse_real.dot(x);
    Eigen::VectorXd same = table_.T_real * w, times = table_.T_real * (table_.real_eigenvalue * w);
    for (int p = 0; p < table_.pairs; ++p) {
      Complex wp = 0;  // without conjugation
      for (int i = 0; i < n_; ++i) wp += table_.inverse_complex[p][i] * x[i];
      for (int i = 0; i < n_; ++i) {
        same[i] += 2 * (table_.T_complex[p][i] * wp).real();
        times[i] += 2 * (table_.T_complex[p][i] * table_.eigenvalue[p] * wp).real();
      }
    }
    EXPECT_LT((same - x).norm(), 1e-12);
    EXPECT_LT((times - inverse * x).norm(), 1e-11);
  }
}

// Polynomials are recovered from their values at the nodes, as powers and as Legendre polynomials on [0, 1].
TEST_P(RadauTables, CurvesThroughTheNodesAreExactForPolynomials) {
  const auto legendre = [](int k, double x) {
    double last = 0, now = 1;
    for (int i = 0; i < k; ++i) last = std::exchange(now, ((2 * i + 1) * (2 * x - 1) * now - i * last) / (i + 1));
    return now;
  };
  for (int k = 0; k <= n_; ++k) {
    RadauTable::Vec monomial(n_ + 1), polynomial(n_ + 1);
    for (int i = 0; i <= n_; ++i) {
      monomial[i] = power(table_.nodes[i], k);
      polynomial[i] = legendre(k, table_.nodes[i]);
    }
    EXPECT_LT((table_.to_powers * monomial - RadauTable::Vec::Unit(n_ + 1, k)).norm(), 1e-11) << k;
    EXPECT_LT((table_.to_legendre * polynomial - RadauTable::Vec::Unit(n_ + 1, k)).norm(), 1e-12) << k;
    for (const double x : {-0.3, 0.37, 1.0, 1.8}) EXPECT_NEAR(table_.weights(x).dot(monomial), power(x, k), 1e-11) << k << " " << x;
    if (k == n_) continue;
    EXPECT_LT((table_.stages_to_powers * monomial.tail(n_) - RadauTable::Vec::Unit(n_, k)).norm(), 1e-11) << k;
    EXPECT_LT((table_.stages_to_legendre * polynomial.tail(n_) - RadauTable::Vec::Unit(n_, k)).norm(), 1e-12) << k;
  }
}

Complex stability(const RadauTable& table, Complex z) {
  const Eigen::MatrixXcd A = Eigen::MatrixXd(table.A).cast<Complex>();
  const Eigen::VectorXcd k = (Eigen::MatrixXcd::Identity(table.n, table.n) - z * A).inverse() * Eigen::VectorXcd::Ones(table.n);
  return 1.0 + z * (Eigen::VectorXd(table.b).cast<Complex>().transpose() * k)(0);
}

TEST_P(RadauTables, IsAStableAndForgetsTheInfinitelyFast) {
  for (double y = 1e-3; y < 1e6; y *= 1.7) EXPECT_LE(std::abs(stability(table_, {0, y})), 1 + 1e-12) << y;
  for (double x = 1e-3; x < 1e6; x *= 1.7) EXPECT_LT(std::abs(stability(table_, {-x, 0.3 * x})), 1);
  EXPECT_LT(std::abs(stability(table_, {-1e9, 0})), 1e-7);
  EXPECT_LT(std::abs(stability(table_, {0, 1e9})), 1e-7);
}

// exp(z) minus the stability function is C z^(2n) (1 + O(z)) with the constant of the Pade function, n! (n-1)! / ((2n-1)!
// (2n)!); the mean of both signs of z removes the next term.
TEST_P(RadauTables, FollowsTheExponentialToItsOrder) {
  double constant = 1;
  for (int k = 1; k <= 2 * n_; ++k) constant *= (k <= n_ ? k : 1.0) * (k < n_ ? k : 1.0) / k / (k < 2 * n_ ? k : 1.0);
  const auto share = [&](double z) { return std::abs(stability(table_, {z, 0}) - std::exp(z)) / (constant * std::pow(z, 2 * n_)); };
  EXPECT_NEAR(std::sqrt(share(0.5) * share(-0.5)), 1, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Stages, RadauTables, testing::Values(3, 5), [](const auto& stages) { return std::to_string(stages.param); });

// To degree 2n, where quadrature at the stages is exact to 2n - 2.
TEST_P(RadauTables, IntegrateProductsOfCurvesExactly) {
  for (int k = 0; k <= n_; ++k)
    for (int l = 0; l <= n_; ++l) {
      const RadauTable::Vec first = table_.nodes.array().pow(k).matrix(), second = table_.nodes.array().pow(l).matrix();
      EXPECT_NEAR(table_.integral_of_product(first, second), 1.0 / (k + l + 1), 1e-14) << k << " " << l;
    }
}

constexpr double kNear = 5, kFarOff = 100;  // first corrections [tolerances]

class Predictors : public testing::TestWithParam<int> {
 protected:
  const RadauTable& table_ = RadauTable::of(GetParam());
  const int n_ = table_.n;

  // The error of x^k, extrapolated through the nodes to a share of a step that is `ratio` times as long.
  double miss(const Predictor& predictor, int k, double share, double ratio) const {
    const RadauTable::Vec monomial = table_.nodes.array().pow(k).matrix();
    return std::abs(predictor.weights(table_, share, ratio).dot(monomial) - std::pow(1 + share * ratio, k));
  }
  void expect_degree(const Predictor& predictor, double ratio, int degree) const {
    for (int k = 0; k <= n_; ++k) {
      if (k <= degree) EXPECT_LT(miss(predictor, k, 0.7, ratio), 1e-10) << ratio << " " << k;
      else EXPECT_GT(miss(predictor, k, 0.7, ratio), 1e-3) << ratio << " " << k;
    }
  }
};

// Into a step that is not much longer the full degree, then a parabola, then a line.
TEST_P(Predictors, ContinueCurvesOfTheDegreeThatFitsTheRatio) {
  for (const auto& [ratio, degree] : {std::pair{0.4, n_}, std::pair{1.2, n_}, std::pair{1.5, 2}, std::pair{-1.5, 2}, std::pair{3.0, 1}})
    expect_degree(Predictor(Steps::kLong), ratio, degree);
  for (const double ratio : {0.4, 1.5, 3.0}) expect_degree(Predictor(Steps::kAccurate), ratio, n_);
}

// The full degree amplifies noise in the last bits at the start of a curve at rest; a parabola misses a curve of high degree.
TEST_P(Predictors, TakeTheDegreeThatWouldHaveServedTheLastStep) {
  Predictor predictor(Steps::kAccurate);
  const auto at_rest = [](const RadauTable::Vec& weights) { return std::abs(weights[0]) * 1e-6; };
  const auto curved = [this](const RadauTable::Vec& weights) { return std::abs(weights.dot(table_.nodes.array().pow(n_).matrix()) - std::pow(2, n_)); };
  predictor.choose_degree(table_, 1, kNear, at_rest);
  expect_degree(predictor, 1, n_);
  predictor.choose_degree(table_, 1, kFarOff, at_rest);
  expect_degree(predictor, 1, 2);
  predictor.choose_degree(table_, 1, kFarOff, curved);
  expect_degree(predictor, 1, n_);
  Predictor of_long_steps(Steps::kLong);
  of_long_steps.choose_degree(table_, 1, kFarOff, at_rest);
  expect_degree(of_long_steps, 1, n_);
}

INSTANTIATE_TEST_SUITE_P(Stages, Predictors, testing::Values(3, 5), [](const auto& stages) { return std::to_string(stages.param); });

}  // namespace
}  // namespace pintle

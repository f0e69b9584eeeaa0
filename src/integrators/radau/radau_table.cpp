#include "integrators/radau/radau_table.h"

#include <cmath>

#include "linalg/dense_factors.h"
#include "linalg/lagrange_weights.h"

namespace pintle {
namespace {

// Legendre polynomials on [0, 1].
double legendre(int degree, double x) {
  double last = 1, now = 2 * x - 1;
  if (degree == 0) return last;
  for (int k = 1; k < degree; ++k) {
    const double next = ((2 * k + 1) * (2 * x - 1) * now - k * last) / (k + 1);
    last = now;
    now = next;
  }
  return now;
}

// The zeros of P_n - P_(n-1), ascending; the last one is 1.
RadauTable::Vec radau_nodes(int n) {
  RadauTable::Vec c(n);
  const auto f = [n](double x) { return legendre(n, x) - legendre(n - 1, x); };
  constexpr int kIntervals = 1000;  // intervals of (0, 1) that are searched for the method's nodes: no two nodes share one
  int found = 0;
  for (int i = 0; i < kIntervals && found < n - 1; ++i) {
    double low = static_cast<double>(i) / kIntervals, high = (i + 1.0) / kIntervals;
    if (f(low) * f(high) > 0) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (f(low) * f(middle) > 0 ? low : high) = middle;
    }
    c[found++] = 0.5 * (low + high);
  }
  c[n - 1] = 1;
  return c;
}

}  // namespace

RadauTable::RadauTable(int stages) : n(stages), pairs((stages - 1) / 2) {
  c = radau_nodes(n);
  Mat powers(n, n), integrals(n, n);  // A integrates every polynomial below degree n exactly
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      powers(i, k) = std::pow(c[i], k);
      integrals(i, k) = std::pow(c[i], k + 1) / (k + 1);
    }
  stages_to_powers = inverse_of(powers);
  A = integrals * stages_to_powers;
  A2 = A * A;
  b = A.row(n - 1).transpose();
  nodes.resize(n + 1);
  nodes << 0, c;
  Mat values(n + 1, n + 1), at(n + 1, n + 1);
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) {
      values(i, k) = legendre(k, nodes[i]);
      at(i, k) = std::pow(nodes[i], k);
    }
  to_legendre = inverse_of(values);
  stages_to_legendre = inverse_of(values.block(1, 0, n, n));
  to_powers = inverse_of(at);
  diagonalize();
}

void RadauTable::diagonalize() {
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(inverse_of(A));
  const Eigen::MatrixXcd T = eigen.eigenvectors();
  ComplexLu factors;
  factors.compute(T);
  const Eigen::MatrixXcd inverse = factors.solve(Eigen::MatrixXcd::Identity(n, n));
  int pair = 0;
  for (int i = 0; i < n; ++i) {
    const std::complex<double> value = eigen.eigenvalues()[i];
    if (std::abs(value.imag()) < 1e-9) {
      // The real eigenvector may carry a complex factor; the product with its row of the inverse does not.
      const std::complex<double> factor = T(n - 1, i);
      real_eigenvalue = value.real();
      T_real = (T.col(i) / factor).real();
      inverse_real = (inverse.row(i) * factor).real().transpose();
    } else if (value.imag() > 0) {
      eigenvalue[pair] = value;
      T_complex[pair] = T.col(i);
      inverse_complex[pair++] = inverse.row(i).transpose();
    }
  }
}

RadauTable::Vec RadauTable::weights_of_last(int count, double x) const {
  Vec w = Vec::Zero(n + 1);
  lagrange_weights(nodes, static_cast<std::size_t>(n + 1 - count), static_cast<std::size_t>(n + 1), x, w);
  return w;
}

RadauTable::Vec RadauTable::weights(double x) const { return weights_of_last(n + 1, x); }

double RadauTable::integral_of_product(const Vec& first, const Vec& second) const {
  const Vec of_first = to_legendre * first, of_second = to_legendre * second;
  double sum = 0;
  for (int k = 0; k <= n; ++k) sum += of_first[k] * of_second[k] / (2 * k + 1);
  return sum;
}

RadauTable::StageIntegrals RadauTable::stage_integrals(double x) const {
  StageIntegrals weights{Vec::Zero(n), Vec::Zero(n)};
  for (int i = 0; i < n; ++i) {
    double power = x;
    for (int k = 0; k < n; ++k, power *= x) {
      weights.first[i] += stages_to_powers(k, i) * power / (k + 1);
      weights.second[i] += stages_to_powers(k, i) * power * x / ((k + 1) * (k + 2));
    }
  }
  return weights;
}

const RadauTable& RadauTable::of(int stages) {
  static const RadauTable three(3), five(5);
  return stages == 5 ? five : three;
}

}  // namespace pintle

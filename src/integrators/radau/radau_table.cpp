#include "integrators/radau/radau_table.h"

#include <Eigen/LU>
#include <cmath>
#include <vector>

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

using Complex = std::complex<double>;
using Polynomial = std::vector<double>;  // coefficients of 1, x, x^2 ..

Polynomial polynomial_with_zeros(const RadauTable::Vec& x) {
  Polynomial p{1};
  for (const double zero : x) {
    p.insert(p.begin(), 0.0);
    for (std::size_t k = 0; k + 1 < p.size(); ++k) p[k] -= zero * p[k + 1];
  }
  return p;
}
Polynomial derived(const Polynomial& p) {
  Polynomial d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(static_cast<double>(k) * p[k]);
  return d;
}
template <class Coefficient, class Number>
Number value(const std::vector<Coefficient>& p, Number x) {
  Number sum = 0;
  for (std::size_t k = p.size(); k-- > 0;) sum = sum * x + p[k];
  return sum;
}
// p (x - zero) / (at - zero)
std::vector<Complex> times_zero_at(std::vector<Complex> p, Complex zero, Complex at) {
  p.insert(p.begin(), 0.0);
  for (std::size_t k = 0; k + 1 < p.size(); ++k) p[k] -= zero * p[k + 1];
  for (Complex& coefficient : p) coefficient /= at - zero;
  return p;
}
// All zeros at once, by the method of Durand and Kerner.
std::vector<Complex> zeros(const std::vector<Complex>& p) {
  std::vector<Complex> x;
  for (std::size_t k = 1; k < p.size(); ++k) x.push_back(10.0 * std::pow(Complex(0.4, 0.9), k));
  for (int pass = 0; pass < 200; ++pass)
    for (std::size_t i = 0; i < x.size(); ++i) {
      Complex others = p.back();
      for (std::size_t j = 0; j < x.size(); ++j)
        if (j != i) others *= x[i] - x[j];
      x[i] -= value(p, x[i]) / others;
    }
  return x;
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
  stages_to_powers = powers.inverse();
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
  to_legendre = values.inverse();
  stages_to_legendre = Mat(values.block(1, 0, n, n)).inverse();
  to_powers = at.inverse();
  diagonalize();
}

// A v = mu v for the values at the nodes of a polynomial v of degree n - 1 means that its integral from 0 less mu v is a multiple of the polynomial
// M that vanishes at the nodes, so that v is the sum of mu^k times M's derivative of order k + 1. At 0 this asks for M(0) + mu M'(0) + .. = 0.
void RadauTable::diagonalize() {
  const Polynomial M = polynomial_with_zeros(c);
  std::vector<Complex> at_zero(static_cast<std::size_t>(n + 1));  // of M's derivatives, that of order n first
  Mat derivative(n, n);                                           // of order k + 1 at the nodes
  Polynomial of_order = M;
  for (int k = 0; k <= n; ++k) {
    if (k > 0)
      for (int i = 0; i < n; ++i) derivative(i, k - 1) = value(of_order, c[i]);
    at_zero[static_cast<std::size_t>(n - k)] = of_order[0];
    of_order = derived(of_order);
  }
  const std::vector<Complex> inverse_mu = zeros(at_zero);
  const Mat to_derivatives = derivative.inverse();
  int pair = 0;
  for (std::size_t i = 0; i < inverse_mu.size(); ++i) {
    const Complex mu = 1.0 / inverse_mu[i];
    // The row of the inverse: the polynomial in mu, without a constant, that is 1 at this eigenvalue and 0 at the others.
    std::vector<Complex> row{0, 1.0 / mu};
    for (std::size_t j = 0; j < inverse_mu.size(); ++j)
      if (j != i) row = times_zero_at(row, 1.0 / inverse_mu[j], mu);
    ComplexVec T = ComplexVec::Zero(n), inverse = ComplexVec::Zero(n);
    Complex power = 1;
    for (int k = 0; k < n; ++k) {
      power *= mu;
      T += power * derivative.col(k);
      inverse += row[static_cast<std::size_t>(k + 1)] * to_derivatives.row(k).transpose();
    }
    if (std::abs(mu.imag()) < 1e-9) {
      real_eigenvalue = inverse_mu[i].real();
      T_real = T.real();
      inverse_real = inverse.real();
    } else if (inverse_mu[i].imag() > 0) {
      eigenvalue[pair] = inverse_mu[i];
      T_complex[pair] = T;
      inverse_complex[pair++] = inverse;
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

// The tangents of a law with states of its own, and their reduction when the states are eliminated.
//
//   f = F(e, e', z),   z' = g(e, e', z)        theory/joints Eq. (3.7)
//
// Where a step's operator is 1/mu (theory/time Eq. (3.9)), states follow gaps directly,
//   (mu - g_z) dz = (g_e + mu g_v) de,         Eq. (3.8)
// so that a law of any kind enters the matrices only through its impedance:
//   Z(mu) = -[F_e + mu F_v + F_z (mu - g_z)^-1 (g_e + mu g_v)].   Eq. (3.9)
#pragma once

#include <cmath>
#include <vector>

#include "laws/law_numbers.h"
#include "space/space.h"

namespace pintle {

template <class S>
struct BasicLawTangents {
  static constexpr int kDof = S::kDof;
  int n = 0;                                          // states
  typename S::Vec force = S::Vec::Zero();
  typename S::Mat stiffness = S::Mat::Zero();        // -F_e, states held
  typename S::Mat damping = S::Mat::Zero();          // -F_v
  double energy = 0, loss = 0;
  double state_rate[kMostLawStates] = {};
  double force_by_state[kDof][kMostLawStates] = {};      // F_z
  double by_gap[kMostLawStates][kDof] = {};              // g_e
  double by_rate[kMostLawStates][kDof] = {};             // g_v
  double by_state[kMostLawStates][kMostLawStates] = {};  // g_z
};
using LawTangents = BasicLawTangents<Planar>;

/// The impedance of a law at one mu, or at several in parallel: T is double or Spectrum<N>.
template <class T, class S = Planar>
struct LawImpedance {
  static constexpr int D = S::kDof;
  T weight[D * D];                // Z(mu), by rows
  std::vector<T> inverse;     // (mu - g_z)^-1, n x n
  std::vector<T> follows;     // (mu - g_z)^-1 (g_e + mu g_v), n x D: states by gaps
  std::vector<T> pushes;      // F_z (mu - g_z)^-1, D x n: forces by residuals of the states' rates
  int n = 0;

  /// Allocates room for n states; `find` then allocates nothing.
  void reserve(int states) {
    n = states;
    inverse.resize(n * n);
    follows.resize(D * n);
    pushes.resize(D * n);
    work_.resize(n * n);
  }

  void find(const BasicLawTangents<S>& law, const T& mu) {
    const T one(1.0), none(0.0);
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) weight[D * r + c] = law.stiffness(r, c) * one + law.damping(r, c) * mu;
    if (n == 0) return;
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        work_[r * n + c] = (r == c ? mu : none) - law.by_state[r][c] * one;
        inverse[r * n + c] = r == c ? one : none;
      }
    invert();
    for (int r = 0; r < n; ++r)
      for (int k = 0; k < D; ++k) {
        T sum = none, push = none;
        for (int c = 0; c < n; ++c) {
          sum += inverse[r * n + c] * (law.by_gap[c][k] * one + law.by_rate[c][k] * mu);
          push += law.force_by_state[k][c] * inverse[c * n + r];
        }
        follows[D * r + k] = sum;
        pushes[k * n + r] = push;
      }
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c)
        for (int z = 0; z < n; ++z) weight[D * r + c] -= law.force_by_state[r][z] * follows[D * z + c];
  }

  /// As `find`, with 0 for negative diagonal elements: what projects bodies onto their joints divides by mu^2 M + Z(mu). Where friction falls with speed, or a spring with its
  /// gap, Z cancels the mass at some mu, and the projection would magnify rounding errors without bound. theory/time section 4.
  void find_passive(const BasicLawTangents<S>& law, const T& mu) {
    find(law, mu);
    for (int k = 0; k < D; ++k) weight[(D + 1) * k] = std::abs(weight[(D + 1) * k]);
  }

 private:
  static T inverse_of(const T& x) {
    if constexpr (requires { 1.0 / x; }) return 1.0 / x;
    else return reciprocal(x);
  }

  // Gauss-Jordan elimination. For decaying rates g_z lies to the left of the imaginary axis and mu to its right, so pivots do not
  // vanish. If a law feeds its own states and they do, the step's factorisation detects it, because it checks its numbers.
  void invert() {
    for (int p = 0; p < n; ++p) {
      const T pivot = inverse_of(work_[p * n + p]);
      for (int c = 0; c < n; ++c) {
        work_[p * n + c] = pivot * work_[p * n + c];
        inverse[p * n + c] = pivot * inverse[p * n + c];
      }
      for (int r = 0; r < n; ++r) {
        if (r == p) continue;
        const T factor = work_[r * n + p];
        for (int c = 0; c < n; ++c) {
          work_[r * n + c] -= factor * work_[p * n + c];
          inverse[r * n + c] -= factor * inverse[p * n + c];
        }
      }
    }
  }

  std::vector<T> work_;
};

}  // namespace pintle

// The matrices that mix the stages of a step, one stage per lane; and reductions over lanes.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/radau/radau_table.h"
#include "integrators/radau/step_error.h"
#include "space/space.h"
#include "linalg/spectrum.h"

namespace pintle {

/// The table as it acts on lanes: from stages to stages, and to and from the diagonal frame.
template <int N>
struct StageMatrices {
  Lanes<N> c;                    // stage times
  LaneMatrix<N> A, A2, T, T_inverse;
  Spectrum<N> eigenvalue;
  LaneMatrix<N> tail, tail_of_stages;  // to Legendre coefficients N, N - 1, N - 2 from all nodes; to one degree less each from the stages alone
  Lanes<N> tail_of_start;

  explicit StageMatrices(const RadauTable& table) {
    for (int i = 0; i < N; ++i) {
      c.set(i, table.c[i]);
      for (int k = 0; k < N; ++k) {
        A.column[k].set(i, table.A(i, k));
        A2.column[k].set(i, table.A2(i, k));
      }
    }
    for (int p = 0; p < N / 2; ++p) {
      eigenvalue.x.set(2 * p, table.eigenvalue[p].real());
      eigenvalue.x.set(2 * p + 1, table.eigenvalue[p].imag());
      for (int i = 0; i < N; ++i) {
        T.column[2 * p].set(i, 2 * table.T_complex[p][i].real());
        T.column[2 * p + 1].set(i, -2 * table.T_complex[p][i].imag());
        T_inverse.column[i].set(2 * p, table.inverse_complex[p][i].real());
        T_inverse.column[i].set(2 * p + 1, table.inverse_complex[p][i].imag());
      }
    }
    for (int back = 0; back < N; ++back) {
      tail_of_start.set(back, table.to_legendre(N - back, 0));
      for (int s = 0; s < N; ++s) {
        tail.column[s].set(back, table.to_legendre(N - back, s + 1));
        tail_of_stages.column[s].set(back, table.stages_to_legendre(N - 1 - back, s));
      }
    }
    eigenvalue.x.set(N - 1, table.real_eigenvalue);
    for (int i = 0; i < N; ++i) {
      T.column[N - 1].set(i, table.T_real[i]);
      T_inverse.column[i].set(N - 1, table.inverse_real[i]);
    }
  }
};

/// Places the stages of a step of length h.
template <int N>
struct StepMatrices {
  Lanes<N> c;
  LaneMatrix<N> A, A2;
  void scale(const StageMatrices<N>& m, double h) {
    c = h * m.c;
    for (int i = 0; i < N; ++i) {
      A.column[i] = h * m.A.column[i];
      A2.column[i] = (h * h) * m.A2.column[i];
    }
  }
  /// x and its rate v at the stages, from its second derivative a. theory/time Eq. (3.5).
  PINTLE_LANES Lanes<N> place(const Lanes<N>& a, double x0, double v0, Lanes<N>& v) const {
    Lanes<N> first = Lanes<N>::all(v0), second = Lanes<N>::all(x0) + v0 * c;
    for (int i = 0; i < N; ++i) {
      first += a[i] * A.column[i];
      second += a[i] * A2.column[i];
    }
    v = first;
    return second;
  }
};

/// A law's response to a gap of D components: `weight` has one entry per component, or is a matrix by rows.
template <int D, class T>
PINTLE_LANES void weigh(bool diagonal, const T* weight, const T* gap, T* f) {
  for (int k = 0; k < D; ++k) {
    if (diagonal) {
      f[k] = weight[k] * gap[k];
      continue;
    }
    T sum = weight[D * k] * gap[0];
    for (int i = 1; i < D; ++i) sum += weight[D * k + i] * gap[i];
    f[k] = sum;
  }
}

/// The largest lane; infinity where the sum of the same values is not finite.
template <int N>
double largest(const Lanes<N>& size, const Lanes<N>& sum) {
  double worst = 0;
  for (int s = 0; s < N; ++s) {
    if (!std::isfinite(sum[s])) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, size[s]);
  }
  return worst;
}

/// The size of the last of three coefficients, times the expected ratio of the next one to it: they decrease by a ratio where
/// the motion is smooth (then the next one is that much smaller than the last) and do not where it vibrates.
class TailSize {
 public:
  PINTLE_LANES void add(const Lanes<4>& relative) {
    size_ = larger_size(size_, relative);
    sum_ += relative;
  }
  /// Size of the last one alone, for series with kinks, which may decrease by chance.
  PINTLE_LANES double last() const { return std::isfinite(sum_[0]) ? size_[0] : std::numeric_limits<double>::infinity(); }
  PINTLE_LANES double value() const {
    if (!std::isfinite(sum_[0] + sum_[1] + sum_[2])) return std::numeric_limits<double>::infinity();
    return tail_size(size_[0], size_[1], size_[2]);
  }

 private:
  Lanes<4> size_ = Lanes<4>::all(0), sum_ = size_;
};

}  // namespace pintle

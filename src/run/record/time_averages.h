// Mean, RMS and peak over rows that may be unevenly spaced (the last one): trapezoidal in time.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace pintle {

/// Shares of the time span that the rows at `t` [s] stand for; their sum is 1 [-].
inline std::vector<double> time_weights(const std::vector<double>& t) {
  std::vector<double> w(t.size(), 0);
  if (t.size() < 2 || t.back() <= t.front()) {
    if (!w.empty()) w[0] = 1;
    return w;
  }
  const double span = t.back() - t.front();
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    w[i] += 0.5 * (t[i + 1] - t[i]) / span;
    w[i + 1] += 0.5 * (t[i + 1] - t[i]) / span;
  }
  return w;
}

/// Of a quantity whose rows are added one by one, each with its weight.
struct TimeAverages {
  double peak = 0, peak_time = 0, mean = 0, square = 0;  // of the largest size, with its sign; [s]; the mean of the square

  void add(double t, double weight, double x) {
    if (std::abs(x) > std::abs(peak)) {
      peak = x;
      peak_time = t;
    }
    mean += weight * x;
    square += weight * x * x;
  }
};

}  // namespace pintle

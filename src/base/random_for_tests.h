// Random numbers that are the same on every machine, and fourth-order differences, for all tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace pintle::sample {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  bool coin() { return below(2) == 1; }
  /// Either sign; magnitudes distributed evenly over the decades from low to high.
  double of_any_size(double low, double high) {
    const double size = std::exp(uniform(std::log(low), std::log(high)));
    return coin() ? size : -size;
  }
  template <class Vector>
  Vector vector(double low, double high) {
    Vector v;
    for (int i = 0; i < static_cast<int>(v.size()); ++i) v[i] = uniform(low, high);
    return v;
  }

 private:
  std::mt19937_64 engine_;
};

/// df/dx at x = 0 from values at -2h, -h, h, 2h; the error is of order h^4.
template <class F>
auto slope_at_zero(double h, F&& f) {
  using Value = decltype(f(h));
  return Value((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h));
}

}  // namespace pintle::sample

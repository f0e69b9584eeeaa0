// Random choices that are the same on every machine: a function of the seed and the model's number, drawn in sequence.
#pragma once

#include <cmath>
#include <cstdint>
#include <iterator>

#include "sweeps/philox.h"

namespace pintle::bench {

class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t model) : seed_(seed), model_(model) {}

  double uniform(double from, double to) { return from + (to - from) * uniform_number(seed_, model_, drawn_++); }
  /// Uniform in the logarithm.
  double log_uniform(double from, double to) { return from * std::pow(to / from, uniform(0, 1)); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  double signed_uniform(double from, double to) { return chance(0.5) ? uniform(from, to) : -uniform(from, to); }
  double signed_log_uniform(double from, double to) { return chance(0.5) ? log_uniform(from, to) : -log_uniform(from, to); }
  /// From `from` to `to`, inclusive.
  int integer(int from, int to) { return from + static_cast<int>(uniform(0, to - from + 1)); }
  template <class List>
  auto pick(const List& list) { return *(std::begin(list) + integer(0, static_cast<int>(std::size(list)) - 1)); }

 private:
  std::uint64_t seed_, model_, drawn_ = 0;
};

}  // namespace pintle::bench

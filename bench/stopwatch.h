// Processor time of this thread, which other programs on the machine hardly affect, and statistics of repetitions.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace pintle::bench {

class Stopwatch {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }

  double start_ = now();
};

/// The times of one repeated piece of work.
class Times {
 public:
  void add(double seconds) { all_.push_back(seconds); }
  bool empty() const { return all_.empty(); }
  double median() const { return quantile(0.5); }
  double least() const { return quantile(0); }
  /// Half the interquartile range relative to the median [-].
  double spread() const { return 0.5 * (quantile(0.75) - quantile(0.25)) / quantile(0.5); }

 private:
  double quantile(double share) const {
    std::vector<double> sorted = all_;
    std::sort(sorted.begin(), sorted.end());
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto i = static_cast<std::size_t>(place);
    const std::size_t next = std::min(i + 1, sorted.size() - 1);
    return sorted[i] + (place - static_cast<double>(i)) * (sorted[next] - sorted[i]);
  }

  std::vector<double> all_;
};

}  // namespace pintle::bench

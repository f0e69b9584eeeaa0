// Methods over a ladder of tolerances, timed round robin, and what one pays for a given error.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/force_samples.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"

namespace pintle::bench {

struct MethodRun {
  bool completed = false;
  double seconds = 0;
  double steps = 0, evaluations = 0;
  ForceSamples samples;
};

struct Contestant {
  std::string name;
  std::string group;  // "Pintle" or a peer's
  std::function<MethodRun(double tolerance)> run;
  std::vector<double> ladder;
};

/// One method at one tolerance.
struct Rung {
  std::size_t contestant = 0;
  double tolerance = 0;
  bool completed = false;
  double steps = 0, evaluations = 0, error = 0;
  Times times;
};

class WorkPrecision {
 public:
  explicit WorkPrecision(std::vector<Contestant> contestants) : contestants_(std::move(contestants)) {}

  /// Every method at every tolerance once in each round.
  void measure(int rounds, const ForceSamples& reference);
  const std::vector<Rung>& rungs() const { return rungs_; }
  ResultTable table() const;

  /// Median time [s] to reach `error`, between the rungs in proportion of the logarithms; infinite when out of reach.
  double time_for(std::size_t contestant, double error) const;
  /// The contestant of the group (or with that name) that needs the least time, or -1.
  int best_for(const std::string& group, double error) const;
  const Contestant& contestant(std::size_t i) const { return contestants_[i]; }
  std::size_t size() const { return contestants_.size(); }

 private:
  std::vector<Contestant> contestants_;
  std::vector<Rung> rungs_;
};

}  // namespace pintle::bench

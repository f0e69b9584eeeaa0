// Methods over a range of tolerances, timed in round-robin order, and the cost of a given error.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "bench/problem.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"

namespace pintle::bench {

/// The quantity whose error is measured.
enum class Measure {
  kForce,  ///< of any joint force, relative to its peak [-]
  kPlace,  ///< of the followed point, at any output time [m]
  kEnd,    ///< of the followed point, at the end [m]
};

struct Contestant {
  std::string name;
  std::string group;   // "Pintle" or a peer's
  std::string solves;  // which equations: "compliant", "ideal"
  std::function<MethodRun(double setting)> run;
  std::vector<double> ladder;  // tolerances, or steps [s]: from cheap to expensive
  const Samples* truth = nullptr;
};

/// One method at one tolerance.
struct Rung {
  std::size_t contestant = 0;
  double tolerance = 0;
  bool completed = false, skipped = false;
  double steps = 0, evaluations = 0;
  double force_error = 0, place_error = 0, end_error = 0;
  Times times;
  double error(Measure measure) const;
};

struct Effort {
  int rounds = 9;
  double repeat_below = 2;  // seconds: a longer run is measured only once
  double hopeless = std::numeric_limits<double>::infinity();  // a longer run ends its ladder [s]
};

class WorkPrecision {
 public:
  explicit WorkPrecision(std::vector<Contestant> contestants) : contestants_(std::move(contestants)) {}

  /// Runs every method at every tolerance once per round.
  void measure(const Effort& effort);
  const std::vector<Rung>& rungs() const { return rungs_; }
  ResultTable table(const std::string& title) const;

  /// Median time [s] to reach `error`, interpolated between the rungs in the logarithms; infinite if out of reach.
  double time_for(std::size_t contestant, Measure measure, double error) const;
  /// The contestant of the group (or with that name) that needs the least time, or -1.
  int best_for(const std::string& group, Measure measure, double error) const;
  const Contestant& contestant(std::size_t i) const { return contestants_[i]; }
  std::size_t size() const { return contestants_.size(); }

 private:
  void first_look(Rung& rung, const Effort& effort);

  std::vector<Contestant> contestants_;
  std::vector<Rung> rungs_;
};

}  // namespace pintle::bench

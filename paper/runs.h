// Runs of the paper's mechanisms, and what is read from them.
#pragma once

#include <string>
#include <vector>

#include "base/constants.h"
#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle::paper {

/// A model of mechanisms/.
Model mechanism(const std::string& name, const std::vector<std::string>& overrides = {});

/// The same bearing in every joint [N/m, N*s/m].
struct Bearing {
  double k = 0, c = 0;
};
void set_bearings(Model& model, const Bearing& bearing);

/// simulate(), which must complete; a missed tolerance is let pass where `tolerance_may_fail`.
Trajectory run(const Model& model, bool tolerance_may_fail = false);

/// One integration by a method's word, or by the model's. Throws std::invalid_argument if there is no such method.
struct SingleRun {
  Trajectory trajectory;
  bool completed = false;
  std::string message;
};
SingleRun run_once(const Model& model, const std::string& method, double tolerance, double max_step);

/// One column of a trajectory.
std::vector<double> column(const Trajectory& run, const std::string& name);
/// |a - b| element by element.
std::vector<double> distance(const std::vector<double>& a, const std::vector<double>& b);
double largest(const std::vector<double>& x);

/// Digits in which two numbers agree whose difference is `relative`.
double digits(double relative);

/// "1e+08" as "1e8"; 0 as "0".
std::string short_number(double x);

/// A table of tests/reference: columns by name.
class ReferenceTable {
 public:
  explicit ReferenceTable(const std::string& name);
  std::size_t size() const { return rows_.size(); }
  double at(std::size_t row, const std::string& name) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> rows_;
};

}  // namespace pintle::paper
